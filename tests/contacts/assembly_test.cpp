// SPDX-License-Identifier: BSD-3-Clause
// The kernels of contacts beside the double-precision reference of what they are to do: the same
// features and regions, and mostly the same plane for each region. And bodies of several parts, of
// which it is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "collide/collider.h"
#include "contacts/placed.h"
#include "reference/reference_contacts.h"
#include "search/crossing_comparison.h"
#include "support/convex_makers.h"
#include "support/convex_solid.h"
#include "support/rig.h"

namespace ode_ext::test {
namespace {

StepRecords assembled(const TestScene& scene) {
  return Rig::shared().run_with_edges(scene.scene, Organization::kPipelined, {8, 64}, true);
}

// Side, the ends of the edge in its own frame, and the triangle crossed; of a vertex inside itself
// twice, and none. What is within facets is of no contact, and left out.
using FeatureKey = std::tuple<int, Point, Point, int>;
using Regions = std::map<FeatureKey, std::size_t>;  // of features

Regions regions_of(const TestScene& scene, const StepRecords& records, std::size_t pair) {
  Regions regions;
  for (const ox_feature& f : records.features) {
    if (f.pair != pair || (f.flags & OX_FEATURE_FLAT) != 0) continue;
    const std::size_t side = f.flags & OX_FEATURE_SIDE;
    const std::uint32_t source = scene.objects[scene.pairs[pair][side]].mesh;
    const std::uint32_t target = scene.objects[scene.pairs[pair][1 - side]].mesh;
    const auto place_of = [&](ox_u32 vertex) {
      return point_of(
          scene.scene.meshes[source]->vertices.at(Rig::shared().local_vertex(source, vertex)));
    };
    FeatureKey key;
    if ((f.flags & OX_FEATURE_VERTEX) != 0) {
      key = {side, place_of(f.source), place_of(f.source), -1};
    } else {
      Point from = place_of(records.edges.at(f.source).vertex[0]);
      Point to = place_of(records.edges.at(f.source).vertex[1]);
      if (to < from) std::swap(from, to);
      key = {side, from, to,
             scene.scene.meshes[target]->topology->source_triangle.at(
                 Rig::shared().local_triangle(target, f.triangle))};
    }
    EXPECT_TRUE(regions.emplace(key, f.region).second) << "pair " << pair;
  }
  return regions;
}

Regions regions_of(const ContactMesh& a, const ContactMesh& b, const ContactFeatures& found) {
  Regions regions;
  for (const ContactFeature& f : found.features) {
    if (f.flat) continue;
    const ContactMesh &source = f.side == 0 ? a : b, &target = f.side == 0 ? b : a;
    const auto side = static_cast<int>(f.side);
    if (!f.is_crossing()) {
      const Point& p = source.vertices[f.vertex];
      regions[{side, p, p, -1}] = f.region;
      continue;
    }
    const auto& ends = source.edges[f.edge].vertices;
    regions[{side, source.vertices[ends[0]], source.vertices[ends[1]],
             target.source_triangle[f.triangle]}] = f.region;
  }
  return regions;
}

// The region of the one that each of the other is; nothing where they are not the same sets.
std::optional<std::map<std::size_t, std::size_t>> matched(const Regions& one,
                                                          const Regions& other) {
  std::map<std::size_t, std::size_t> there, back;
  if (one.size() != other.size()) return std::nullopt;
  for (const auto& [key, region] : one) {
    const auto found = other.find(key);
    if (found == other.end()) return std::nullopt;
    if (there.emplace(region, found->second).first->second != found->second ||
        back.emplace(found->second, region).first->second != region)
      return std::nullopt;
  }
  return there;
}

// [m] By a program of its own, which knows convex bodies alone: the least move that parts a pair.
double least_move(const TestScene& scene, std::size_t pair) {
  return shortest_way_out(ConvexSolid(scene.mesh_of(pair, 0)), scene.pose_of(pair, 0),
                          ConvexSolid(scene.mesh_of(pair, 1)), scene.pose_of(pair, 1))
      .depth;
}

struct Deepest {
  double depth = -1;  // [m]; none
  Point normal{};     // in the frame of B
};

// A region is unlike where it is not as deep as that of the reference, to two per cent.
struct Agreement {
  int pairs = 0, doubtful = 0;  // in doubt within rounding, and left out
  int other_features = 0;       // pairs
  // Of pairs with the same features.
  int regions = 0, unlike = 0, turned = 0, none = 0;  // turned: as deep, but another way
  int shallow = 0, shallow_unlike = 0;                // less than a tenth of a metre deep
};

// Features are the same where no crossing is so near to an end or a side that how much larger A is
// taken, which is not the same in both, decides.
Agreement compare(const TestScene& scene, bool are_convex = false) {
  const StepRecords records = assembled(scene);
  std::vector<ContactMesh> meshes(scene.meshes.begin(), scene.meshes.end());
  const std::vector<ReferenceSurface> surfaces(scene.meshes.begin(), scene.meshes.end());
  Agreement agreement;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const std::uint32_t a = scene.objects[scene.pairs[i][0]].mesh;
    const std::uint32_t b = scene.objects[scene.pairs[i][1]].mesh;
    const TestPose &pa = scene.pose_of(i, 0), &pb = scene.pose_of(i, 1);
    const double epsilon = pair_epsilon(scene, i);
    const auto crossings =
        reference_crossings(surfaces[a], pa, surfaces[b], pb, kInflation * epsilon);
    ++agreement.pairs;
    if (std::any_of(crossings.begin(), crossings.end(),
                    [](const ReferenceCrossing& c) { return c.ambiguous; })) {
      ++agreement.doubtful;
      continue;
    }
    const ReferenceContacts expected = reference_contacts(meshes[a], pa, meshes[b], pb);
    const auto same =
        matched(regions_of(scene, records, i), regions_of(meshes[a], meshes[b], expected.found));
    if (!same) {
      ++agreement.other_features;
      continue;
    }
    std::map<std::size_t, Deepest> found, should;
    for (const Candidate& c : records.candidates_of(i)) {
      Deepest& deepest = found[same->at(c.region >> 1)];
      if (static_cast<double>(c.depth) > deepest.depth)
        deepest = {static_cast<double>(c.depth), point_of(c.normal)};
    }
    for (const ReferenceContact& c : expected.all)
      if (c.depth > should[c.region].depth) should[c.region] = {c.depth, rotate_back(pb, c.normal)};
    for (std::size_t r = 0; r < expected.found.regions.size(); ++r) {
      if (found[r].depth < 0 && should[r].depth < 0) continue;  // within facets
      ++agreement.regions;
      if (found[r].depth < 0 && should[r].depth >= 0) ++agreement.none;
      const double slack = 0.02 * should[r].depth + kDoubt * epsilon;
      // A region may part two ways that are as long as one another. Where bodies go on beyond it
      // the kernels price a plane by all of them, the reference by what is in the region.
      const bool as_deep = std::fabs(found[r].depth - should[r].depth) < slack;
      const bool alike =
          as_deep || (are_convex && std::fabs(found[r].depth - least_move(scene, i)) < slack);
      const bool shallow = should[r].depth < 0.1;
      agreement.unlike += !alike;
      agreement.shallow += shallow;
      agreement.shallow_unlike += shallow && !alike;
      if (as_deep && dot(found[r].normal, should[r].normal) < 0.99) ++agreement.turned;
    }
  }
  return agreement;
}

TestScene random_pairs(const std::vector<TestMesh>& meshes, int count, std::uint64_t seed,
                       double spread) {
  TestScene scene;
  for (const TestMesh& mesh : meshes) scene.add_mesh(mesh);
  Random random(seed);
  const auto any = [&] {
    return static_cast<std::uint32_t>(random.below(static_cast<int>(meshes.size())));
  };
  for (int i = 0; i < count; ++i) {
    const std::uint32_t a = any(), b = any();
    const TestPose pose = random.pose(spread);
    scene.add_pair(a, pose, b, random.pose(spread));
  }
  return scene;
}

std::vector<TestMesh> convex_shapes() {
  Random random(3);
  return {make_cube(1),           make_tetrahedron(1.4),      make_octahedron(0.5),
          make_icosphere(0.5, 1), make_cylinder(0.35, 1, 16), make_random_hull(random, 20, 0.5)};
}

TEST(Assembly, FindsTheFeaturesAndRegionsOfTheReference) {
  for (const auto& meshes : {convex_shapes(), small_closed_meshes()}) {
    const Agreement agreement = compare(random_pairs(meshes, 400, 7, 0.5));
    EXPECT_EQ(agreement.other_features, 0) << "of " << agreement.pairs;
    EXPECT_LT(20 * agreement.doubtful, agreement.pairs) << agreement.doubtful;
    EXPECT_GT(agreement.regions, 200);
  }
}

TEST(Assembly, PartsConvexBodiesAsTheReferenceDoes) {
  const Agreement agreement = compare(random_pairs(convex_shapes(), 400, 8, 0.5), true);
  EXPECT_EQ(agreement.none, 0);
  EXPECT_LT(100 * agreement.unlike, agreement.regions) << agreement.unlike;
  EXPECT_LT(100 * agreement.turned, agreement.regions) << agreement.turned;
}

// Of planes that are as good either may come first, and then more of what is left differs:
// the kernels try fewer of them. Where bodies are deep in one another that shows.
TEST(Assembly, MostlyPartsBodiesWithValleysAsTheReferenceDoes) {
  const Agreement agreement = compare(random_pairs(small_closed_meshes(), 1200, 9, 0.5));
  EXPECT_EQ(agreement.none, 0);
  EXPECT_LT(3 * agreement.unlike, agreement.regions) << agreement.unlike;
  EXPECT_LT(10 * agreement.turned, agreement.regions) << agreement.turned;
  EXPECT_GT(agreement.shallow, 100);
  EXPECT_LT(10 * agreement.shallow_unlike, agreement.shallow) << agreement.shallow_unlike;
}

// By a program of its own that knows convex bodies alone.
TEST(Assembly, OfConvexBodiesIsAsDeepAsTheLeastMoveThatPartsThem) {
  const TestScene scene = random_pairs(convex_shapes(), 1000, 3, 0.7);
  const StepRecords records = assembled(scene);
  int colliding = 0, parted = 0;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const ConvexSolid a(scene.mesh_of(i, 0)), b(scene.mesh_of(i, 1));
    TestPose pa = scene.pose_of(i, 0);
    const TestPose& pb = scene.pose_of(i, 1);
    const WayOut way = shortest_way_out(a, pa, b, pb);
    const double epsilon = pair_epsilon(scene, i);
    const ox_range& range = records.ranges[i];
    if (way.depth < -kDoubt * epsilon) {
      EXPECT_EQ(range.count, 0u) << "pair " << i << " is " << -way.depth << " apart";
    }
    if (way.depth > kDoubt * epsilon) {
      EXPECT_GT(range.count, 0u) << "pair " << i << " is " << way.depth << " deep";
    }
    // Where bodies go on through one another the depth is that of what overlaps, not of all.
    if (range.count == 0 || way.depth < 0.001 || way.depth > 0.15) continue;
    ++colliding;
    const ox_contact& deepest = records.contacts[range.first];
    EXPECT_GT(static_cast<double>(deepest.depth), 0.9 * way.depth) << "pair " << i;
    EXPECT_LT(static_cast<double>(deepest.depth), 1.06 * way.depth + kDoubt * epsilon)
        << "pair " << i;
    pa.position =
        pa.position + static_cast<double>(deepest.depth) * rotate(pb, point_of(deepest.normal));
    const double left = shortest_way_out(a, pa, b, pb).depth;
    EXPECT_LT(left, 0.1 * way.depth + kDoubt * epsilon) << "pair " << i;
    parted += left < kDoubt * epsilon;
  }
  EXPECT_GT(colliding, 100);
  EXPECT_GE(parted, 0.95 * colliding);
}

