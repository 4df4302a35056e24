// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace ode_ext {

// The append lists, in the order of the steps. The order is public (dBatchBuffer...).
enum class List : std::size_t {
  kChunksSmall,
  kChunks,
  kChunksDeformable,
  kRaysIterative,
  kRays,
  kRaysBasic,
  kMeshlets,
  kMeshletPairs,
  kHits,
  kCrossings,
  kFloodWords,
  kContacts
};
inline constexpr std::size_t kListCount = 12;
using ListCounts = std::array<std::uint64_t, kListCount>;  // [records]

}  // namespace ode_ext
