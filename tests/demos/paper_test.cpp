// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "paper/agreement.h"
#include "paper/configuration.h"
#include "paper/machine.h"
#include "paper/missed.h"
#include "paper/options.h"
#include "paper/run.h"
#include "paper/schedule.h"
#include "paper/summary.h"
#include "simulation/exit_code.h"
#include "support/temporary_folder.h"

namespace paper {
namespace {

using falling_objects::kExitOk;
using falling_objects::kExitUsage;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<Configuration> parse_all(const std::vector<const char*>& names) {
  std::vector<Configuration> configurations;
  for (const char* name : names) configurations.push_back(parse_configuration(name));
  return configurations;
}

class PaperScene : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(All, PaperScene, testing::Values("rigid", "rigid-deformable"));

TEST_P(PaperScene, HasConfigurationsThatAreCalledWhatTheyAreParsedFrom) {
  std::set<std::string> names;
  for (const Configuration& configuration : default_configurations(GetParam())) {
    EXPECT_EQ(parse_configuration(configuration.name()), configuration);
    EXPECT_TRUE(names.insert(configuration.name()).second) << configuration.name() << " twice";
  }
  EXPECT_TRUE(names.contains("full"));
}

TEST(PaperConfiguration, TakesItsWordsInAnyOrder) {
  EXPECT_EQ(parse_configuration("iterative-count-monolithic-basic").name(),
            "iterative-basic-monolithic-count");
}

TEST(PaperConfiguration, IsRefusedWithTheListOfWords) {
  for (const char* name :
       {"", "fast", "full-fast", "full-", "full--exact", "full-exact-exact", "exact-full",
        "full-checked", "full-edges-monolithic", "iterative-edges"}) {
    try {
      parse_configuration(name);
      ADD_FAILURE() << "'" << name << "' was taken";
    } catch (const std::invalid_argument& e) {
      EXPECT_THAT(e.what(), HasSubstr("monolithic, exact, plain, ignore, count"));
    }
  }
}

TEST(PaperConfiguration, SetsEverySettingItNames) {
  EXPECT_EQ(parse_configuration("full").config(), "rays=full,edges=off");
  EXPECT_EQ(parse_configuration("full-edges").config(), "rays=full,edges=on");
  EXPECT_EQ(parse_configuration("iterative").config(), "rays=iterative-paper,edges=off");
  const std::string all =
      parse_configuration("iterative-checked-basic-monolithic-exact-plain-ignore-count").config();
  EXPECT_EQ(all,
            "rays=iterative,deformable_target=basic,organization=monolithic,workload=exact,"
            "prediction=plain,misprediction=ignore,confidence=1.02,edges=off,count_work=on");
  EXPECT_EQ(dBatchConfigCheck(all.c_str()), 0) << dBatchColliderGetLastErrorMessage();
}

TEST(PaperSchedule, GivesEveryConfigurationEveryPlaceEquallyOften) {
  constexpr std::size_t kCount = 5;
  std::map<std::pair<std::size_t, std::size_t>, int> times;
  for (int step = 0; step < 2 * static_cast<int>(kCount); ++step) {
    const std::vector<std::size_t> order = order_in(step, kCount);
    ASSERT_EQ(order.size(), kCount);
    for (std::size_t place = 0; place < kCount; ++place) ++times[{order[place], place}];
  }
  EXPECT_EQ(times.size(), kCount * kCount);
  for (const auto& [where, count] : times) EXPECT_EQ(count, 2);
}

TEST(PaperSchedule, WarmsUpForTwoStepsBeforeWhatIsSlowIsMeasured) {
  std::vector<int> measured, taking_part;
  for (int step = 0; step < 20; ++step) {
    if (is_measured(step, 10)) measured.push_back(step);
    if (is_measured_or_warming_up(step, 10)) taking_part.push_back(step);
  }
  EXPECT_THAT(measured, ElementsAre(9, 19));
  EXPECT_THAT(taking_part, ElementsAre(7, 8, 9, 17, 18, 19));
  EXPECT_TRUE(is_measured(0, 1));
  EXPECT_TRUE(is_measured_or_warming_up(0, 1));
}

TEST(PaperAgreement, HoldsWhileAllHashesAreTheSame) {
  Agreement agreement(parse_all({"full", "full-exact", "iterative-checked"}), 0);
  agreement.after_step(0, {7, 7, 7});
  agreement.after_step(1, {8, 8, 8});
  EXPECT_TRUE(agreement.holds());
  ASSERT_EQ(agreement.verdicts().size(), 2u);
  for (const Verdict& verdict : agreement.verdicts()) EXPECT_EQ(verdict.steps, 2);
}

TEST(PaperAgreement, BlamesADifferenceOnTheClaimThatItBreaks) {
  Agreement agreement(parse_all({"full", "iterative-checked", "iterative-checked-monolithic"}), 0);
  agreement.after_step(0, {7, 7, 7});
  agreement.after_step(1, {7, 7, 9});
  agreement.after_step(2, {7, 7, 9});
  EXPECT_FALSE(agreement.holds());
  std::map<std::string, Verdict> verdicts;
  for (const Verdict& verdict : agreement.verdicts()) verdicts[verdict.claim] = verdict;
  const Verdict& broken = verdicts.at("pipelined == monolithic");
  EXPECT_EQ(broken.differing, 2);
  ASSERT_EQ(broken.comparisons.size(), 1u);
  EXPECT_EQ(broken.comparisons[0].first, 1u);
  EXPECT_EQ(broken.comparisons[0].second, 2u);
  EXPECT_EQ(broken.comparisons[0].first_difference, 1);
}

TEST(PaperAgreement, FallsBackToTheDriver) {
  Agreement agreement(parse_all({"iterative-checked-exact", "full"}), 1);
  agreement.after_step(0, {1, 2});
  EXPECT_FALSE(agreement.holds());
}

TEST(PaperAgreement, ExemptsWhatMayMissContactsAndWhoeverDidNotCollide) {
  Agreement agreement(
      parse_all({"full", "iterative", "full-ignore", "full-plain-ignore", "full-count"}), 0);
  agreement.after_step(0, {1, 2, 3, 4, std::nullopt});
  EXPECT_TRUE(agreement.holds());
  ASSERT_EQ(agreement.verdicts().size(), 1u);
  EXPECT_EQ(agreement.verdicts()[0].steps, 0);
  agreement.after_step(1, {1, 2, 3, 4, 5});
  EXPECT_FALSE(agreement.holds());
}

TEST(PaperAgreement, ComparesThePapersRuleWithItselfAlone) {
  Agreement agreement(parse_all({"full", "iterative", "iterative-monolithic", "iterative-count"}),
                      0);
  agreement.after_step(0, {1, 2, 2, 3});
  EXPECT_TRUE(agreement.holds());
  agreement.after_step(1, {1, 2, 3, 3});
  EXPECT_FALSE(agreement.holds());
}

TEST(PaperSummary, SaysWhatDiffers) {
  Options options;
  options.configurations = parse_all({"full", "full-exact"});
  Agreement agreement(options.configurations, 0);
  agreement.after_step(0, {1, 1});
  agreement.after_step(1, {1, 2});
  const auto summary = summarize(
      options, agreement, {{options.configurations[0], 1, {}}, {options.configurations[1], 2, {}}});
  EXPECT_FALSE(summary["identical"].get<bool>());
  std::ostringstream out;
  print_summary(out, summary);
  EXPECT_THAT(out.str(), HasSubstr("predicted == exact: 1 of 2 comparisons DIFFER"));
  EXPECT_THAT(out.str(), HasSubstr("full-exact differs from full in 1 steps, first in step 1"));
}

TEST(PaperMissed, ComparesByPairsWhicheverWayRound) {
  const auto geom = [](std::size_t i) { return reinterpret_cast<dGeomID>(16 * (i + 1)); };
  const auto contact = [&](std::size_t a, std::size_t b) {
    dContactGeom made{};
    made.g1 = geom(a);
    made.g2 = geom(b);
    return made;
  };
  const std::vector<dContactGeom> all{contact(0, 1), contact(0, 1), contact(0, 2), contact(1, 2)};
  const std::vector<dContactGeom> found{contact(1, 0), contact(1, 2), contact(3, 4)};
  const Missed missed = compare_contacts(all, found);
  EXPECT_EQ(missed.pairs, 3);
  EXPECT_EQ(missed.contacts, 4);
  EXPECT_EQ(missed.missed_pairs, 1);
  EXPECT_EQ(missed.missed_contacts, 2);
  EXPECT_EQ(missed.false_pairs, 1);
}

TEST(PaperMachine, ReadsTheLineOfTheChosenDevice) {
  const DeviceLine device = parse_chosen_device(
      "  0  cpu  Some CPU  (Some Platform)  driver 1.2, OpenCL 3.0, 2 compute units, 1.0 GiB\n"
      "* 1  gpu  Big GPU (rev 2)  (Another Platform)  driver 535.1, OpenCL 1.2 X, 132 compute "
      "units, 80.0 GiB (20.0 GiB in one buffer)\n"
      "* chosen by the environment variable\n");
  EXPECT_EQ(device.type, "gpu");
  EXPECT_EQ(device.name, "Big GPU (rev 2)");
  EXPECT_EQ(device.platform, "Another Platform");
  EXPECT_EQ(device.driver, "535.1");
  EXPECT_EQ(device.version, "OpenCL 1.2 X");
  EXPECT_EQ(parse_chosen_device("no device\n").type, "");
}

TEST(PaperMachine, FindsTheDeviceOfThisMachine) {
  const nlohmann::ordered_json machine = describe_machine("device", "", "paper run");
  for (const char* key : {"device_type", "platform", "driver", "opencl", "cpu", "compiler"})
    EXPECT_NE(machine[key], "unknown") << key;
}

struct PaperOutcome {
  ParsedOptions parsed;
  std::string out, err;
};

PaperOutcome parse_paper(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "somewhere/paper");
  std::ostringstream out, err;
  PaperOutcome outcome;
  outcome.parsed = parse_options(static_cast<int>(arguments.size()), arguments.data(), out, err);
  outcome.out = out.str();
  outcome.err = err.str();
  return outcome;
}

TEST(PaperOptions, AreThePapersSceneByDefault) {
  const PaperOutcome outcome = parse_paper({"run", "--out", "x"});
  ASSERT_FALSE(outcome.parsed.exit_code) << outcome.err;
  const Options& o = outcome.parsed.options;
  EXPECT_EQ(o.simulation.objects, 1000);
  EXPECT_EQ(o.steps, 600);
  EXPECT_EQ(o.configurations, default_configurations("rigid"));
  EXPECT_EQ(o.driver.name(), "full");
  EXPECT_EQ(o.command, "paper run --out x");
}

TEST(PaperOptions, HaveThePapersSecondScene) {
  const Options o =
      parse_paper({"run", "--out", "x", "--scene", "rigid-deformable"}).parsed.options;
  EXPECT_EQ(o.simulation.objects, 216);
  EXPECT_EQ(o.simulation.sheets, 36);
  EXPECT_EQ(o.configurations, default_configurations("rigid-deformable"));
}

TEST(PaperOptions, AddTheDriverToTheChosenConfigurations) {
  const Options o = parse_paper({"run", "--out", "x", "--configurations", "iterative,full-exact",
                                 "--driver", "full-monolithic"})
                        .parsed.options;
  EXPECT_EQ(o.configurations, parse_all({"iterative", "full-exact", "full-monolithic"}));
}

TEST(PaperOptions, ExplainThemselvesAndSucceed) {
  const PaperOutcome outcome = parse_paper({"run", "--help"});
  EXPECT_EQ(outcome.parsed.exit_code, kExitOk);
  for (const char* text : {"--configurations", "Examples", "Exit codes", "monolithic"})
    EXPECT_THAT(outcome.out, HasSubstr(text));
}

class WrongPaperOptions : public testing::TestWithParam<std::vector<const char*>> {};
INSTANTIATE_TEST_SUITE_P(
    All, WrongPaperOptions,
    testing::Values(std::vector<const char*>{}, std::vector{"walk"}, std::vector{"run"},
                    std::vector{"run", "--out", "x", "--steps", "0"},
                    std::vector{"run", "--out", "x", "--scene", "soft"},
                    std::vector{"run", "--out", "x", "--sheets", "3"},
                    std::vector{"run", "--out", "x", "--every", "0"},
                    std::vector{"run", "--out", "x", "--configurations", "fast"},
                    std::vector{"run", "--out", "x", "--driver", "full-count"},
                    std::vector{"run", "--out", "x", "--driver", "iterative"}));

TEST_P(WrongPaperOptions, AreRefusedWithAMessageAndCode2) {
  const PaperOutcome outcome = parse_paper(GetParam());
  EXPECT_EQ(outcome.parsed.exit_code, kExitUsage);
  EXPECT_FALSE(outcome.err.empty());
}

class PaperRun : public testing::Test {
 protected:
  nlohmann::json read(const char* name) const {
    return nlohmann::json::parse(std::ifstream(folder_ + "/" + name));
  }
  std::vector<std::string> lines(const char* name) const {
    std::ifstream file(folder_ + "/" + name);
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
  }

