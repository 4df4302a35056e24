// SPDX-License-Identifier: BSD-3-Clause
// Which nodes of a tree of two children a node stay when it becomes one of sixteen: those of which
// the areas sum up to the least, since what goes down a tree looks at a node in proportion to the
// area of its box. By dynamic programming (Ylitie, Karras, Laine, "Efficient Incoherent Ray
// Traversal on GPUs Through Compressed Wide BVHs", 2017).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/bvh.h"
#include "mesh/meshlet_tree.h"

namespace ode_ext {

class Collapse {
 public:
  explicit Collapse(const std::vector<BvhNode>& binary);

  // The nodes that become the children of one that stays, kTreeWidth at most, in order.
  std::vector<std::uint32_t> children_of(std::uint32_t node) const;

 private:
  // What is below a node costs least as so many trees, at most, whose roots are children of one
  // node: the sum of the areas of all nodes in them.
  struct Least {
    std::array<float, kTreeWidth + 1> cost;         // by the number of trees; [0] is unused
    std::array<std::uint8_t, kTreeWidth + 1> left;  // how many of them are of the left child; 0:
                                                    // it is one tree
    std::uint8_t left_of_children;                  // the same of its own children
  };

  void weigh(std::uint32_t node);
  void add_roots(std::uint32_t node, std::uint32_t trees, std::vector<std::uint32_t>& roots) const;

  const std::vector<BvhNode>& binary_;
  std::vector<Least> least_;  // of each node
};

}  // namespace ode_ext
