// SPDX-License-Identifier: BSD-3-Clause
#include "opencl/self_test.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "opencl/error.h"

namespace ode_ext {
namespace {

// What a perfect device gives, for planting faults into.
struct Results {
  std::vector<SelfTestCase> cases = self_test_cases();
  std::vector<SelfTestResult> results;
  std::uint32_t counter = static_cast<std::uint32_t>(cases.size());

  Results() {
    std::uint32_t ticket = counter;
    for (const SelfTestCase& c : cases) {
      results.push_back(expected_result(c));
      results.back()[kTicket] = --ticket;  // any order will do
    }
  }

  std::string verdict() const {
    try {
      check_self_test(cases, results, counter, "a device");
    } catch (const DeviceError& error) {
      return error.what();
    }
    return "passed";
  }
};

bool mentions(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

TEST(SelfTestCheck, PassesAPerfectDevice) { EXPECT_EQ(Results().verdict(), "passed"); }

TEST(SelfTestCheck, FindsAWrongBitInAnyColumnOfAnyJudgedCase) {
  const Results perfect;
  for (std::size_t i = 0; i + 1 < perfect.cases.size(); i += 7) {
    for (int column = 0; column < kQuotient; ++column) {
      Results planted = perfect;
      const std::uint32_t good = planted.results[i][static_cast<std::size_t>(column)];
      // The lowest bit of a number; of a NaN, which may have any payload, the exponent.
      const bool is_nan = column != kComparisons && std::isnan(std::bit_cast<float>(good));
      planted.results[i][static_cast<std::size_t>(column)] ^= is_nan ? 0x40000000u : 1u;
      const std::string verdict = planted.verdict();
      EXPECT_TRUE(mentions(verdict, "a device failed the self-test"))
          << "case " << i << " column " << column << ": " << verdict;
    }
  }
}

TEST(SelfTestCheck, NamesTheProperty) {
  const auto verdict_with_fault_in = [](SelfTestColumn column) {
    Results planted;
    planted.results[100][column] ^= 1;
    return planted.verdict();
  };
  EXPECT_TRUE(mentions(verdict_with_fault_in(kProduct), "a product is not rounded"));
  EXPECT_TRUE(mentions(verdict_with_fault_in(kSum), "a sum is not rounded"));
  EXPECT_TRUE(mentions(verdict_with_fault_in(kDifference), "fused although FP_CONTRACT is off"));
  EXPECT_TRUE(mentions(verdict_with_fault_in(kProductError), "fma(a, b, -(a * b)) is not exact"));
  EXPECT_TRUE(mentions(verdict_with_fault_in(kComparisons), "a comparison"));
  EXPECT_TRUE(mentions(verdict_with_fault_in(kLargest), "a > b ? a : b"));
  EXPECT_TRUE(mentions(verdict_with_fault_in(kSmallest), "a < b ? a : b"));
  EXPECT_TRUE(mentions(verdict_with_fault_in(kVectors), "vectors give other results"));
}

TEST(SelfTestCheck, AcceptsAnyNan) {
  Results planted;
  for (SelfTestResult& result : planted.results) {
    for (int column = 0; column < kTicket; ++column) {
      std::uint32_t& word = result[static_cast<std::size_t>(column)];
      if (column != kComparisons && std::isnan(std::bit_cast<float>(word))) word = 0xffc01234u;
    }
  }
  EXPECT_EQ(planted.verdict(), "passed");
}

// As fma(0, -0, +0) on Mesa's llvmpipe.
TEST(SelfTestCheck, TakesZerosOfEitherSignForOne) {
  for (const std::uint32_t zero : {0u, 0x80000000u}) {
    Results planted;
    int zeros[kTicket] = {};
    for (SelfTestResult& result : planted.results) {
      for (int column = 0; column < kTicket; ++column) {
        std::uint32_t& word = result[static_cast<std::size_t>(column)];
        if (column == kComparisons || column == kVectors || std::bit_cast<float>(word) != 0)
          continue;
        word = zero;
        ++zeros[column];
      }
    }
    EXPECT_EQ(planted.verdict(), "passed");
    EXPECT_GT(zeros[kProductError], 10) << "nothing was shown";
    EXPECT_GT(zeros[kProduct], 10) << "nothing was shown";
  }
}

TEST(SelfTestCheck, FindsAWrongSignOfAnythingButZero) {
  const Results perfect;
  int planted_faults = 0;
  for (std::size_t i = 0; i + 1 < perfect.cases.size(); i += 3) {
    for (int column = 0; column < kQuotient; ++column) {
      const float good = std::bit_cast<float>(perfect.results[i][static_cast<std::size_t>(column)]);
      if (column == kComparisons || std::isnan(good) || good == 0) continue;
      Results planted = perfect;
      planted.results[i][static_cast<std::size_t>(column)] ^= 0x80000000u;
      ++planted_faults;
      EXPECT_NE(planted.verdict(), "passed") << "case " << i << " column " << column;
    }
  }
  EXPECT_GT(planted_faults, 1000);
}

TEST(SelfTestCheck, JudgesQuotientsWhereTheyAreInfiniteZeroOrNan) {
  const Results perfect;
  int judged = 0;
  for (std::size_t i = 0; i + 1 < perfect.cases.size(); ++i) {
    const float quotient = std::bit_cast<float>(perfect.results[i][kQuotient]);
    const bool special = !std::isfinite(quotient) || quotient == 0;
    judged += special;
    if (i % 50 != 0 && !special) continue;
    Results planted = perfect;
    planted.results[i][kQuotient] =
        std::bit_cast<std::uint32_t>(special ? 5.0f : quotient * 1.0001f);
    EXPECT_EQ(planted.verdict() != "passed", special) << quotient;
  }
  EXPECT_GT(judged, 30);
}

TEST(SelfTestCheck, FindsCountersThatLoseOrRepeat) {
  Results lost;
  --lost.counter;
  EXPECT_TRUE(mentions(lost.verdict(), "lost or gained"));
  Results repeated;
  repeated.results[1][kTicket] = repeated.results[0][kTicket];
  EXPECT_TRUE(mentions(repeated.verdict(), "gave a number twice"));
  Results far;
  far.results[1][kTicket] = 0xffffffffu;
  EXPECT_TRUE(mentions(far.verdict(), "gave a number twice"));
}

TEST(SelfTestCheck, OnlyRecordsDenormals) {
  Results flushed;
  EXPECT_TRUE(check_self_test(flushed.cases, flushed.results, flushed.counter, "").keeps_denormals);
  const std::uint32_t ticket = flushed.results.back()[kTicket];
  flushed.results.back() = {};
  flushed.results.back()[kTicket] = ticket;
  EXPECT_FALSE(
      check_self_test(flushed.cases, flushed.results, flushed.counter, "").keeps_denormals);
}

TEST(SelfTestCases, ContainDifferencesThatAreExactlyZeroOnlyIfNothingIsFused) {
  int zero = 0, not_zero_if_fused = 0;
  for (const auto& [a, b, c, d] : self_test_cases()) {
    if (std::bit_cast<float>(expected_result({a, b, c, d})[kDifference]) != 0) continue;
    ++zero;
    not_zero_if_fused += std::fma(a, b, -static_cast<float>(static_cast<double>(c) * d)) != 0;
  }
  EXPECT_GE(zero, 400);
  EXPECT_GE(not_zero_if_fused, 300);
}

// The kernels with `from` in self_test.cl replaced.
std::string changed_kernel(const std::string& from, const std::string& to) {
  std::string source = embedded_source();
  const std::size_t at = source.find(from, source.find("#line 1 \"self_test.cl\""));
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? source : source.replace(at, from.size(), to);
}

std::string verdict_of(const std::string& source) {
  Device device("");
  Program program(device, source, "");
  try {
    self_test(program);
  } catch (const DeviceError& error) {
    EXPECT_TRUE(mentions(error.what(), device.info().name.c_str())) << error.what();
    return error.what();
  }
  return "passed";
}

// scripts/test sets the variable where it runs these tests under Oclgrind: what says that nothing
// was found there has to have been there.
TEST(SelfTest, PassesHereAndUnderOclgrind) {
  Device device("");
  const bool is_oclgrind = device.info().platform_name.find("Oclgrind") != std::string::npos;
  EXPECT_EQ(is_oclgrind, std::getenv("ODE_EXT_TEST_UNDER_OCLGRIND") != nullptr);
  Program program(device, "");
  EXPECT_NO_THROW(self_test(program));
}

TEST(SelfTest, RefusesADeviceThatFuses) {
  EXPECT_TRUE(mentions(verdict_of(changed_kernel("a * b - c * d", "fma(a, b, -(c * d))")),
                       "fused although FP_CONTRACT is off"));
}

TEST(SelfTest, RefusesAnInexactFma) {
  EXPECT_TRUE(mentions(verdict_of(changed_kernel("fma(a, b, -(a * b))", "(a * b + -(a * b))")),
                       "fma(a, b, -(a * b)) is not exact"));
}

TEST(SelfTest, RefusesSelectionsThatTreatNanAsFmaxDoes) {
  EXPECT_TRUE(mentions(verdict_of(changed_kernel("a > b ? a : b", "fmax(a, b)")), "a > b ? a : b"));
}

TEST(SelfTest, RefusesVectorsThatFuse) {
  EXPECT_TRUE(mentions(verdict_of(changed_kernel("in[0] * in[1] - in[2] * in[3]",
                                                 "fma(in[0], in[1], -(in[2] * in[3]))")),
                       "vectors give other results"));
}

TEST(SelfTest, RefusesCountersThatAreNotAtomic) {
  EXPECT_TRUE(mentions(verdict_of(changed_kernel("atomic_inc(counter)", "0u")), "atomic counter"));
}

}  // namespace
}  // namespace ode_ext
