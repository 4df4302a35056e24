// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "mesh/weld.h"
#include "shapes.h"
#include "support/validate_bvh.h"

namespace ode_ext {
namespace {

struct Tree {
  WeldedMesh mesh;
  Bvh bvh;
  std::string fault() const { return test::validate_bvh(bvh, mesh.vertices, mesh.triangles); }
};

Tree tree_of(const TriangleSoup& soup) {
  Tree tree{weld(soup), {}};
  tree.bvh = build_bvh(tree.mesh.vertices, tree.mesh.triangles);
  return tree;
}

TriangleSoup repeated(const TriangleSoup& soup, int times) {
  TriangleSoup result;
  for (int i = 0; i < times; ++i) result = shapes::joined(std::move(result), soup);
  return result;
}

class BvhOfCount : public testing::TestWithParam<std::size_t> {};

TEST_P(BvhOfCount, IsValidForRandomTriangles) {
  const Tree tree = tree_of(shapes::random_soup(GetParam(), 3));
  EXPECT_EQ(tree.mesh.triangles.size(), GetParam());
  EXPECT_EQ(tree.fault(), "");
}

TEST_P(BvhOfCount, IsValidForIdenticalTriangles) {
  const Tree tree =
      tree_of(repeated({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, static_cast<int>(GetParam())));
  EXPECT_EQ(tree.mesh.triangles.size(), GetParam());
  EXPECT_EQ(tree.fault(), "");
}

INSTANTIATE_TEST_SUITE_P(Counts, BvhOfCount, testing::Values(0, 1, 2, 4, 5, 63, 64, 65, 1234));

TEST(Bvh, IsValidForTrianglesAlongALine) {
  TriangleSoup soup;
  for (int i = 0; i < 1000; ++i) {
    const auto x = static_cast<float>(i);
    shapes::append(soup, {x, 0, 0}, {x + 1, 0, 0}, {x + 2, 0, 0});
  }
  const Tree tree = tree_of(soup);
  EXPECT_EQ(tree.fault(), "");
  // No box has an area, so only balance keeps the tree shallow: count the ancestors of the nodes.
  std::size_t deepest = 0;
  std::vector<std::uint32_t> ends;
  for (std::uint32_t i = 0; i < tree.bvh.nodes.size(); ++i) {
    while (!ends.empty() && ends.back() <= i) ends.pop_back();
    ends.push_back(tree.bvh.nodes[i].skip);
    deepest = std::max(deepest, ends.size());
  }
  EXPECT_LE(deepest, 12u);  // 1000 / 4 leaves need 9 levels
}

TEST(Bvh, IsValidForSizesFromTheSmallestToTheLargestFloat) {
  TriangleSoup soup;
  for (float x = 1e-45f; x < 1e38f; x *= 2) shapes::append(soup, {x, 0, 0}, {0, x, 0}, {0, 0, -x});
  EXPECT_EQ(tree_of(soup).fault(), "");
}

TEST(Bvh, HasTightBoxes) {
  const Tree tree = tree_of(shapes::random_soup(500, 4));
  for (std::uint32_t i = 0; i < tree.bvh.nodes.size(); ++i) {
    const BvhNode& node = tree.bvh.nodes[i];
    Box tight = empty_box();
    for (std::uint32_t leaf = i; leaf < node.skip; ++leaf) {
      const std::uint32_t first = tree.bvh.nodes[leaf].leaf >> 3;
      for (std::uint32_t k = first; k < first + (tree.bvh.nodes[leaf].leaf & 7); ++k) {
        for (const std::uint32_t corner : tree.mesh.triangles[tree.bvh.order[k]]) {
          tight = grown(tight, tree.mesh.vertices[corner]);
        }
      }
    }
    ASSERT_EQ(node.lo, tight.lo);
    ASSERT_EQ(node.hi, tight.hi);
  }
}

TEST(Bvh, IsTheSameForTheSameMesh) {
  const TriangleSoup soup = shapes::torus(1, 0.4, 30);
  const Tree one = tree_of(soup), two = tree_of(soup);
  EXPECT_EQ(one.bvh.order, two.bvh.order);
  ASSERT_EQ(one.bvh.nodes.size(), two.bvh.nodes.size());
  for (std::size_t i = 0; i < one.bvh.nodes.size(); ++i) {
    EXPECT_EQ(one.bvh.nodes[i].lo, two.bvh.nodes[i].lo);
    EXPECT_EQ(one.bvh.nodes[i].hi, two.bvh.nodes[i].hi);
    EXPECT_EQ(one.bvh.nodes[i].skip, two.bvh.nodes[i].skip);
    EXPECT_EQ(one.bvh.nodes[i].leaf, two.bvh.nodes[i].leaf);
  }
}

// The number of nodes a random line that meets the root is expected to meet, less the root.
double expected_visits(std::vector<Box> boxes) {
  Box all = empty_box();
  for (const Box& box : boxes) all = grown(all, box);
  const auto area = [](const Box& box) {
    const Vec3d s = extent(box);
    return s.x * s.y + s.y * s.z + s.z * s.x;
  };
  double sum = 0;
  for (const Box& box : boxes) sum += area(box);
  return sum / area(all) - 1;
}

// The boxes of the tree that cuts the longest side so that both halves hold equally many.
void halve(std::vector<Box>& nodes, std::vector<Box> triangles) {
  Box all = empty_box();
  for (const Box& box : triangles) all = grown(all, box);
  nodes.push_back(all);
  if (triangles.size() <= kMaxLeafTriangles) return;
  const Vec3d size = extent(all);
  const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::sort(triangles.begin(), triangles.end(),
            [axis](const Box& a, const Box& b) { return centre(a)[axis] < centre(b)[axis]; });
  const auto middle = triangles.begin() + static_cast<std::ptrdiff_t>(triangles.size() / 2);
  halve(nodes, {triangles.begin(), middle});
  halve(nodes, {middle, triangles.end()});
}

TEST(Bvh, IsBetterThanOneOfEqualHalves) {
  // A dense sphere beside a coarse box around it: equal halves mix the two.
  const TriangleSoup soup =
      shapes::joined(shapes::sphere(0.1, 20), shapes::box({0, 0, 0}, {1, 2, 4}, 8));
  const Tree tree = tree_of(soup);
  std::vector<Box> boxes, triangles, halves;
  for (const BvhNode& node : tree.bvh.nodes) boxes.push_back({node.lo, node.hi});
  for (const Triangle& t : tree.mesh.triangles) {
    Box box = empty_box();
    for (const std::uint32_t corner : t) box = grown(box, tree.mesh.vertices[corner]);
    triangles.push_back(box);
  }
  halve(halves, triangles);
  const double visits = expected_visits(boxes), halved = expected_visits(halves);
  EXPECT_LT(visits, 0.6 * halved);  // measured: 14.2 and 27.9
}

struct PlantedFault {
  const char* name;
  std::function<void(Tree&)> plant;
  const char* message;
};

std::uint32_t first_leaf(const Tree& tree) {
  std::uint32_t i = 0;
  while (tree.bvh.nodes[i].leaf == 0) ++i;
  return i;
}

BvhNode& leaf_node(Tree& tree) { return tree.bvh.nodes[first_leaf(tree)]; }

std::uint32_t right_child(const Tree& tree) { return tree.bvh.nodes[1].skip; }

const PlantedFault kFaults[] = {
    {"ShortOrder", [](Tree& t) { t.bvh.order.pop_back(); }, "another length"},
    {"NoNodes", [](Tree& t) { t.bvh.nodes.clear(); }, "no nodes"},
    {"NodesWithoutTriangles",
     [](Tree& t) {
       t.mesh.triangles.clear();
       t.bvh.order.clear();
     },
     "no nodes"},
    {"RootSkipsShort", [](Tree& t) { --t.bvh.nodes[0].skip; }, "root does not skip"},
    {"RootSkipsPastTheEnd", [](Tree& t) { ++t.bvh.nodes[0].skip; }, "root does not skip"},
    {"NodeAtTheEnd",
     [](Tree& t) {
       t.bvh.nodes.push_back(t.bvh.nodes.back());
       t.bvh.nodes[0].skip = static_cast<std::uint32_t>(t.bvh.nodes.size());
     },
     "node 0 does not skip to where"},
    {"SkipIntoTheOwnSubtree", [](Tree& t) { t.bvh.nodes[1].skip = 2; }, "does not skip to where"},
    {"SkipBackwards", [](Tree& t) { t.bvh.nodes[1].skip = 1; }, "no right child"},
    {"SkipPastASibling",
     [](Tree& t) { t.bvh.nodes[1].skip = t.bvh.nodes[right_child(t) + 1].skip; },
     "does not skip to where"},
    {"InnerNodeAtTheEnd", [](Tree& t) { t.bvh.nodes.back().leaf = 0; }, "no left child"},
    {"LeafSkipsTooFar",
     [](Tree& t) {
       // A left leaf that skips its sibling's left child too, which its parent cannot notice.
       std::uint32_t i = 0;
       while (t.bvh.nodes[i].leaf != 0 || t.bvh.nodes[i + 1].leaf == 0 ||
              t.bvh.nodes[i + 2].leaf != 0) {
         ++i;
       }
       t.bvh.nodes[i + 1].skip = t.bvh.nodes[i + 3].skip;
     },
     "is a leaf and does not skip"},
    {"LeafWithoutTriangles", [](Tree& t) { leaf_node(t).leaf = 8u; }, "wrong number"},
    {"LeafWithTooManyTriangles", [](Tree& t) { leaf_node(t).leaf |= 7u; }, "wrong number"},
    {"LeafBeyondTheOrder", [](Tree& t) { leaf_node(t).leaf += 5000u << 3; }, "leaves the order"},
    {"TriangleThatDoesNotExist", [](Tree& t) { t.bvh.order[leaf_node(t).leaf >> 3] = 5000; },
     "triangle that does not exist"},
    {"TriangleTwice",
     [](Tree& t) {
       const std::uint32_t first = leaf_node(t).leaf >> 3;
       t.bvh.order[first + 1] = t.bvh.order[first];
     },
     "repeats triangle"},
    {"TriangleNowhere",
     [](Tree& t) {
       std::uint32_t i = 0;
       while ((t.bvh.nodes[i].leaf & 7) < 2) ++i;
       t.bvh.nodes[i].leaf -= 1;
     },
     "in no leaf"},
    {"CornerThatDoesNotExist",
     [](Tree& t) { t.mesh.triangles[t.bvh.order[leaf_node(t).leaf >> 3]][2] = 50000; },
     "corner that does not exist"},
    {"LeafBoxTooSmall",
     [](Tree& t) { leaf_node(t).hi.y = std::nextafter(leaf_node(t).hi.y, -9.0f); },
     "does not hold its triangle"},
    {"InnerBoxTooSmall",
     [](Tree& t) { t.bvh.nodes[0].lo.z = std::nextafter(t.bvh.nodes[0].lo.z, 9.0f); },
     "does not hold its child"},
    {"BoxOfNaN", [](Tree& t) { t.bvh.nodes[0].lo.x = std::numeric_limits<float>::quiet_NaN(); },
     "does not hold its child"},
};

class BvhFault : public testing::TestWithParam<PlantedFault> {};

TEST_P(BvhFault, IsFound) {
  Tree tree = tree_of(shapes::random_soup(200, 5));
  ASSERT_EQ(tree.fault(), "");
  GetParam().plant(tree);
  EXPECT_NE(tree.fault(), "");
  EXPECT_NE(tree.fault().find(GetParam().message), std::string::npos) << tree.fault();
}

INSTANTIATE_TEST_SUITE_P(Planted, BvhFault, testing::ValuesIn(kFaults),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace ode_ext
