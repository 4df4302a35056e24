// SPDX-License-Identifier: BSD-3-Clause
#include "bench/accuracy/report.h"

#include <gtest/gtest.h>

#include <limits>

namespace ode_ext::accuracy {
namespace {

constexpr Trial kTrial{"some", "a trial", nullptr};

Result result_of(double most, double least) {
  const auto figures = [](double a, double b) {
    return std::vector<Figure>{{"wrong", a, at_most(1)}, {"right", b, at_least(99)}, {"size", 5}};
  };
  return {&kTrial, {figures(most, least)}, {figures(50, 50)}};
}

TEST(AccuracyReport, SaysWhetherEveryTargetIsMet) {
  EXPECT_TRUE(meets_targets(result_of(1, 99)));
  EXPECT_FALSE(meets_targets(result_of(1.1, 99)));
  EXPECT_FALSE(meets_targets(result_of(1, 98.9)));
  EXPECT_FALSE(meets_targets(result_of(std::numeric_limits<double>::quiet_NaN(), 99)));
}

TEST(AccuracyReport, HasBothCollidersAndTheTargetsInItsJson) {
  const nlohmann::json json = json_of(result_of(2, 99.5));
  EXPECT_EQ(json.at("trial"), "some");
  const auto& wrong = json.at("figures").at(0);
  EXPECT_EQ(wrong.at("ode_ext"), 2);
  EXPECT_EQ(wrong.at("stock"), 50);
  EXPECT_EQ(wrong.at("at_most"), 1);
  EXPECT_EQ(wrong.at("met"), false);
  EXPECT_EQ(json.at("figures").at(1).at("at_least"), 99);
  EXPECT_EQ(json.at("figures").at(1).at("met"), true);
  EXPECT_FALSE(json.at("figures").at(2).contains("met"));
}

}  // namespace
}  // namespace ode_ext::accuracy
