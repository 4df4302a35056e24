// SPDX-License-Identifier: BSD-3-Clause
#include "support/validate_bvh.h"

#include <algorithm>
#include <cstdint>

namespace ode_ext::test {
namespace {

// Written so that a NaN is outside.
bool holds(const BvhNode& node, Vec3f point) {
  return node.lo.x <= point.x && point.x <= node.hi.x && node.lo.y <= point.y &&
         point.y <= node.hi.y && node.lo.z <= point.z && point.z <= node.hi.z;
}

class Validator {
 public:
  Validator(const Bvh& bvh, const std::vector<Vec3f>& vertices,
            const std::vector<Triangle>& triangles)
      : bvh_(bvh), vertices_(vertices), triangles_(triangles), seen_(triangles.size()) {}

  // The fault found first, or "".
  std::string run() {
    if (bvh_.order.size() != triangles_.size()) return "the order has another length than the mesh";
    if (bvh_.nodes.empty() != triangles_.empty()) return "a mesh without triangles has no nodes";
    if (!bvh_.nodes.empty() && bvh_.nodes[0].skip != bvh_.nodes.size()) {
      return "the root does not skip to the end";
    }
    // That every node is the child of exactly one follows: the node before it is its parent, or a
    // leaf that skips to it, and a leaf skips to where its nearest left ancestor (or itself) does.
    for (std::uint32_t i = 0; i < bvh_.nodes.size(); ++i) {
      const std::string fault = bvh_.nodes[i].leaf != 0 ? check_leaf(i) : check_inner(i);
      if (!fault.empty()) return at(i) + fault;
    }
    const auto missing = std::find(seen_.begin(), seen_.end(), false);
    if (missing != seen_.end()) {
      return "triangle " + std::to_string(missing - seen_.begin()) + " is in no leaf";
    }
    return "";
  }

 private:
  static std::string at(std::uint32_t node) { return "node " + std::to_string(node) + " "; }

  std::string check_inner(std::uint32_t i) const {
    const BvhNode& node = bvh_.nodes[i];
    const std::size_t count = bvh_.nodes.size();
    const std::uint32_t left = i + 1;
    if (left >= count) return "has no left child";
    const std::uint32_t right = bvh_.nodes[left].skip;
    if (right <= left || right >= count) return "has no right child";
    if (bvh_.nodes[right].skip != node.skip) return "does not skip to where its right child does";
    for (const std::uint32_t child : {left, right}) {
      if (!holds(node, bvh_.nodes[child].lo) || !holds(node, bvh_.nodes[child].hi)) {
        return "does not hold its child " + std::to_string(child);
      }
    }
    return "";
  }

  std::string check_leaf(std::uint32_t i) {
    const BvhNode& node = bvh_.nodes[i];
    if (node.skip != i + 1) return "is a leaf and does not skip to the next node";
    const std::size_t first = node.leaf >> 3;
    const std::size_t count = node.leaf & 7;
    if (count == 0 || count > kMaxLeafTriangles) return "has a wrong number of triangles";
    if (first + count > bvh_.order.size()) return "leaves the order";
    for (std::size_t k = first; k < first + count; ++k) {
      const std::uint32_t triangle = bvh_.order[k];
      if (triangle >= triangles_.size()) return "names a triangle that does not exist";
      if (seen_[triangle]) return "repeats triangle " + std::to_string(triangle);
      seen_[triangle] = true;
      for (const std::uint32_t corner : triangles_[triangle]) {
        if (corner >= vertices_.size()) return "has a triangle with a corner that does not exist";
        if (!holds(node, vertices_[corner])) {
          return "does not hold its triangle " + std::to_string(triangle);
        }
      }
    }
    return "";
  }

  const Bvh& bvh_;
  const std::vector<Vec3f>& vertices_;
  const std::vector<Triangle>& triangles_;
  std::vector<bool> seen_;  // triangles met in leaves
};

}  // namespace

std::string validate_bvh(const Bvh& bvh, const std::vector<Vec3f>& vertices,
                         const std::vector<Triangle>& triangles) {
  return Validator(bvh, vertices, triangles).run();
}

}  // namespace ode_ext::test
