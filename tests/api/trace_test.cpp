// SPDX-License-Identifier: BSD-3-Clause
// ODE_EXT_TRACE is read once a process and the file is closed when it ends, so each test has one.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "support/batch_collider.h"
#include "support/path_for_a_death.h"

namespace ode_ext::test {
namespace {

class ApiTraceDeathTest : public testing::Test {
 protected:
  ApiTraceDeathTest() { ::testing::FLAGS_gtest_death_test_style = "threadsafe"; }
};

void trace_two_passes(
    const std::string& path, void (*between)() = [] {}) {
  setenv("ODE_EXT_TRACE", path.c_str(), 1);
  {
    OdeWorld world;
    const dSpaceID space = world.space(SpaceKind::Simple);
    const Pile pile(world, space, 5, 1);
    const BatchCollider collider;
    collider.pass(space);
    between();
    collider.pass(space);
  }
  std::exit(0);
}

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

TEST_F(ApiTraceDeathTest, WritesAnEventForEveryStageOfEveryPass) {
  const PathForADeath path("ode_ext_trace_test.json");
  EXPECT_EXIT(trace_two_passes(path.name()), testing::ExitedWithCode(0), "");
  std::stringstream text;
  text << std::ifstream(path.name()).rdbuf();
  for (const char* name :
       {"pass", "gather", "meshes", "device", "export", "pair_step", "vertex_step",
        "iterative_rays", "bvh_rays", "basic_rays", "monolithic", "cull", "match", "cross", "flood",
        "assembly", "contact_step", "deform_step", "whole_step"})
    EXPECT_EQ(count(text.str(), std::string("\"name\":\"") + name + "\""), 2) << name;
  EXPECT_EQ(text.str().substr(0, 2), "[\n");
  EXPECT_EQ(text.str().substr(text.str().size() - 3), "\n]\n");
  EXPECT_EQ(count(text.str(), "{\"name\""), count(text.str(), ",\n") + 1);
}

// The child ends like any program, but for the driver, which may hang there.
void fork_a_child_that_ends() {
  const pid_t child = fork();
  if (child == 0) {
    std::fflush(nullptr);
    _exit(0);
  }
  waitpid(child, nullptr, 0);
}

TEST_F(ApiTraceDeathTest, HasNothingTwiceOfAForkedChild) {
  const PathForADeath path("ode_ext_forked_trace_test.json");
  EXPECT_EXIT(trace_two_passes(path.name(), &fork_a_child_that_ends), testing::ExitedWithCode(0),
              "");
  std::stringstream text;
  text << std::ifstream(path.name()).rdbuf();
  EXPECT_EQ(count(text.str(), "\"name\":\"pass\""), 2);
  EXPECT_EQ(count(text.str(), "[\n"), 1);
}

TEST_F(ApiTraceDeathTest, ThatCannotBeWrittenIsAMessageAndNoCollider) {
  EXPECT_EXIT(
      {
        setenv("ODE_EXT_TRACE", "/dev/null/trace.json", 1);
        dInitODE2(0);
        if (dBatchColliderCreate(nullptr) != nullptr) std::exit(1);
        std::fputs(dBatchColliderGetLastErrorMessage(), stderr);
        dCloseODE();
        std::exit(0);
      },
      testing::ExitedWithCode(0), "ODE_EXT_TRACE names '/dev/null/trace.json'");
}

// /dev/full takes nothing, as a full disk does.
TEST_F(ApiTraceDeathTest, IsGivenUpWithOneMessageWhereItCannotBeWritten) {
  const auto run = [] {
    dSetMessageHandler([](int, const char* format, va_list values) {
      std::vfprintf(stderr, format, values);
      std::fputs("\n", stderr);
    });
    trace_two_passes("/dev/full");
  };
  EXPECT_EXIT(run(), testing::ExitedWithCode(0),
              "^[^\n]*trace cannot be written any more[^\n]*\n$");
}

}  // namespace
}  // namespace ode_ext::test
