// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/meshlet_tree.h"

#include <algorithm>

#include "mesh/box.h"
#include "mesh/collapse.h"

namespace ode_ext {
namespace {

// Meshlets that follow one another, and the node of `top` that holds these, if there is one.
struct Part {
  std::uint32_t first, end;
  std::uint32_t node;  // kNone: none
};

class TreeBuilder {
 public:
  explicit TreeBuilder(const std::vector<BvhNode>& top)
      : top_(top), collapse_(top), parts_(top.size()) {
    std::uint32_t meshlets = 0;
    for (const BvhNode& node : top)
      if (node.leaf != 0) {
        boxes_.push_back({node.lo, node.hi});
        ++meshlets;
      }
    // Backwards all children are known, as in build_bvh.
    for (auto n = static_cast<std::uint32_t>(top.size()); n-- > 0;) {
      if (top[n].leaf != 0) {
        --meshlets;
        parts_[n] = {meshlets, meshlets + 1, n};
      } else {
        parts_[n] = {parts_[n + 1].first, parts_[top[n + 1].skip].end, n};
      }
    }
  }

  std::vector<MeshletNode> build() {
    if (top_.empty()) return {};
    std::vector<MeshletNode> tree = divide(parts_[0]);
    // Where most of it could not follow the boxes, one that is even all through is shallower.
    if (2 * evenly_ > boxes_.size()) tree = divide({parts_[0].first, parts_[0].end, kNone});
    return tree;
  }

 private:
  // Parents before their children.
  std::vector<MeshletNode> divide(const Part& whole) {
    std::vector<MeshletNode> tree;
    struct Pending {
      Part part;
      std::uint32_t parent, child;
      std::uint32_t places;  // for children that wait, its own included
    };
    std::vector<Pending> pending{{whole, kNone, 0, kTreeStack}};
    while (!pending.empty()) {
      const Pending next = pending.back();
      pending.pop_back();
      const auto place = static_cast<std::uint32_t>(tree.size());
      if (next.parent != kNone) tree[next.parent].nodes[next.child] = place;
      const std::vector<Part> parts = divided(next.part, next.places);
      const std::uint32_t places = places_below(parts, next.places);
      MeshletNode& node = tree.emplace_back();
      node.count = static_cast<std::uint32_t>(parts.size());
      node.boxes.fill(empty_box());
      node.nodes.fill(kNone);
      node.first.fill(next.part.end);
      for (std::uint32_t k = 0; k < node.count; ++k) {
        node.first[k] = parts[k].first;
        for (std::uint32_t i = parts[k].first; i < parts[k].end; ++i)
          node.boxes[k] = grown(node.boxes[k], boxes_[i]);
        if (parts[k].end - parts[k].first > 1) pending.push_back({parts[k], place, k, places});
      }
    }
    return tree;
  }

  // Where each triangle is ten times as large as the one before, a tree is as deep as it has
  // leaves: what is left of a branch is divided evenly while there are places enough for that.
  std::vector<Part> divided(const Part& part, std::uint32_t places) {
    if (part.node == kNone) return divided_evenly(part);
    std::vector<Part> parts;
    for (const std::uint32_t node : collapse_.children_of(part.node)) parts.push_back(parts_[node]);
    const std::uint32_t left = places_below(parts, places);
    const bool fits = std::all_of(parts.begin(), parts.end(), [&](const Part& child) {
      return places_of_even(child.end - child.first) <= left;
    });
    if (fits) return parts;
    evenly_ += part.end - part.first;
    return divided_evenly(part);
  }

  // While the children of a node are gone through, those not yet begun wait.
  static std::uint32_t places_below(const std::vector<Part>& parts, std::uint32_t places) {
    return places - (static_cast<std::uint32_t>(parts.size()) - 1);
  }

  // Evenly divided: 6 * 15 + 1 for 16^6 meshlets.
  static std::uint32_t places_of_even(std::uint32_t meshlets) {
    std::uint32_t places = 1;
    for (; meshlets > 1; meshlets = (meshlets + kTreeWidth - 1) / kTreeWidth)
      places += std::min(meshlets, kTreeWidth) - 1;
    return places;
  }

  static std::vector<Part> divided_evenly(const Part& part) {
    const std::uint32_t count = part.end - part.first;
    const std::uint32_t parts = std::min(count, kTreeWidth);
    std::vector<Part> result;
    for (std::uint64_t k = 0; k < parts; ++k)
      result.push_back({part.first + static_cast<std::uint32_t>(k * count / parts),
                        part.first + static_cast<std::uint32_t>((k + 1) * count / parts), kNone});
    return result;
  }

  const std::vector<BvhNode>& top_;
  Collapse collapse_;
  std::vector<Part> parts_;  // of its nodes
  std::vector<Box> boxes_;   // of the meshlets
  std::size_t evenly_ = 0;   // meshlets of parts that do not follow the boxes
};

}  // namespace

std::vector<MeshletNode> build_meshlet_tree(const std::vector<BvhNode>& top) {
  return TreeBuilder(top).build();
}

}  // namespace ode_ext
