// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/meshlet_tree.h"

#include <algorithm>

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
    emit(parts_[0]);
    // Where each triangle is ten times as large as the one before, a tree is as deep as it has
    // leaves. Parts of equal numbers need 6 * 15 + 1 places for 16^6 meshlets.
    if (places_needed() > kTreeStack) {
      tree_.clear();
      emit({parts_[0].first, parts_[0].end, kNone});
    }
    return std::move(tree_);
  }

 private:
  // The tree of a part, parents before their children.
  void emit(const Part& whole) {
    struct Pending {
      Part part;
      std::uint32_t parent, child;
    };
    std::vector<Pending> pending{{whole, kNone, 0}};
    while (!pending.empty()) {
      const Pending next = pending.back();
      pending.pop_back();
      const auto place = static_cast<std::uint32_t>(tree_.size());
      if (next.parent != kNone) tree_[next.parent].nodes[next.child] = place;
      const std::vector<Part> parts =
          next.part.node == kNone ? divided_evenly(next.part) : divided(next.part);
      MeshletNode& node = tree_.emplace_back();
      node.count = static_cast<std::uint32_t>(parts.size());
      node.boxes.fill(empty_box());
      node.nodes.fill(kNone);
      node.first.fill(next.part.end);
      for (std::uint32_t k = 0; k < node.count; ++k) {
        node.first[k] = parts[k].first;
        for (std::uint32_t i = parts[k].first; i < parts[k].end; ++i)
          node.boxes[k] = grown(node.boxes[k], boxes_[i]);
        if (parts[k].end - parts[k].first > 1) pending.push_back({parts[k], place, k});
      }
    }
  }

  std::vector<Part> divided(const Part& part) const {
    std::vector<Part> parts;
    for (const std::uint32_t node : collapse_.children_of(part.node)) parts.push_back(parts_[node]);
    return parts;
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

  // While the children of a node are gone through, those not yet begun wait.
  std::uint32_t places_needed() const {
    std::vector<std::uint32_t> needed(tree_.size());
    for (std::size_t n = tree_.size(); n-- > 0;) {
      std::uint32_t below = 1;
      for (std::uint32_t k = 0; k < tree_[n].count; ++k)
        if (tree_[n].nodes[k] != kNone) below = std::max(below, needed[tree_[n].nodes[k]]);
      needed[n] = tree_[n].count - 1 + below;
    }
    return needed[0];
  }

  const std::vector<BvhNode>& top_;
  Collapse collapse_;
  std::vector<Part> parts_;  // of its nodes
  std::vector<Box> boxes_;   // of the meshlets
  std::vector<MeshletNode> tree_;
};

}  // namespace

std::vector<MeshletNode> build_meshlet_tree(const std::vector<BvhNode>& top) {
  return TreeBuilder(top).build();
}

}  // namespace ode_ext
