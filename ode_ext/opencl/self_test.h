// SPDX-License-Identifier: BSD-3-Clause
// The cases of the self-test and the check of its results: no OpenCL calls, so that it can be
// tested with results that no device at hand would give.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "opencl/program.h"

namespace ode_ext {

// What kernels/self_test.cl writes for a case {a, b, c, d}, one word each.
enum SelfTestColumn {
  kProduct,         // a * b
  kSum,             // a + c
  kDifference,      // a * b - c * d
  kProductError,    // fma(a, b, -(a * b))
  kComparisons,     // bits: < <= > >= == !=
  kLargest,         // a > b ? a : b
  kSmallest,        // a < b ? a : b
  kQuotient,        // a / b
  kVectors,         // 1: lane by lane the same as single floats (lib/lanes.h)
  kTicket,          // what the counter stood at
  kSelfTestColumns  // their number
};

using SelfTestCase = std::array<float, 4>;
using SelfTestResult = std::array<std::uint32_t, kSelfTestColumns>;

// Always the same. The last one has a denormal product and is only recorded, not judged.
std::vector<SelfTestCase> self_test_cases();

// What a device that does what OpenCL 1.2 and IEEE 754 ask for gives; every NaN is 0x7fc00000,
// every zero +0.
SelfTestResult expected_result(const SelfTestCase& c);

// Throws DeviceError naming `device`, the property that does not hold and a case that shows it.
SelfTestReport check_self_test(const std::vector<SelfTestCase>& cases,
                               const std::vector<SelfTestResult>& results, std::uint32_t counter,
                               const std::string& device);

}  // namespace ode_ext
