// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "opencl/error.h"

namespace ode_ext {

// What is timed on the device; what each is called in public is in ode/pass_stats.cpp.
enum class Stage : std::size_t {
  kDeformStep,
  kPairStep,
  kVertexStep,
  kIterativeRays,
  kBvhRays,
  kBasicRays,
  kMonolithic,
  kCull,
  kMatch,
  kCross,
  kFlood,
  kAssembly,
  kContactStep,
  kWholeStep
};
inline constexpr std::size_t kStageCount = 14;
using StageTimes = std::array<double, kStageCount>;  // [ms]

// Adds what a step took on the device since the last time. A clock that cannot be read is no reason
// to lose contacts: that adds nothing.
template <class Step>
void add_time(StageTimes& ms, Stage stage, Step& step) {
  try {
    ms[static_cast<std::size_t>(stage)] += step.take_milliseconds();
  } catch (const DeviceError&) {
  }
}

}  // namespace ode_ext
