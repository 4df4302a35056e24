// SPDX-License-Identifier: BSD-3-Clause
#include "bench/accuracy/markdown.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace ode_ext::accuracy {
namespace {

nlohmann::json row(const char* pair, double share, double worst) {
  return {{"pair", pair},       {"share", share},       {"none", 0},
          {"depth_99", 1},      {"depth_worst", worst}, {"angle_99", 2},
          {"angle_worst", 3.5}, {"pairs", 7},           {"contacts", 4}};
}

TEST(Markdown, PutsBothCollidersIntoARowOfTheTableOfItsDepth) {
  const std::string text =
      markdown_of({row("cube on cone", 0.01, 12.34), row("cube on cone", 0.1, 5)},
                  {row("cube on cone", 0.01, 1234.5), row("cube on cone", 0.1, 6)});
  EXPECT_NE(text.find("; 7 pairs a row.\n"), std::string::npos);
  EXPECT_NE(text.find("\n1 % of the smaller size deep"), std::string::npos);
  EXPECT_NE(text.find("\n10 % of the smaller size deep"), std::string::npos);
  EXPECT_NE(text.find("| cube on cone | 0.00 / 0.00 | 1.00 / 1.00 | 12.3 / 1234 | 2.00 / 2.00 |"),
            std::string::npos)
      << text;
}

std::string page_with(const std::string& between) {
  return std::string("# Page\n")
      .append(kBeginMarker)
      .append("\n")
      .append(between)
      .append(kEndMarker)
      .append("\nThe rest.\n");
}

TEST(Markdown, ReplacesWhatIsBetweenTheMarkersAndNothingElse) {
  EXPECT_EQ(with_table(page_with("old\n"), "new\n"), page_with("new\n"));
  EXPECT_EQ(with_table(page_with(""), "new\n"), page_with("new\n"));
}

TEST(Markdown, RefusesAPageWithoutMarkers) {
  EXPECT_THROW(with_table("# Page\n", "new\n"), std::runtime_error);
  const std::string wrong_way_round = std::string(kEndMarker).append(kBeginMarker);
  EXPECT_THROW(with_table(wrong_way_round, "new\n"), std::runtime_error);
}

}  // namespace
}  // namespace ode_ext::accuracy
