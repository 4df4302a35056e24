// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "abi/types.h"
#include "collide/prediction.h"
#include "opencl/device.h"

namespace ode_ext {

enum class LaunchRule { kPredicted, kExact };
enum class Rays { kFull, kIterative, kIterativePaper };
enum class DeformableTarget { kRefit, kBasic };
enum class Organization { kPipelined, kMonolithic };
enum class Lanes { kOfDevice, kVectors, kItems };
enum class Misprediction { kRedo, kIgnore, kBacktrack };

struct ColliderOptions {
  std::string device;  // see choose_device
  std::uint32_t max_contacts = 16;
  std::uint32_t max_contacts_deformable = 0;  // 0: all
  Rays rays = Rays::kFull;
  DeformableTarget deformable_target = DeformableTarget::kRefit;
  Organization organization = Organization::kPipelined;
  LaunchRule launches = LaunchRule::kPredicted;
  PredictionRule prediction = PredictionRule::kPairScaled;
  Misprediction misprediction = Misprediction::kRedo;
  double confidence = 1.2;
  std::uint32_t work_group_size = 64;
  std::uint64_t initial_capacity = 16384;  // [records] of each append list
  std::uint32_t walk_limit = 32;           // triangles an iterative ray crosses at most
  float displacement_limit = 1;            // [mean edges of the target] for iterative rays
  bool edges = true;                       // crossings of edges are searched too
  std::uint32_t vector_width = 0;          // 1, 4, 8 or 16 (lib/lanes.h); 0: what suits the device
  bool builtins = true;  // the processor's own, where lib/lanes.h knows some; the same bytes
  // Whether a work-item takes all lanes of a meshlet as vectors, or a block of them (cross.cl); and
  // where it would go through much alone, whether a work-group does so together
  // (kernels/lib/group.h). kOfDevice: vectors on a processor, groups where NVIDIA's device can and
  // its driver builds them, else items. The same bytes.
  Lanes lanes = Lanes::kOfDevice;
  bool count_work = false;
  // On a processor each pair is taken through all steps by one work-item (kernels/whole_step.cl).
  // The same bytes.
  bool whole_steps = true;
  // Pairs are collided in tiles of at most this many vertices (whole chunks counted), so that none
  // of their counters and indices passes 2^32.
  std::uint64_t tile_vertices = std::uint64_t{1} << 29;
  std::uint64_t largest_buffer = 0;  // [bytes] as Device takes it
  bool share_memory = true;          // as Device takes may_share; the same bytes
};

// Whether vertices are looked at one by one, as in the paper (paper/vertex_rays.h); else crossings
// of edges tell which of them are inside (kernels/flood.cl), of which none may be lost.
inline bool follows_paper(const ColliderOptions& options) {
  return !options.edges || options.rays != Rays::kFull ||
         options.deformable_target != DeformableTarget::kRefit ||
         options.organization != Organization::kPipelined ||
         options.misprediction != Misprediction::kRedo || options.count_work;
}

// From compute capability 7 on work-items of a warp that went separate ways meet again at the
// instructions that kernels/lib/group.h has; before, they have to have met.
inline bool lanes_are_groups(const ColliderOptions& options, const DeviceInfo& device) {
  return options.lanes == Lanes::kOfDevice && device.compute_capability >= 7 &&
         device.work_group_limit >= OX_LANES;
}

// The largest max_contacts (OX_MAX_CONTACTS in kernels/contacts/candidate_list.h).
inline constexpr std::uint32_t kMaxContacts = 64;

}  // namespace ode_ext