std::vector<TestPose> frames() { return {TestPose{}, turned({3, 1, 2}, 1.1, {0.5, 0.1, 0.2})}; }

// The deepest on either side of x = 0.
std::array<double, 2> deepest_by_side(const std::vector<Contact>& contacts) {
  std::array<double, 2> deepest{-1, -1};
  for (const Contact& c : contacts) {
    double& depth = deepest[c.position.x < 0 ? 0 : 1];
    depth = std::max(depth, c.depth);
  }
  return deepest;
}

TEST(Assembly, MovesTwoPlatesOfOneMeshOutOfOppositeRimsByTenMillimetres) {
  for (const int cells : {1, 6})
    for (const TestPose& frame : frames()) {
      const TestMesh plate = make_box({0.1, 0.15, 0.005}, 2 * cells, cells, 1);
      const double z = 0.1 - 0.01 + 0.0025;
      const TestMesh both = merged(moved(plate, {0.12, 0.01, z}), moved(plate, {-0.12, 0, z}));
      const auto found = Placed{both, make_cube(0.2, cells), {}, {}}.contacts(frame);
      for (const double depth : deepest_by_side(found))
        EXPECT_NEAR(depth, 0.01, 0.0005) << cells << " cells";
      for (const Contact& c : found) EXPECT_NEAR(c.normal.z, 1, 1e-4) << cells << " cells";
    }
}

