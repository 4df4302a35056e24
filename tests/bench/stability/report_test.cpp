// SPDX-License-Identifier: BSD-3-Clause
#include "bench/stability/report.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "support/temporary_folder.h"

namespace ode_ext::stability {
namespace {

TEST(Report, PrintsATableWithItsColumnsInLine) {
  std::ostringstream out;
  Report report(out);
  report.table("speeds",
               {{{"body", "cube"}, {"mm/s", 0.123456789}}, {{"body", "torus"}, {"mm/s", 7}}});
  EXPECT_EQ(out.str(), "\nspeeds\n   body    mm/s\n   cube  0.1235\n  torus       7\n");
}

TEST(Report, RemembersThatATargetWasMissed) {
  std::ostringstream out;
  Report report(out);
  report.target("one", true);
  EXPECT_TRUE(report.all_met());
  report.target("two", false);
  report.target("three", true);
  EXPECT_FALSE(report.all_met());
}

TEST(Report, WritesEverythingInFull) {
  std::ostringstream out;
  Report report(out);
  report.table("speeds", {{{"mm/s", 0.123456789}}});
  report.target("still", false);
  const TemporaryFolder folder("report_test");
  const std::string path = folder / "a.json";
  report.write(path);
  std::ifstream file(path);
  const auto document = nlohmann::json::parse(file);
  EXPECT_EQ(document["tables"][0]["title"], "speeds");
  EXPECT_EQ(document["tables"][0]["rows"][0]["mm/s"], 0.123456789);
  EXPECT_EQ(document["targets"][0]["target"], "still");
  EXPECT_EQ(document["targets"][0]["met"], false);
  EXPECT_THROW(report.write("/nowhere/report.json"), std::runtime_error);
}

}  // namespace
}  // namespace ode_ext::stability
