// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ode_ext/ode_ext.h>

#include <filesystem>
#include <sstream>

#include "falling_objects/output_file.h"
#include "support/temporary_folder.h"

namespace falling_objects {
namespace {

using ode_ext::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

struct Outcome {
  ParsedOptions parsed;
  std::string out, err;
};

Outcome parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "falling_objects");
  std::ostringstream out, err;
  Outcome outcome;
  outcome.parsed = parse_options(static_cast<int>(arguments.size()), arguments.data(), out, err);
  outcome.out = out.str();
  outcome.err = err.str();
  return outcome;
}

TEST(Options, AreThePapersSceneByDefault) {
  const Outcome outcome = parse({});
  ASSERT_FALSE(outcome.parsed.exit_code);
  const Options& o = outcome.parsed.options;
  EXPECT_EQ(o.objects, 1000);
  EXPECT_EQ(o.steps, 600);
  EXPECT_EQ(o.hz, 60);
  EXPECT_EQ(o.collider, Collider::kBatch);
  EXPECT_EQ(o.max_contacts, 16);
  EXPECT_EQ(o.config, "");
}

TEST(Options, AreThePapersSecondSceneByItsName) {
  const Options o = parse({"--scene", "rigid-deformable"}).parsed.options;
  EXPECT_EQ(o.objects, 216);
  EXPECT_EQ(o.sheets, 36);
  const Options small =
      parse({"--scene", "rigid-deformable", "--objects", "8", "--sheets", "1"}).parsed.options;
  EXPECT_EQ(small.objects, 8);
  EXPECT_EQ(small.sheets, 1);
  EXPECT_FALSE(parse({}).parsed.options.has_sheets());
}

TEST(Options, TakeEveryNameForItsValue) {
  const Options o = parse({"--collider", "ode", "--config", "workload=exact,confidence=0.5",
                           "--device", "pocl", "--compare", "--check-rest"})
                        .parsed.options;
  EXPECT_EQ(o.collider, Collider::kOde);
  EXPECT_EQ(o.config, "workload=exact,confidence=0.5");
  EXPECT_EQ(o.device, "pocl");
  EXPECT_TRUE(o.compare);
  EXPECT_TRUE(o.check_rest);
  EXPECT_FALSE(o.check);
}

TEST(Options, OfTheColliderAreRefusedInTheLibrarysWords) {
  const Outcome outcome = parse({"--config", "rays=fast"});
  EXPECT_EQ(outcome.parsed.exit_code, kExitUsage);
  EXPECT_THAT(outcome.err, HasSubstr("rays is 'fast', expected full|iterative|iterative-paper"));
}

TEST(Options, CollectRepeatedMeshes) {
  EXPECT_THAT(parse({"--mesh", "a.obj", "--mesh", "b.ply"}).parsed.options.meshes,
              ElementsAre("a.obj", "b.ply"));
}

TEST(Options, ExplainThemselvesAndSucceed) {
  const Outcome outcome = parse({"--help"});
  EXPECT_EQ(outcome.parsed.exit_code, kExitOk);
  for (const char* text : {"--objects", "--compare", "--check-rest", "Exit codes", "Examples"}) {
    EXPECT_THAT(outcome.out, HasSubstr(text));
  }
}

class WrongOptions : public testing::TestWithParam<std::vector<const char*>> {};
INSTANTIATE_TEST_SUITE_P(
    All, WrongOptions,
    testing::Values(std::vector{"--unknown"}, std::vector{"--objects", "0"},
                    std::vector{"--objects", "many"}, std::vector{"--hz", "-60"},
                    std::vector{"--hz", "0"}, std::vector{"--max-contacts", "65"},
                    std::vector{"--collider", "none"}, std::vector{"--scene", "soft"},
                    std::vector{"--config", "confidence=-1"}, std::vector{"--steps", "-1"},
                    std::vector{"--mesh"}, std::vector{"stray"}, std::vector{"--sheets", "2"},
                    std::vector{"--window", "--no-window"}, std::vector{"--window", "--check"},
                    std::vector{"--window", "--csv", "x.csv"},
                    std::vector{"--window", "--video", "x.mp4"}, std::vector{"--frames", "q.txt"},
                    std::vector{"--video", "x.avi"}, std::vector{"--record", "x.obj"},
                    std::vector{"--snapshot", "/"}, std::vector{"--csv", "/dev/null/x"},
                    std::vector{"--video", "/dev/null/a/x.mp4"}, std::vector{"--scene", "/"},
                    std::vector{"--scene", "rigid-deformable", "--compare"},
                    std::vector{"--scene", "rigid-deformable", "--collider", "ode"}));

TEST_P(WrongOptions, AreRefusedWithAMessageAndCode2) {
  const Outcome outcome = parse(GetParam());
  EXPECT_EQ(outcome.parsed.exit_code, kExitUsage);
  EXPECT_FALSE(outcome.err.empty());
}

TEST(Options, FilesThatCannotBeWrittenAreNamedWithTheReason) {
  EXPECT_THAT(parse({"--snapshot", "/"}).err, HasSubstr("cannot write '/': Is a directory"));
  EXPECT_THAT(parse({"--csv", "/dev/null/a/b"}).err,
              HasSubstr("cannot write '/dev/null/a/b': Not a directory"));
  EXPECT_THAT(parse({"--video", "a.avi"}).err,
              HasSubstr("'a.avi' must end in one of .mp4, .webm, .webp, .gif"));
}

TEST(Options, FoldersThatAreNotThereAreMade) {
  const TemporaryFolder folder("options_test");
  const std::string path = folder / "new/newer/end.obj";
  EXPECT_FALSE(parse({"--snapshot", path.c_str()}).parsed.exit_code);
  open_output(path).close();
  EXPECT_TRUE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace falling_objects