TEST(Assembly, MovesAContainedPartAndAShallowOneOutByWhatEachIsDeep) {
  for (const int cells : {1, 5})
    for (const TestPose& frame : frames()) {
      const TestMesh small = make_cube(0.02, cells);
      const TestMesh both = merged(moved(small, {-0.05, 0, 0.1 - 0.0403 + 0.01}),
                                   moved(small, {0.05, 0.01, 0.1 - 0.01 + 0.01}));
      const auto found = Placed{both, make_cube(0.2, cells), {}, {}}.contacts(frame);
      const auto [contained, shallow] = deepest_by_side(found);
      EXPECT_NEAR(contained, 0.0403, 1e-5) << cells << " cells";
      EXPECT_NEAR(shallow, 0.01, 1e-5) << cells << " cells";
      for (const Contact& c : found) EXPECT_NEAR(c.normal.z, 1, 1e-4) << cells << " cells";
    }
}

// Each region of the only pair: how deep, and that its plane faces up.
void expect_regions(const TestScene& scene, std::size_t count, double depth) {
  const StepRecords records = assembled(scene);
  // But those within facets, which have no members.
  ASSERT_EQ(static_cast<std::size_t>(
                std::count_if(records.regions.begin(), records.regions.end(),
                              [](const ox_region& region) { return region.count != 0; })),
            count);
  std::map<ox_u32, double> deepest;
  for (const Candidate& c : records.candidates_of(0)) {
    deepest[c.region] = std::max(deepest[c.region], static_cast<double>(c.depth));
    EXPECT_NEAR(c.normal[2], 1, 1e-5);
  }
  EXPECT_EQ(deepest.size(), count) << "each has a contact";
  for (const auto& [region, of_region] : deepest)
    EXPECT_NEAR(of_region, depth, 10 * pair_epsilon(scene, 0));
  // Of regions that are all as deep each has one before any has two.
  std::set<std::pair<int, int>> places;
  for (ox_u32 k = 0; k < records.ranges[0].count; ++k) {
    const ox_contact& c = records.contacts[records.ranges[0].first + k];
    places.emplace(static_cast<int>(std::round(10 * c.position[0])),
                   static_cast<int>(std::round(10 * c.position[1])));
  }
  EXPECT_EQ(places.size(), std::min<std::size_t>(16, records.ranges[0].count));
}

