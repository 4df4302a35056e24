// SPDX-License-Identifier: BSD-3-Clause
#include "reference/reference_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "reference/reference_collider.h"
#include "support/convex_makers.h"
#include "support/convex_solid.h"
#include "support/fcl_oracle.h"
#include "support/region_cases.h"
#include "support/region_contacts.h"

namespace ode_ext::test {
namespace {

ReferenceContacts collide(const TestMesh& a, const TestPose& pa, const TestMesh& b,
                          const TestPose& pb, const ContactOptions& options = {}) {
  return reference_contacts(ContactMesh(a), pa, ContactMesh(b), pb, options);
}

double deepest(const ReferenceContacts& found) {
  return found.contacts.empty() ? -1 : found.contacts[0].depth;
}

// Whether `normal` is within 1e-5 rad of `truth`.
bool agree(const Point& normal, const Point& truth) { return distance(normal, truth) < 1e-5; }

TestMesh permuted(const TestMesh& mesh, std::uint64_t seed) {
  std::vector<std::size_t> order(static_cast<std::size_t>(mesh.triangle_count()));
  std::iota(order.begin(), order.end(), std::size_t{0});
  Random random(seed);
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
  TestMesh result;
  for (const std::size_t t : order) {
    const auto first = static_cast<std::size_t>(random.below(3));
    for (std::size_t k = 0; k < 3; ++k) {
      const Point p = mesh.corner(t, (first + k) % 3);
      result.indices.push_back(static_cast<unsigned>(result.vertices.size() / 3));
      for (const double x : p) result.vertices.push_back(static_cast<float>(x));
    }
  }
  return result;
}

TEST(ReferenceContacts, ACubeOnACubeIsHeldUpAtItsFourCorners) {
  const TestPose frame = turned({1, 2, 3}, 0.7, {4, 5, 6});
  const TestMesh cube = make_cube(1), plate = make_plate(3, 0.5, 4);
  const auto found = collide(cube, composed(frame, at(0.1, 0.2, 0.74)), plate, frame);
  ASSERT_EQ(found.contacts.size(), 4u);
  for (const ReferenceContact& c : found.contacts) {
    EXPECT_NEAR(c.depth, 0.01, 2 * found.epsilon);
    EXPECT_TRUE(agree(c.normal, rotate(frame, {0, 0, 1})));
    const Point local = to_local(frame, c.position);
    EXPECT_NEAR(std::fabs(local[0] - 0.1), 0.5, 1e-5);
    EXPECT_NEAR(std::fabs(local[1] - 0.2), 0.5, 1e-5);
    EXPECT_NEAR(local[2], 0.24, 1e-5);
  }
}

TEST(ReferenceContacts, CrossedRodsTouchMidwayBetweenTheirEdges) {
  const double half_diagonal = 0.5 / std::sqrt(2.0);
  const TestPose ridge_up = turned({1, 0, 0}, std::numbers::pi / 4);
  TestPose across = composed(turned({0, 0, 1}, 1.2), ridge_up);
  across.position = {0.1, 0.2, 2 * half_diagonal - 0.01};
  const auto found = collide(make_rod(4, 0.5), across, make_rod(4, 0.5), ridge_up);
  ASSERT_EQ(found.contacts.size(), 1u);
  EXPECT_EQ(found.manifolds[0].plane.kind, PlaneKind::kEdges);
  EXPECT_NEAR(found.contacts[0].depth, 0.01, 3 * found.epsilon);
  EXPECT_TRUE(agree(found.contacts[0].normal, {0, 0, 1}));
  EXPECT_NEAR(found.contacts[0].position[2], half_diagonal - 0.005, 1e-4);
  EXPECT_NEAR(found.contacts[0].position[1], 0, 1e-4);  // over the lower ridge
}

TEST(ReferenceContacts, TwoPlatesOfOneMeshInOppositeRimsAreEachTenMillimetresDeep) {
  for (const int cells : {1, 6}) {
    const TestMesh plate = make_box({0.1, 0.15, 0.005}, 2 * cells, cells, 1);
    const double z = 0.1 - 0.01 + 0.0025;
    const TestMesh both = merged(moved(plate, {0.12, 0.01, z}), moved(plate, {-0.12, 0, z}));
    const TestPose frame = turned({3, 1, 2}, 1.1, {0.5, 0.1, 0.2});
    const auto found = collide(both, frame, make_cube(0.2, cells), frame);
    ASSERT_EQ(found.found.regions.size(), 2u);
    bool left = false, right = false;
    for (const ReferenceContact& c : found.contacts) {
      EXPECT_LT(c.depth, 0.01 + 2 * found.epsilon);
      EXPECT_TRUE(agree(c.normal, rotate(frame, {0, 0, 1})));
      if (c.depth < 0.01 - 2 * found.epsilon) continue;
      (to_local(frame, c.position)[0] < 0 ? left : right) = true;
    }
    EXPECT_TRUE(left && right);
  }
}

TEST(ReferenceContacts, AContainedPartAndAShallowOneAreEachAsDeepAsTheyAre) {
  for (const int cells : {1, 5}) {
    const TestMesh small = make_cube(0.02, cells);
    const TestMesh both = merged(moved(small, {-0.05, 0, 0.1 - 0.0403 + 0.01}),
                                 moved(small, {0.05, 0.01, 0.1 - 0.01 + 0.01}));
    const auto found = collide(both, {}, make_cube(0.2, cells), {});
    ASSERT_EQ(found.found.regions.size(), 2u);
    double left = 0, right = 0;
    for (const ReferenceContact& c : found.contacts) {
      EXPECT_TRUE(agree(c.normal, {0, 0, 1}));
      double& depth = c.position[0] < 0 ? left : right;
      depth = std::max(depth, c.depth);
    }
    EXPECT_NEAR(left, 0.0403, 3 * found.epsilon);
    EXPECT_NEAR(right, 0.01, 3 * found.epsilon);
  }
}

TEST(ReferenceContacts, ACubeStackedExactlyOnAnotherTouchesItAtFourCorners) {
  const auto found = collide(make_cube(1, 3), at(0, 0, 1), make_cube(1), {});
  ASSERT_EQ(found.contacts.size(), 4u);
  for (const ReferenceContact& c : found.contacts) {
    EXPECT_EQ(c.depth, 0);
    EXPECT_TRUE(agree(c.normal, {0, 0, 1}));
    EXPECT_NEAR(std::fabs(c.position[0]) + std::fabs(c.position[1]), 1, 1e-4);
  }
}

TEST(ReferenceContacts, ACopyAtOnePlaceIsAsDeepAsItIsWide) {
  const TestMesh box = make_box({1, 0.5, 0.75});
  const auto found = collide(box, {}, box, {});
  EXPECT_NEAR(deepest(found), 0.5, 3 * found.epsilon);
  EXPECT_NEAR(std::fabs(found.contacts[0].normal[1]), 1, 1e-5);
  EXPECT_EQ(found.manifolds.size(), 1u);
}

TEST(ReferenceContacts, WhatIsContainedLeavesByTheNearestFace) {
  const TestMesh large = make_cube(1), small = make_cube(0.1);
  const auto inner_first = collide(small, at(0.1, -0.3, 0.05), large, {});
  EXPECT_NEAR(deepest(inner_first), 0.25, 3 * inner_first.epsilon);
  EXPECT_TRUE(agree(inner_first.contacts[0].normal, {0, -1, 0}));
  const auto outer_first = collide(large, {}, small, at(0.1, -0.3, 0.05));
  EXPECT_NEAR(deepest(outer_first), 0.25, 3 * outer_first.epsilon);
  EXPECT_TRUE(agree(outer_first.contacts[0].normal, {0, 1, 0}));
  EXPECT_EQ(inner_first.contacts.size(), 4u);
}

TEST(ReferenceContacts, SingleTrianglesTouchWhereTheyCross) {
  const TestMesh triangle = make_triangle(1);
  const TestPose upright = turned({1, 0, 0}, std::numbers::pi / 2, {0, 0, 0.05});
  const auto crossing = collide(triangle, upright, triangle, {});
  EXPECT_FALSE(crossing.contacts.empty());
  EXPECT_EQ(crossing.found.regions.size(), 1u);
  EXPECT_TRUE(collide(triangle, at(0, 0, 0.01), triangle, {}).contacts.empty());
}

TEST(ReferenceContacts, ASheetHoldsACubeUpAtItsCorners) {
  const auto found = collide(make_cube(0.5), at(0, 0, 0.24), make_sheet(3, 4), {});
  EXPECT_EQ(found.contacts.size(), 4u);
  for (const ReferenceContact& c : found.contacts) {
    EXPECT_NEAR(c.depth, 0.01, 3 * found.epsilon);
    EXPECT_TRUE(agree(c.normal, {0, 0, 1}));
  }
}

TEST(ReferenceContacts, TheOrderOfTrianglesDoesNotShow) {
  const TestMesh comb = make_comb(3, 0.3, 0.5, 0.4), ring = make_torus(0.8, 0.2, 24, 12);
  const ContactMesh a(comb), b(ring), a2(permuted(comb, 1)), b2(permuted(ring, 2));
  Random random(5);
  int colliding = 0;
  for (int i = 0; i < 30; ++i) {
    const TestPose pa = random.pose(0.7), pb = random.pose(0.7);
    const auto first = reference_contacts(a, pa, b, pb), again = reference_contacts(a2, pa, b2, pb);
    ASSERT_EQ(first.contacts.size(), again.contacts.size());
    colliding += !first.contacts.empty();
    for (std::size_t k = 0; k < first.contacts.size(); ++k) {
      EXPECT_EQ(first.contacts[k].position, again.contacts[k].position);
      EXPECT_EQ(first.contacts[k].normal, again.contacts[k].normal);
      EXPECT_EQ(first.contacts[k].depth, again.contacts[k].depth);
    }
  }
  EXPECT_GT(colliding, 10);
}

TEST(ReferenceContacts, AMeshWoundTheWrongWayRoundIsTheSame) {
  const TestMesh l = make_l(1), ball = make_icosphere(0.5, 1);
  Random random(9);
  for (int i = 0; i < 20; ++i) {
    const TestPose pa = random.pose(0.5), pb = random.pose(0.5);
    const auto right = collide(l, pa, ball, pb), wrong = collide(inverted(l), pa, ball, pb);
    ASSERT_EQ(right.contacts.size(), wrong.contacts.size());
    for (std::size_t k = 0; k < right.contacts.size(); ++k)
      EXPECT_EQ(right.contacts[k].position, wrong.contacts[k].position);
  }
}

// The convex shapes that pairs are made of.
std::vector<TestMesh> convex_shapes(Random& random) {
  return {make_cube(1),           make_tetrahedron(1.4),      make_octahedron(0.5),
          make_icosphere(0.5, 1), make_cylinder(0.35, 1, 16), make_random_hull(random, 20, 0.5)};
}

TEST(ReferenceContacts, MovingByTheDeepestContactPartsConvexBodies) {
  Random random(3);
  const std::vector<TestMesh> shapes = convex_shapes(random);
  const auto any = [&] {
    return static_cast<std::size_t>(random.below(static_cast<int>(shapes.size())));
  };
  int colliding = 0, parted = 0;
  for (int i = 0; i < 1000; ++i) {
    const TestMesh &a = shapes[any()], &b = shapes[any()];
    TestPose pa = random.pose(0.7);
    const TestPose pb = random.pose(0.7);
    const auto found = collide(a, pa, b, pb);
    const ConvexSolid sa(a), sb(b);
    const WayOut way = shortest_way_out(sa, pa, sb, pb);
    EXPECT_EQ(found.contacts.empty(), way.depth < -found.epsilon) << way.depth;
    // Where bodies go on through one another the depth is that of what overlaps, not of all.
    if (found.contacts.empty() || way.depth < 0 || way.depth > 0.15) continue;
    ++colliding;
    EXPECT_LE(found.manifolds.size(), 1u);  // convex bodies overlap in one convex region
    EXPECT_GT(deepest(found), 0.9 * way.depth);
    EXPECT_LT(deepest(found), 1.001 * way.depth + (kDepthTie + 3) * found.epsilon);
    pa.position = pa.position + found.contacts[0].depth * found.contacts[0].normal;
    const double left = shortest_way_out(sa, pa, sb, pb).depth;
    EXPECT_LT(left, 0.1 * way.depth + 2 * found.epsilon);
    parted += left < 2 * found.epsilon;
  }
  EXPECT_GT(colliding, 100);
  EXPECT_GE(parted, 0.95 * colliding);
}

// Whether the move that a manifold says clears what it claims.
void expect_cleared(const ContactPair& pair, const ReferenceContacts& found) {
  const auto& features = found.found;
  std::vector<bool> claimed(features.units.size(), false);
  for (const ContactManifold& m : found.manifolds) {
    EXPECT_NEAR(length(m.plane.normal), 1, 1e-12);
    EXPECT_GE(m.depth, 0);
    for (const std::size_t u : m.units) claimed[u] = true;
    if (!features.regions[m.region].whole) continue;
    double low = m.plane.bottom, high = m.plane.top;
    for (const std::size_t i : features.regions[m.region].features) {
      const ContactFeature& f = features.features[i];
      const double height = dot(m.plane.normal, f.position);
      if (f.flat) continue;
      if (f.is_crossing() || f.side == 0) low = std::min(low, height);
      if (f.is_crossing() || f.side == 1) high = std::max(high, height);
    }
    EXPECT_NEAR(m.depth, high - low, pair.epsilon());
  }
  EXPECT_EQ(std::count(claimed.begin(), claimed.end(), false), 0);
}

std::vector<TestMesh> solids() {
  return {make_cube(1), make_l(1), make_comb(3, 0.2, 0.4, 0.3), make_torus(0.5, 0.2, 24, 12),
          make_icosphere(0.5, 2)};
}

TEST(ReferenceContacts, EveryUnitIsClearedByAChosenPlane) {
  std::vector<ContactMesh> meshes;
  for (const TestMesh& mesh : solids()) meshes.emplace_back(mesh);
  Random random(7);
  int whole = 0, other = 0;
  for (const ContactMesh& a : meshes)
    for (const ContactMesh& b : meshes)
      for (int i = 0; i < 6; ++i) {
        const TestPose pa = random.pose(0.5), pb = random.pose(0.5);
        const auto found = reference_contacts(a, pa, b, pb);
        expect_cleared(ContactPair(a, pa, b, pb), found);
        EXPECT_EQ(found.found.odd_pairs, 0);
        for (const ContactRegion& r : found.found.regions) ++(r.whole ? whole : other);
      }
  EXPECT_GT(whole, 50);
  EXPECT_GT(other, 20);
}

TEST(ReferenceContacts, NoTwoManifoldsOfARegionOpposeEachOtherUnlessTheOtherWayIsTwiceAsDeep) {
  const TestMesh comb = make_comb(4, 0.2, 0.4, 0.3), wall = make_box({3, 0.1, 1});
  const auto found = collide(comb, turned({1, 0, 0}, 0.01, {0, 0.02, 0.55}), wall, {});
  ASSERT_FALSE(found.contacts.empty());
  for (const ReferenceContact& c : found.contacts)
    for (const ReferenceContact& d : found.contacts) EXPECT_GT(dot(c.normal, d.normal), kOpposes);
}

// The cube is in one arm of a U, 20 mm from the slit between the arms, which is 10 mm wide: through
// it the cube would be in the other arm.
TEST(ReferenceContacts, NoPlaneSendsABodyFromOnePartOfAnotherIntoTheNext) {
  const TestMesh arm = make_box({0.3, 0.6, 1});
  const TestMesh u = merged(moved(arm, {-0.155, 0, 0}), moved(arm, {0.155, 0, 0}));
  const auto found = collide(make_cube(0.1), at(-0.1, 0, 0), u, {});
  ASSERT_FALSE(found.contacts.empty());
  const ReferenceContact& c = found.contacts[0];
  EXPECT_LT(c.normal[0], 0.5);
  ContactOptions careless;
  careless.check_ways = false;
  EXPECT_GT(collide(make_cube(0.1), at(-0.1, 0, 0), u, {}, careless).contacts[0].normal[0], 0.9);
}

class ReferenceRegions : public testing::TestWithParam<RegionCase> {};

TEST_P(ReferenceRegions, EveryRegionHasAContact) {
  const RegionCase& c = GetParam();
  const FclSurface a(c.a), b(c.b);
  const SurfaceGraph ga(c.a), gb(c.b);
  const auto regions =
      find_regions(ga, c.pose_a, gb, c.pose_b, intersecting_triangles(a, c.pose_a, b, c.pose_b));
  ASSERT_EQ(regions.size(), static_cast<std::size_t>(c.regions));
  const auto found = collide(c.a, c.pose_a, c.b, c.pose_b);
  EXPECT_EQ(found.found.regions.size(), regions.size());
  std::vector<dContactGeom> contacts;
  for (const ReferenceContact& from : found.contacts) {
    contacts.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      contacts.back().pos[k] = from.position[k];
      contacts.back().normal[k] = from.normal[k];
    }
    contacts.back().depth = from.depth;
  }
  const double smaller = std::min(mesh_size(c.a), mesh_size(c.b));
  EXPECT_TRUE(without_contact(regions, contacts, c.pose_b, smaller).empty());
}

INSTANTIATE_TEST_SUITE_P(Cases, ReferenceRegions, testing::ValuesIn(region_cases()),
                         [](const auto& case_info) { return case_info.param.name; });

TEST(ReferenceCollider, AnswersInODEsPlaceAndInEitherOrder) {
  OdeWorld world;
  const OdeMesh &cube = world.mesh(make_cube(1)), &l = world.mesh(make_l(1));
  const dGeomID g1 = world.geom(cube, at(0.1, 0.2, 0.6)),
                g2 = world.geom(l, turned({1, 1, 0}, 0.1));
  const ReferenceCollider collider;
  const Contacts first = test::collide(g1, g2), second = test::collide(g2, g1);
  EXPECT_FALSE(first.empty());
  EXPECT_EQ(difference_with_geoms(first, flipped(second)), "");
  EXPECT_EQ(difference(first, ReferenceCollider::collide(g1, g2, {})), "");
}

}  // namespace
}  // namespace ode_ext::test