  ode_ext::TemporaryFolder temporary_{"paper_test"};
  std::string folder_ = temporary_ / "run";
};

TEST_F(PaperRun, EndsWithTheSameContactsInAllConfigurations) {
  Options options;
  options.simulation.objects = 12;
  options.steps = 20;  // the first contacts come in step 16
  options.quiet = true;
  options.every = 4;
  options.out = folder_;
  options.configurations =
      parse_all({"full", "full-monolithic", "iterative-checked", "iterative-checked-exact",
                 "iterative", "iterative-monolithic", "full-ignore", "iterative-count"});
  options.driver = options.configurations[0];
  ASSERT_EQ(run(options), kExitOk);

  const nlohmann::json summary = read("summary.json");
  EXPECT_TRUE(summary["identical"].get<bool>());
  const auto hash = [&](const char* name) {
    return summary["configurations"][name]["running_hash"].get<std::string>();
  };
  for (const char* name : {"full-monolithic", "iterative-checked", "iterative-checked-exact"})
    EXPECT_EQ(hash(name), hash("full")) << name;
  EXPECT_EQ(hash("iterative-monolithic"), hash("iterative"));
  EXPECT_GT(summary["configurations"]["full-ignore"]["missed"]["contacts"], 0)
      << "nothing touched anything: the hashes say nothing";
  EXPECT_TRUE(read("machine.json").contains("device"));
  // Seven collide in each of 20 steps, the counting one is measured in every fourth.
  EXPECT_EQ(lines("steps.csv").size(), 1u + 20 * 7 + 5);
  EXPECT_GT(lines("work.csv").size(), 2u);
}

TEST_F(PaperRun, CollidesSheetsToo) {
  Options options;
  options.scene = "rigid-deformable";
  options.simulation.objects = 2;
  options.simulation.sheets = 1;
  options.steps = 4;
  options.quiet = true;
  options.every = 4;
  options.out = folder_;
  options.configurations = parse_all({"full", "iterative", "iterative-basic"});
  options.driver = options.configurations[0];
  EXPECT_EQ(run(options), kExitOk);
  EXPECT_EQ(read("summary.json")["configurations"]["iterative-basic"]["steps"], 1);
}

TEST_F(PaperRun, SaysThatItCannotWrite) {
  std::ofstream(folder_) << "a file";
  Options options;
  options.out = folder_;
  EXPECT_EQ(run(options), kExitUsage);
}

}  // namespace
}  // namespace paper
