// SPDX-License-Identifier: BSD-3-Clause
// A bounding volume hierarchy of sixteen children a node (Wald, Benthin, Boulos, "Getting Rid of
// Packets", 2008), over the meshlets of a mesh: a kernel asks all boxes of a node at a time.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/box.h"
#include "mesh/bvh.h"

namespace ode_ext {

inline constexpr std::uint32_t kTreeWidth = 16;

// Whoever goes down a tree and lets all other children of a node wait has never more of them.
inline constexpr std::uint32_t kTreeStack = 96;

// Child k holds the meshlets from first[k] up to first[k + 1].
struct MeshletNode {
  std::uint32_t count = 0;
  std::array<Box, kTreeWidth> boxes;
  std::array<std::uint32_t, kTreeWidth> nodes;  // kNone: it is the one meshlet
  std::array<std::uint32_t, kTreeWidth + 1> first;
};

// `top`: a tree of two children a node; its leaves, meshlet << 3 | 1, are the meshlets in their
// order. Which of its nodes stay is collapse.h's to say. The root comes first; without meshlets
// there is none.
std::vector<MeshletNode> build_meshlet_tree(const std::vector<BvhNode>& top);

}  // namespace ode_ext
