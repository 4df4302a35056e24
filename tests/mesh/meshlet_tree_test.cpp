// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/meshlet_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh/box.h"
#include "mesh/mesh.h"
#include "mesh/ray_cast.h"
#include "support/test_scene.h"

namespace ode_ext {
namespace {

// Clusters of 64 triangles, each cluster and its distance twice as large as the one before: a tree
// of small boxes parts one or two of them from the rest at a time.
TriangleSoup ever_larger(int clusters) {
  TriangleSoup soup;
  for (int c = 0; c < clusters; ++c) {
    const float size = std::ldexp(1.0f, c);
    for (int i = 0; i < 64; ++i) {
      const float x = size * (1 + 0.005f * static_cast<float>(i));
      const float y = size * 0.005f * static_cast<float>(i % 8);
      soup.insert(soup.end(), {{x, y, 0}, {x + 0.002f * size, y, 0}, {x, y, 0.002f * size}});
    }
  }
  return soup;
}

std::vector<TriangleSoup> tree_soups() {
  return {test::soup_of(test::make_cube(1)), test::soup_of(test::make_icosphere(1, 5)),
          test::soup_of(test::make_torus(1, 0.3, 40, 20)), test::soup_of(test::make_sheet(2, 9)),
          ever_larger(60)};
}

// Below a node, its own included, when the children of each wait in the worst order.
std::uint32_t most_waiting(const std::vector<MeshletNode>& tree, std::uint32_t n) {
  std::uint32_t most = tree[n].count;
  for (std::uint32_t k = 0; k < tree[n].count; ++k)
    if (tree[n].nodes[k] != kNone)
      most = std::max(most, tree[n].count - 1 + most_waiting(tree, tree[n].nodes[k]));
  return most;
}

std::uint32_t depth(const std::vector<MeshletNode>& tree, std::uint32_t n) {
  std::uint32_t deepest = 0;
  for (std::uint32_t k = 0; k < tree[n].count; ++k)
    if (tree[n].nodes[k] != kNone) deepest = std::max(deepest, depth(tree, tree[n].nodes[k]));
  return deepest + 1;
}

// Visits the meshlets below a node, in order.
void expect_below(const Mesh& mesh, std::uint32_t n, std::uint32_t first, std::uint32_t end) {
  const MeshletNode& node = mesh.topology->meshlets.tree[n];
  ASSERT_GE(node.count, 1u);
  ASSERT_LE(node.count, kTreeWidth);
  EXPECT_EQ(node.first[0], first);
  EXPECT_EQ(node.first[node.count], end);
  for (std::uint32_t k = 0; k < node.count; ++k) {
    ASSERT_LT(node.first[k], node.first[k + 1]);
    Box box = empty_box();
    for (std::uint32_t m = node.first[k]; m < node.first[k + 1]; ++m) {
      const Meshlet& meshlet = mesh.topology->meshlets.meshlets[m];
      for (std::uint32_t i = 0; i < meshlet.vertex_count; ++i)
        box = grown(box, mesh.vertices[mesh.topology->meshlets.vertices[meshlet.vertex_first + i]]);
    }
    EXPECT_EQ(node.boxes[k].lo, box.lo);
    EXPECT_EQ(node.boxes[k].hi, box.hi);
    if (node.nodes[k] == kNone)
      EXPECT_EQ(node.first[k + 1], node.first[k] + 1);
    else
      expect_below(mesh, node.nodes[k], node.first[k], node.first[k + 1]);
  }
}

TEST(MeshletTree, HoldsEachMeshletOnceInTheTightestBoxes) {
  for (const TriangleSoup& soup : tree_soups()) {
    const Mesh mesh = build_mesh(soup);
    expect_below(mesh, 0, 0, static_cast<std::uint32_t>(mesh.topology->meshlets.meshlets.size()));
  }
}

TEST(MeshletTree, NeverHasMoreChildrenWaitThanAKernelHasRoomFor) {
  for (const TriangleSoup& soup : tree_soups()) {
    const Mesh mesh = build_mesh(soup);
    EXPECT_LE(most_waiting(mesh.topology->meshlets.tree, 0), kTreeStack);
  }
}

// Each leaf has twice the box of the one before: parted by their boxes, thousands are as many
// levels.
std::vector<BvhNode> degenerate_tree(std::uint32_t leaves) {
  std::vector<BvhNode> top;
  for (std::uint32_t i = 0; i + 1 < leaves; ++i) {
    const auto size = static_cast<float>(leaves - i);
    top.push_back({{0, 0, 0}, 2 * leaves - 1, {size, size, size}, 0});
    top.push_back({{0, 0, 0}, 2 * i + 2, {1, 1, 1}, i << 3 | 1u});
  }
  top.push_back({{0, 0, 0}, 2 * leaves - 1, {1, 1, 1}, (leaves - 1) << 3 | 1u});
  return top;
}

TEST(MeshletTree, OfADegenerateTreeOfTwoChildrenIsShallow) {
  const std::vector<MeshletNode> tree = build_meshlet_tree(degenerate_tree(5000));
  EXPECT_LE(most_waiting(tree, 0), kTreeStack);
  EXPECT_LE(depth(tree, 0), 4u);  // 16^4 > 5000
}

// Leaves side by side, as many as 2^levels, and half as many on either side at each level.
std::vector<BvhNode> even_tree(std::uint32_t levels) {
  std::vector<BvhNode> top;
  const auto add = [&](const auto& self, float lo, float size, std::uint32_t depth) -> void {
    const std::size_t place = top.size();
    top.push_back({{lo, 0, 0}, 0, {lo + size, 1, 1}, 0});
    if (depth == levels) {
      const auto leaves =
          std::count_if(top.begin(), top.end(), [](auto& n) { return n.leaf != 0; });
      top[place].leaf = static_cast<std::uint32_t>(leaves) << 3 | 1u;
    } else {
      self(self, lo, size / 2, depth + 1);
      self(self, lo + size / 2, size / 2, depth + 1);
    }
    top[place].skip = static_cast<std::uint32_t>(top.size());
  };
  add(add, 0, 1, 0);
  return top;
}

// One tree beside another, under one root.
std::vector<BvhNode> joined(const std::vector<BvhNode>& left, const std::vector<BvhNode>& right) {
  std::vector<BvhNode> top{{{0, 0, 0}, 0, {1, 1, 1}, 0}};
  std::uint32_t leaves = 0;
  for (const auto* part : {&left, &right}) {
    const auto first = static_cast<std::uint32_t>(top.size());
    for (BvhNode node : *part) {
      node.skip += first;
      if (node.leaf != 0) node.leaf = leaves++ << 3 | 1u;
      top.push_back(node);
    }
  }
  top[0].skip = static_cast<std::uint32_t>(top.size());
  return top;
}

// The sum of the areas of the boxes of all nodes that hold meshlets from `first` up to `end`.
double areas(const std::vector<MeshletNode>& tree, std::uint32_t first, std::uint32_t end) {
  double sum = 0;
  for (const MeshletNode& node : tree)
    for (std::uint32_t k = 0; k < node.count; ++k)
      if (node.nodes[k] != kNone && node.first[k] >= first && node.first[k + 1] <= end)
        sum += half_area(node.boxes[k]);
  return sum;
}

// What is beside it is divided by its boxes as it would be alone.
TEST(MeshletTree, DividesEvenlyOnlyWhereABranchTakesMorePlacesThanThereAre) {
  const std::vector<BvhNode> even = even_tree(10);
  const double alone = areas(build_meshlet_tree(even), 0, 1024);
  const std::vector<MeshletNode> tree = build_meshlet_tree(joined(even, degenerate_tree(500)));
  EXPECT_LE(most_waiting(tree, 0), kTreeStack);
  EXPECT_LE(areas(tree, 0, 1024), alone + half_area({{0, 0, 0}, {1, 1, 1}}));  // and its root
}

TEST(MeshletTree, OfAFineMeshIsAsShallowAsItCanBeAlmost) {
  const Mesh mesh = build_mesh(test::soup_of(test::make_icosphere(1, 5)));
  const double levels = std::log(mesh.topology->meshlets.meshlets.size()) / std::log(kTreeWidth);
  EXPECT_LE(depth(mesh.topology->meshlets.tree, 0), std::ceil(levels) + 1);
}

// A node is looked at for nothing where the one above has room for its children.
TEST(MeshletTree, KeepsNoNodeWhoseChildrenFitIntoTheOneAbove) {
  for (const auto& soup : {test::soup_of(test::make_icosphere(1, 5)),
                           test::soup_of(test::make_torus(1, 0.3, 160, 80))}) {
    const Mesh mesh = build_mesh(soup);
    const std::vector<MeshletNode>& tree = mesh.topology->meshlets.tree;
    ASSERT_GT(tree.size(), 100u);
    for (const MeshletNode& node : tree)
      for (std::uint32_t k = 0; k < node.count; ++k)
        if (node.nodes[k] != kNone) {
          EXPECT_GT(node.count - 1 + tree[node.nodes[k]].count, kTreeWidth);
        }
    EXPECT_LT(tree.size(), mesh.topology->meshlets.meshlets.size() / 8);
  }
}

TEST(MeshletTree, OfNothingIsEmpty) { EXPECT_TRUE(build_meshlet_tree({}).empty()); }

}  // namespace
}  // namespace ode_ext
