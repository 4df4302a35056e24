// SPDX-License-Identifier: BSD-3-Clause
// The fuzzer without libFuzzer: that its seeds make every oracle speak, and that a library which is
// wrong would be caught.
#include "fuzz/program.h"

#include <gtest/gtest.h>

#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

namespace ode_ext::fuzz {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::map<std::string, Bytes> seeds() {
  std::map<std::string, Bytes> seeds;
  const auto folder = std::filesystem::path(ODE_EXT_SOURCE_DIR) / "tests/fuzz/corpus";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream file(entry.path(), std::ios::binary);
    seeds[entry.path().filename()] = Bytes(std::istreambuf_iterator<char>(file), {});
  }
  return seeds;
}

class FuzzProgram : public ::testing::Test {
 protected:
  FuzzProgram() { dInitODE2(0); }
  ~FuzzProgram() override {
    colliders_.renew();
    dCloseODE();
  }
  Verdict run(const std::string& seed) {
    return run_program(seeds_.at(seed), colliders_, options_);
  }

  const std::map<std::string, Bytes> seeds_ = seeds();
  Colliders colliders_;
  ProgramOptions options_;
};

TEST_F(FuzzProgram, SeedsHaveNoFlawAndMakeEveryOracleSpeak) {
  Tally sum;
  for (const auto& [name, bytes] : seeds_) {
    const Verdict verdict = run_program(bytes, colliders_, options_);
    EXPECT_EQ(verdict.flaw, "") << name;
    EXPECT_GT(verdict.tally.contacts, 0) << name;
    sum += verdict.tally;
  }
  EXPECT_GT(sum.colliding, 0);
  EXPECT_GT(sum.contained, 0);
  EXPECT_GT(sum.apart, 0);
  EXPECT_GT(sum.compared, 0);
  EXPECT_GT(sum.meshlets, 0);
}

TEST_F(FuzzProgram, IsTheSameForTheSameBytes) {
  const Verdict first = run("boxes"), second = run("boxes");
  EXPECT_EQ(to_text(first.tally), to_text(second.tally));
}

TEST_F(FuzzProgram, NeedsNoBytes) { EXPECT_EQ(run_program({}, colliders_, options_).flaw, ""); }

TEST_F(FuzzProgram, CatchesALostContact) {
  options_.tamper = [](std::vector<dContactGeom>& contacts) { contacts.clear(); };
  EXPECT_EQ(run("boxes").flaw, "no contact, but the surfaces intersect");
  EXPECT_EQ(run("inside").flaw, "no contact, but one mesh is inside the other");
}

TEST_F(FuzzProgram, CatchesAContactThatIsNotThere) {
  options_.tamper = [](std::vector<dContactGeom>& contacts) {
    if (!contacts.empty()) return;
    dContactGeom c{};
    c.normal[0] = 1;
    contacts.push_back(c);
  };
  EXPECT_NE(run("inside").flaw, "");
}

TEST_F(FuzzProgram, CatchesANormalThatIsNotAUnit) {
  options_.tamper = [](std::vector<dContactGeom>& contacts) {
    for (dContactGeom& c : contacts) c.normal[0] += 0.5;
  };
  EXPECT_NE(run("balls").flaw.find("normal"), std::string::npos);
}

TEST_F(FuzzProgram, CatchesAnAnswerThatAnotherColliderDoesNotGive) {
  options_.tamper = [](std::vector<dContactGeom>& contacts) {
    for (dContactGeom& c : contacts) c.depth += 1e-12;
  };
  EXPECT_NE(run("boxes").flaw.find("another collider"), std::string::npos);
}

TEST_F(FuzzProgram, CatchesAPairThatTakesTooLong) {
  options_.slow = 0.02;
  options_.times_stock = 1;
  options_.delay = [] {
    const std::clock_t end = std::clock() + CLOCKS_PER_SEC / 20;
    while (std::clock() < end) {
    }
  };
  const Verdict verdict = run("inside");
  EXPECT_TRUE(verdict.slow) << verdict.flaw;
  EXPECT_GT(verdict.tally.stock, 0);
}

}  // namespace
}  // namespace ode_ext::fuzz
