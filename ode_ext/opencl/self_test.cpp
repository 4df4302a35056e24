// SPDX-License-Identifier: BSD-3-Clause
#include "opencl/self_test.h"

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>

#include "opencl/error.h"

namespace ode_ext {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr std::uint32_t kNanBits = 0x7fc00000;

// NaNs have many patterns, and a device may give any of them. Zeros are compared by value: some
// drivers (Mesa's Rusticl on llvmpipe) give fma(0, -0, +0) the wrong sign, and no kernel can tell.
// They compare floats, which takes both zeros for one; none looks at the bits of one; and those
// that divide by what may be zero ask for that first (lib/cull.h, lib/ray_triangle.h).
std::uint32_t bits_of(float value) {
  if (std::isnan(value)) return kNanBits;
  return value == 0 ? 0 : std::bit_cast<std::uint32_t>(value);
}

std::uint32_t canonical(std::uint32_t bits) { return bits_of(std::bit_cast<float>(bits)); }

// A product of two floats (24 bits each) is exact in double (53 bits), so that the one rounding is
// the cast's, whatever the host's compiler may fuse.
float product(float a, float b) { return static_cast<float>(static_cast<double>(a) * b); }

// Likewise: a double has more than twice a float's bits plus two, so rounding twice is rounding
// once.
float sum(float a, float b) { return static_cast<float>(static_cast<double>(a) + b); }

// Numbers of both signs with all 24 bits in use and magnitudes from 2^-8 to 2^8: products and their
// rounding errors (down to 2^-16 * 2^-46) stay far from denormals (2^-126).
class Numbers {
 public:
  float next() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;  // Knuth's MMIX generator
    const auto random = static_cast<std::uint32_t>(state_ >> 32);
    const std::uint32_t exponent = 127 - 8 + (random >> 23) % 16;
    return std::bit_cast<float>((random & 0x80000000u) | exponent << 23 | (random & 0x7fffffu));
  }

 private:
  std::uint64_t state_ = 1;
};

struct Property {
  SelfTestColumn column;
  const char* broken;
};

// The simplest first: what is reported is the cause, not what follows from it.
constexpr Property kProperties[] = {
    {kProduct, "a product is not rounded as IEEE 754 asks"},
    {kSum, "a sum is not rounded as IEEE 754 asks"},
    {kDifference, "a * b - c * d is fused although FP_CONTRACT is off"},
    {kProductError, "fma(a, b, -(a * b)) is not exact"},
    {kComparisons, "a comparison (with NaN, infinity or zero perhaps) comes out wrong"},
    {kLargest, "a > b ? a : b is not what C makes it"},
    {kSmallest, "a < b ? a : b is not what C makes it"},
    {kQuotient, "a division by zero, infinity or NaN comes out wrong"},
    {kVectors, "vectors give other results than single floats"},
};

// OpenCL lets a finite quotient be off by 2.5 ulp, and nothing in the collider needs it better.
bool is_judged(SelfTestColumn column, const SelfTestCase& c) {
  if (column != kQuotient) return true;
  const float quotient = c[0] / c[1];
  return !std::isfinite(quotient) || quotient == 0;
}

[[noreturn]] void refuse(const std::string& device, const std::string& what) {
  throw DeviceError(0,
                    device + " failed the self-test: " + what +
                        ". Its results could not be trusted: update the driver or choose another "
                        "device with ODE_EXT_DEVICE.");
}

std::string in_words(const SelfTestCase& c, std::uint32_t result, std::uint32_t expected) {
  char text[160];
  std::snprintf(text, sizeof(text), " (a = %a, b = %a, c = %a, d = %a gave 0x%08x, not 0x%08x)",
                c[0], c[1], c[2], c[3], result, expected);
  return text;
}

}  // namespace

std::vector<SelfTestCase> self_test_cases() {
  std::vector<SelfTestCase> cases;
  const float special[] = {0.0f, -0.0f, 1.0f, -1.0f, 3.5f, kInfinity, -kInfinity, kNan};
  for (float a : special) {
    for (float b : special) cases.push_back({a, b, b, a});
  }
  Numbers numbers;
  for (int i = 0; i < 400; ++i) {
    const float a = numbers.next(), b = numbers.next(), c = numbers.next(), d = numbers.next();
    cases.push_back({a, b, b, a});                             // the difference is exactly 0
    cases.push_back({a, b, std::nextafter(b, kInfinity), a});  // it cancels nearly
    cases.push_back({a, b, c, d});
  }
  cases.push_back({FLT_MIN, 0.5f, 0.0f, 0.0f});
  return cases;
}

