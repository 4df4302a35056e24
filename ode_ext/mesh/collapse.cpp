// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/collapse.h"

#include "mesh/box.h"
#include "mesh/ray_cast.h"

namespace ode_ext {

// Backwards all children are known, as in build_bvh.
Collapse::Collapse(const std::vector<BvhNode>& binary) : binary_(binary), least_(binary.size()) {
  for (auto n = static_cast<std::uint32_t>(binary.size()); n-- > 0;) weigh(n);
}

std::vector<std::uint32_t> Collapse::children_of(std::uint32_t node) const {
  std::vector<std::uint32_t> children;
  if (binary_[node].leaf != 0) return {node};
  const std::uint32_t left = least_[node].left_of_children;
  add_roots(node + 1, left, children);
  add_roots(binary_[node + 1].skip, kTreeWidth - left, children);
  return children;
}

void Collapse::weigh(std::uint32_t node) {
  Least& least = least_[node];
  least.left.fill(0);
  least.cost.fill(0);
  if (binary_[node].leaf != 0) return;  // costs as much wherever it is
  const Least& left = least_[node + 1];
  const Least& right = least_[binary_[node + 1].skip];
  for (std::uint32_t trees = 2; trees <= kTreeWidth; ++trees) {
    for (std::uint32_t k = 1; k < trees; ++k) {
      const float cost = left.cost[k] + right.cost[trees - k];
      if (least.left[trees] != 0 && !(cost < least.cost[trees])) continue;
      least.cost[trees] = cost;
      least.left[trees] = static_cast<std::uint8_t>(k);
    }
  }
  least.left_of_children = least.left[kTreeWidth];
  least.cost[1] =
      static_cast<float>(half_area({binary_[node].lo, binary_[node].hi})) + least.cost[kTreeWidth];
  for (std::uint32_t trees = 2; trees <= kTreeWidth; ++trees)
    if (least.cost[1] <= least.cost[trees]) {
      least.cost[trees] = least.cost[1];
      least.left[trees] = 0;
    }
}

void Collapse::add_roots(std::uint32_t node, std::uint32_t trees,
                         std::vector<std::uint32_t>& roots) const {
  const std::uint32_t left = least_[node].left[trees];
  if (left == 0) {
    roots.push_back(node);
    return;
  }
  add_roots(node + 1, left, roots);
  add_roots(binary_[node + 1].skip, trees - left, roots);
}

}  // namespace ode_ext