TEST(Assembly, OfFeetOnASlabIsOfOneRegionAFoot) {
  for (const int cells : {1, 3}) {
    TestMesh feet;
    for (int x = -3; x <= 3; ++x)
      for (int y = -3; y <= 3; ++y)
        feet = merged(feet, moved(make_box({0.05, 0.05, 0.2}, cells, cells, cells),
                                  {0.2 * x + 0.01, 0.2 * y + 0.02, 0}));
    expect_regions(
        one_pair(feet, at(0, 0, 0.09), moved(make_box({3, 3, 1}, cells), {0, 0, -0.5}), {}), 49,
        0.01);
  }
}

TEST(Assembly, OfACombOnASlabIsOfOneRegionATooth) {
  const TestMesh comb = make_comb(4, 0.2, 0.5, 0.3);
  double top = 0;
  for (std::size_t v = 0; v < static_cast<std::size_t>(comb.vertex_count()); ++v)
    top = std::max(top, comb.vertex(v)[2]);
  const TestPose teeth_down = turned({1, 0, 0}, std::acos(-1.0), {0.03, 0.02, top - 0.01});
  expect_regions(one_pair(comb, teeth_down, moved(make_box({4, 3, 1}), {0, 0, -0.5}), {}), 4, 0.01);
}

// All of its teeth are astride a thin wall, 2 cm off its middle: they leave one way.
TEST(Assembly, OfACombAstrideAWallDoesNotOpposeItself) {
  const TestMesh comb = make_comb(4, 0.2, 0.4, 0.3), wall = make_box({3, 0.1, 1});
  for (const TestPose& frame : frames()) {
    const auto found =
        Placed{comb, wall, turned({1, 0, 0}, 0.01, {0, 0.02, 0.55}), {}}.contacts(frame);
    ASSERT_FALSE(found.empty());
    for (const Contact& c : found)
      for (const Contact& d : found) EXPECT_GT(dot(c.normal, d.normal), -0.5);
  }
}

}  // namespace
}  // namespace ode_ext::test