SelfTestResult expected_result(const SelfTestCase& values) {
  const auto [a, b, c, d] = values;
  const float ab = product(a, b);
  SelfTestResult result{};
  result[kProduct] = bits_of(ab);
  result[kSum] = bits_of(sum(a, c));
  result[kDifference] = bits_of(sum(ab, -product(c, d)));
  result[kProductError] = bits_of(std::fma(a, b, -ab));
  result[kComparisons] = (a < b ? 1u : 0u) | (a <= b ? 2u : 0u) | (a > b ? 4u : 0u) |
                         (a >= b ? 8u : 0u) | (a == b ? 16u : 0u) | (a != b ? 32u : 0u);
  result[kLargest] = bits_of(a > b ? a : b);
  result[kSmallest] = bits_of(a < b ? a : b);
  result[kQuotient] = bits_of(a / b);
  result[kVectors] = 1;
  return result;
}

SelfTestReport check_self_test(const std::vector<SelfTestCase>& cases,
                               const std::vector<SelfTestResult>& results, std::uint32_t counter,
                               const std::string& device) {
  const std::size_t judged = cases.size() - 1;
  for (const auto& [column, broken] : kProperties) {
    for (std::size_t i = 0; i < judged; ++i) {
      const std::uint32_t expected = expected_result(cases[i])[column];
      const std::uint32_t result = column == kComparisons || column == kVectors
                                       ? results[i][column]
                                       : canonical(results[i][column]);
      if (result != expected && is_judged(column, cases[i])) {
        refuse(device, broken + in_words(cases[i], result, expected));
      }
    }
  }
  std::vector<bool> drawn(cases.size(), false);
  for (const SelfTestResult& result : results) {
    const std::uint32_t ticket = result[kTicket];
    if (ticket >= drawn.size() || drawn[ticket])
      refuse(device, "an atomic counter gave a number twice");
    drawn[ticket] = true;
  }
  if (counter != cases.size()) refuse(device, "an atomic counter lost or gained a count");
  return {.keeps_denormals = std::bit_cast<float>(results.back()[kProduct]) != 0};
}

void self_test_groups(Program& of_groups, std::uint32_t items) {
  constexpr std::size_t kGroups = 4;
  Device& device = of_groups.device();
  std::vector<cl_uint> agrees(kGroups * items, 0);
  Kernel kernel(of_groups, "self_test_group");
  Buffer there(device, Memory::kDevice);
  there.reserve(agrees.size() * sizeof(cl_uint));
  there.fill_zero(agrees.size() * sizeof(cl_uint));
  kernel.launch(kGroups, items, there);
  there.read(agrees.data(), agrees.size() * sizeof(cl_uint));
  device.finish();
  if (std::find(agrees.begin(), agrees.end(), 0u) != agrees.end())
    refuse(device.label(), "work-items of a group do not hand values on to one another");
}

SelfTestReport self_test(Program& program) {
  constexpr std::size_t kLocal = 64;
  Device& device = program.device();
  const std::vector<SelfTestCase> cases = self_test_cases();
  std::vector<SelfTestResult> results(cases.size());
  std::uint32_t counter = 0;
  Kernel kernel(program, "self_test");
  // As a pass does it, through memory that is shared if the device says so.
  Buffer inputs(device, Memory::kShared), outputs(device, Memory::kShared),
      counters(device, Memory::kShared);
  HostView results_there(device), counter_there(device);
  inputs.reserve(cases.size() * sizeof(SelfTestCase));
  outputs.reserve(cases.size() * sizeof(SelfTestResult));
  counters.reserve(sizeof(counter));

  inputs.write(cases.data(), cases.size() * sizeof(SelfTestCase));
  outputs.fill_zero(cases.size() * sizeof(SelfTestResult));
  counters.fill_zero(sizeof(counter));
  kernel.launch((cases.size() + kLocal - 1) / kLocal, kLocal, inputs,
                static_cast<cl_uint>(cases.size()), outputs, counters);
  results_there.reserve(outputs, results.size() * sizeof(SelfTestResult));
  counter_there.reserve(counters, sizeof(counter));
  results_there.read(outputs, results.size() * sizeof(SelfTestResult));
  counter_there.read(counters, sizeof(counter));
  device.finish();
  std::memcpy(results.data(), results_there.data(), results.size() * sizeof(SelfTestResult));
  std::memcpy(&counter, counter_there.data(), sizeof(counter));
  return check_self_test(cases, results, counter, device.label());
}

}  // namespace ode_ext
