// SPDX-License-Identifier: BSD-3-Clause
// Features: every crossing and every vertex inside, once, among those of its pair; and the regions
// of overlap that they form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "support/rig.h"

namespace ode_ext::test {
namespace {

StepRecords searched(const TestScene& scene) {
  return Rig::shared().run_with_edges(scene.scene, Organization::kPipelined, {8, 64}, true);
}

// Flags that say what it is; pair, edge or vertex, triangle, t.
using What = std::tuple<ox_u32, ox_u32, ox_u32, ox_u32, ox_f32>;

TEST(Features, AreAllCrossingsAndAllVerticesInside) {
  const TestScene scene = random_scene(200, 79);
  const StepRecords records = searched(scene);
  std::multiset<What> expected, found;
  for (const ox_edge_crossing& c : records.crossings)
    expected.insert({(c.pair_side & 1) | (c.leaves != 0 ? OX_FEATURE_LEAVES : 0u), c.pair_side >> 1,
                     c.edge, c.triangle, c.t});
  for (const ox_hit& h : records.hits)
    expected.insert(
        {(h.pair_side & 1) | OX_FEATURE_VERTEX, h.pair_side >> 1, h.vertex, h.triangle, 0.0f});
  for (const ox_feature& f : records.features)
    found.insert({f.flags & (OX_FEATURE_SIDE | OX_FEATURE_LEAVES | OX_FEATURE_VERTEX), f.pair,
                  f.source, f.triangle, f.t});
  EXPECT_EQ(found, expected);
  EXPECT_GT(records.crossings.size(), 1000u);
  EXPECT_GT(records.hits.size(), 500u);
}

TEST(Features, LieOnTheirEdgesAndVerticesInTheFrameOfB) {
  const TestScene scene = random_scene(200, 79);
  const StepRecords records = searched(scene);
  for (const ox_feature& f : records.features) {
    const ox_u32 side = f.flags & OX_FEATURE_SIDE;
    const std::uint32_t mesh = scene.objects[scene.pairs[f.pair][side]].mesh;
    const TestPose &pa = scene.pose_of(f.pair, 0), &pb = scene.pose_of(f.pair, 1);
    const auto place_of = [&](ox_u32 vertex) {
      const Point p =
          point_of(scene.scene.meshes[mesh]->vertices.at(Rig::shared().local_vertex(mesh, vertex)));
      return side == 0 ? rotate_back(pb, rotate(pa, p) + (pa.position - pb.position)) : p;
    };
    const double epsilon = static_cast<double>(records.pairs[f.pair].epsilon);
    Point expected;
    if ((f.flags & OX_FEATURE_MOVED) != 0) {
      const auto hit = std::find_if(records.hits.begin(), records.hits.end(), [&](const ox_hit& h) {
        return h.pair_side == (f.pair << 1 | side) && h.vertex == f.source;
      });
      ASSERT_TRUE(hit != records.hits.end());
      const ox_edge& edge = records.edges.at(hit->edge);
      const std::size_t other = edge.vertex[0] == f.source ? 1 : 0;
      ASSERT_EQ(edge.vertex[1 - other], f.source);
      expected = place_of(f.source);
      expected =
          expected + static_cast<double>(hit->t) * unit(place_of(edge.vertex[other]) - expected);
    } else if ((f.flags & OX_FEATURE_VERTEX) != 0) {
      expected = place_of(f.source);
    } else {
      const ox_edge& edge = records.edges.at(f.source);
      const Point from = place_of(edge.vertex[0]);
      expected = from + static_cast<double>(f.t) * unit(place_of(edge.vertex[1]) - from);
    }
    EXPECT_LT(distance(point_of(f.position), expected), 2 * epsilon);
  }
}

TEST(Features, AreEachOfOneRegionOfTheirPair) {
  const TestScene scene = random_scene(200, 80);
  const StepRecords records = searched(scene);
  std::set<ox_u32> listed;
  for (std::size_t r = 0; r < records.regions.size(); ++r) {
    const ox_region& region = records.regions[r];
    EXPECT_EQ(region.placed, region.count);
    for (const ox_u32 feature : records.features_of(region)) {
      EXPECT_TRUE(listed.insert(feature).second);
      EXPECT_EQ(records.features.at(feature).region, r);
      EXPECT_EQ(records.features.at(feature).pair, region.pair);
    }
  }
  // But those within facets, which are of no contact.
  EXPECT_EQ(listed.size(),
            static_cast<std::size_t>(std::count_if(
                records.features.begin(), records.features.end(),
                [](const ox_feature& f) { return (f.flags & OX_FEATURE_FLAT) == 0; })));
  EXPECT_GT(records.regions.size(), 100u);
}

// A chord has two ends: one where its edge enters, the other where it leaves, or a vertex.
TEST(Features, ArePartnersOfOneAnother) {
  const TestScene scene = random_scene(200, 81, kSmallClosedMeshCount);
  const StepRecords records = searched(scene);
  std::size_t chords = 0;
  for (ox_u32 i = 0; i < records.features.size(); ++i) {
    const ox_feature& f = records.features[i];
    if ((f.flags & (OX_FEATURE_VERTEX | OX_FEATURE_FLAT)) != 0) continue;
    ASSERT_NE(f.partner, OX_NONE) << "pair " << f.pair;
    const ox_feature& other = records.features.at(f.partner);
    EXPECT_EQ(other.region, f.region);
    if ((other.flags & OX_FEATURE_VERTEX) != 0) {
      const ox_u32 end = (f.flags & OX_FEATURE_LEAVES) != 0 ? 0 : 1;
      EXPECT_EQ(other.source, records.edges.at(f.source).vertex[end]);
      continue;
    }
    ++chords;
    EXPECT_EQ(other.source, f.source);
    EXPECT_NE(other.flags & OX_FEATURE_LEAVES, f.flags & OX_FEATURE_LEAVES);
    EXPECT_EQ(other.partner, i);
  }
  EXPECT_GT(chords, 100u);
}

// By counting from it inwards how often the edge enters and leaves, until it is as often.
ox_u32 partner_by_counting(const StepRecords& records, const std::vector<ox_u32>& in_order,
                           std::size_t place) {
  const auto leaves = [&](std::size_t k) {
    return (records.features[in_order[k]].flags & OX_FEATURE_LEAVES) != 0;
  };
  const bool back = leaves(place);
  int depth = 0;
  for (std::size_t k = place; k < in_order.size(); k += back ? std::size_t(-1) : 1) {
    depth += leaves(k) == back ? 1 : -1;
    if (depth == 0) return in_order[k];
  }
  return OX_NONE;
}

// Whether the edge is inside of something on both sides of a crossing: as often as it leaves what
// it has not entered, it has been so since its first vertex.
bool nested_by_counting(const StepRecords& records, const std::vector<ox_u32>& in_order,
                        std::size_t place) {
  int depth = 0, least = 0, before = 0, after = 0;
  for (std::size_t k = 0; k < in_order.size(); ++k) {
    if (k == place) before = depth;
    depth += (records.features[in_order[k]].flags & OX_FEATURE_LEAVES) != 0 ? -1 : 1;
    if (k == place) after = depth;
    least = std::min(least, depth);
  }
  return std::min(before, after) - least >= 1;
}

TEST(Features, ArePartnersAsBracketsAreHoweverOftenAnEdgeCrosses) {
  TestScene scene;
  scene.add_pair(scene.add_mesh(make_soup(150, 21)), {}, scene.add_mesh(make_soup(150, 22)), {});
  const StepRecords records = searched(scene);
  std::map<std::pair<ox_u32, ox_u32>, std::vector<ox_u32>> of_edges;
  std::map<std::pair<ox_u32, ox_u32>, ox_u32> inside;
  for (ox_u32 i = 0; i < records.features.size(); ++i) {
    const ox_feature& f = records.features[i];
    if ((f.flags & OX_FEATURE_VERTEX) != 0)
      inside[{f.flags & OX_FEATURE_SIDE, f.source}] = i;
    else
      of_edges[{f.flags & OX_FEATURE_SIDE, f.source}].push_back(i);
  }
  std::size_t most = 0, chords = 0, unsure = 0, nested = 0;
  for (auto& [edge, all] : of_edges) {
    most = std::max(most, all.size());
    const auto& features = records.features;
    std::sort(all.begin(), all.end(), [&](ox_u32 i, ox_u32 k) {
      const auto rank = [&](ox_u32 n) {
        return std::tuple(features[n].t, features[n].flags & OX_FEATURE_LEAVES,
                          features[n].triangle);
      };
      return rank(i) < rank(k);
    });
    // Where rounding may have changed the order, either is right.
    bool sure = true;
    for (std::size_t k = 1; k < all.size(); ++k)
      sure = sure && features[all[k]].t - features[all[k - 1]].t >
                         records.crossings[all[k]].blur + records.crossings[all[k - 1]].blur;
    unsure += sure ? 0 : 1;
    for (std::size_t k = 0; k < all.size() && sure; ++k) {
      const ox_feature& f = features[all[k]];
      ox_u32 expected = partner_by_counting(records, all, k);
      if (expected == OX_NONE) {
        const ox_u32 end = (f.flags & OX_FEATURE_LEAVES) != 0 ? 0 : 1;
        const auto found = inside.find({edge.first, records.edges.at(f.source).vertex[end]});
        if (found != inside.end()) expected = found->second;
      } else {
        ++chords;
      }
      EXPECT_EQ(f.partner, expected) << "feature " << all[k];
      const bool is_nested = nested_by_counting(records, all, k);
      EXPECT_EQ((f.flags & OX_FEATURE_NESTED) != 0, is_nested) << "feature " << all[k];
      nested += is_nested ? 1 : 0;
    }
  }
  EXPECT_LT(unsure, of_edges.size() / 20);
  EXPECT_GT(most, 10u);
  EXPECT_GT(chords, 500u);
  EXPECT_GT(nested, 100u);
}

// Posts upright in one face.
TEST(Regions, AreAsManyAsPostsInAFaceHoweverManyTheyAre) {
  for (const int count : {2, 16, 17, 60}) {
    TestMesh posts;
    for (int i = 0; i < count; ++i)
      posts = merged(posts, moved(make_box({0.1, 0.1, 0.5}), {0.2 * i, 0, 0.2}));
    TestScene scene;
    const std::uint32_t block = scene.add_mesh(moved(make_box({40, 2, 1}), {0, 0, -0.5}));
    scene.add_pair(scene.add_mesh(posts), {}, block, {});
    const StepRecords records = searched(scene);
    EXPECT_EQ(records.regions.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(records.hits.size(), 4u * static_cast<unsigned>(count));
    // A post each, and what is told of convex bodies: its surface is crossed, and has no valley.
    // All edges and vertices are the posts'.
    std::map<int, ox_u32> region_of;
    for (const ox_feature& f : records.features)
      EXPECT_EQ(region_of.emplace(static_cast<int>(std::round(f.position[0] / 0.2f)), f.region)
                    .first->second,
                f.region);
    for (const ox_region& region : records.regions)
      EXPECT_EQ(region.flags, OX_REGION_CROSSED | OX_REGION_OF(0u));
  }
}

// The top of a plate has a vertex in its midst that is in neither, so one edge within the top leads
// to it from a corner: out of the post on the corner and through the other. Which edge that is
// depends on where the plate lies.
TEST(Regions, OfPostsThroughBothOfWhichAnEdgeWithinAFacetGoesAreTwo) {
  TestMesh plate;
  for (const double z : {0.0, -0.1})
    for (const auto& [x, y] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}})
      for (const double v : {1.0 * x, 1.0 * y, z}) plate.vertices.push_back(static_cast<float>(v));
  for (const double v : {-0.9, 0.98, 0.0}) plate.vertices.push_back(static_cast<float>(v));
  plate.indices = {4, 6, 5, 4, 7, 6};
  for (unsigned i = 0; i < 4; ++i) {
    const unsigned j = (i + 1) % 4;
    plate.indices.insert(plate.indices.end(), {i, j, 8, i, i + 4, j, j, i + 4, j + 4});
  }
  const TestMesh posts = merged(moved(make_box({0.3, 0.4, 0.501}), {1.05, 1.0, 0.2495}),
                                moved(make_box({0.2, 0.515, 0.55}), {0, 1.2425, 0.225}));
  for (int turned = 0; turned < 8; ++turned) {
    const auto mirrored = [&](TestMesh mesh) {
      for (std::size_t i = 0; i < mesh.vertices.size(); i += 3) {
        if ((turned & 1) != 0) mesh.vertices[i] = -mesh.vertices[i];
        if ((turned & 2) != 0) mesh.vertices[i + 1] = -mesh.vertices[i + 1];
        if ((turned & 4) != 0) std::swap(mesh.vertices[i], mesh.vertices[i + 1]);
      }
      return mesh;  // inside out, it is turned
    };
    const StepRecords records =
        searched(one_pair(mirrored(posts), TestPose{}, mirrored(plate), TestPose{}));
    EXPECT_EQ(std::count_if(records.regions.begin(), records.regions.end(),
                            [](const ox_region& region) { return region.count != 0; }),
              2)
        << turned;
  }
}

// The inner side of an L is one.
TEST(Regions, HaveAValleyWhereAMeshIsNotConvex) {
  TestScene scene;
  const std::uint32_t l = scene.add_mesh(make_l(1));
  const std::uint32_t ball = scene.add_mesh(make_icosphere(0.3, 2));
  scene.add_pair(ball, at(0, 0, 0), l, {});                                    // in the corner
  scene.add_pair(ball, at(-0.25, -0.6, 0), l, {});                             // in an outer side
  scene.add_pair(scene.add_mesh(make_cube(0.1)), at(-0.25, -0.25, 0), l, {});  // wholly inside
  const StepRecords records = searched(scene);
  ASSERT_EQ(records.regions.size(), 3u);
  for (const ox_region& region : records.regions) {
    EXPECT_EQ((region.flags & OX_REGION_VALLEY) != 0, region.pair == 0);
    EXPECT_EQ((region.flags & OX_REGION_CROSSED) != 0, region.pair != 2);
  }
}

}  // namespace
}  // namespace ode_ext::test
