// SPDX-License-Identifier: BSD-3-Clause
// A bounding volume hierarchy in depth-first order with skip links, so that a ray needs no stack:
// a node that is hit continues with the next in memory, one that is missed with `skip`.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/triangle.h"
#include "mesh/vec.h"

namespace ode_ext {

struct BvhNode {
  Vec3f lo;
  std::uint32_t skip;  // next node if this one is missed; the node count ends the traversal
  Vec3f hi;
  std::uint32_t leaf;  // 0: inner node; else (first << 3 | count), count 1..kMaxLeafTriangles
};
static_assert(sizeof(BvhNode) == 32);

inline constexpr std::uint32_t kMaxLeafTriangles = 4;

struct Bvh {
  std::vector<BvhNode> nodes;        // empty for a mesh without triangles
  std::vector<std::uint32_t> order;  // leaves index this; it holds triangle indices
};

// Binned surface area heuristic (Wald 2007), top down, deterministic.
Bvh build_bvh(const std::vector<Vec3f>& vertices, const std::vector<Triangle>& triangles);

}  // namespace ode_ext
