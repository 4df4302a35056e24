// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "pipeline/prediction.h"

namespace ode_ext {

enum class Workload { kPredicted, kExact };

struct ColliderOptions {
  std::string device;  // see choose_device
  std::uint32_t max_contacts = 16;
  Workload workload = Workload::kPredicted;
  PredictionRule prediction = PredictionRule::kPairScaled;
  double confidence = 1.2;
  std::uint32_t work_group_size = 64;
  std::uint64_t initial_capacity = 16384;  // [records] of each append buffer
  // Pairs are collided in tiles of at most this many vertices (whole chunks counted), so that no
  // counter and no index passes 2^32.
  std::uint64_t tile_vertices = std::uint64_t{1} << 31;
};

// The largest max_contacts (OX_MAX_CONTACTS in contact_step.cl).
inline constexpr std::uint32_t kMaxContacts = 64;

}  // namespace ode_ext
