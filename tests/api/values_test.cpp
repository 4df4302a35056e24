// SPDX-License-Identifier: BSD-3-Clause
// The contacts themselves, against hand-computed values and independent oracles.
#include <algorithm>
#include <cmath>

#include "geometry/mesh_oracle.h"
#include "reference/reference_hits.h"
#include "support/batch_collider.h"
#include "support/ccd_oracle.h"
#include "support/fcl_oracle.h"

namespace ode_ext::test {
namespace {

class ApiValues : public ::testing::Test {
 protected:
  Contacts contacts_of(const TestMesh& a, const TestPose& pa, const TestMesh& b,
                       const TestPose& pb) {
    const dGeomID g1 = world.geom(world.mesh(a), pa), g2 = world.geom(world.mesh(b), pb);
    const Contacts contacts = collide(g1, g2);
    world.destroy(g1);
    world.destroy(g2);
    return contacts;
  }

  OdeWorld world;
  BatchCollider collider;
};

TEST_F(ApiValues, OfACubeSunkIntoABlockHoldUpItsFourCorners) {
  const TestMesh cube = make_cube(2), block = make_box({6, 6, 2});
  for (const bool turned_round : {false, true}) {
    const TestPose upper = turned({0, 0, 1}, 0.3, {0.1, 0.2, 1.9});
    const Contacts contacts = turned_round ? flipped(contacts_of(block, {}, cube, upper))
                                           : contacts_of(cube, upper, block, {});
    // Coordinates up to 3 m in floats, see rounding_bound.
    const double tolerance = rounding_bound(4);
    for (const dContactGeom& c : contacts) {
      EXPECT_LT(distance(normal(c), {0, 0, 1}), 1e-6);
      EXPECT_NEAR(c.depth, 0.1, tolerance);
    }
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0}) {
        const Point corner = to_world(upper, {x, y, -1});
        EXPECT_TRUE(std::any_of(contacts.begin(), contacts.end(),
                                [&](const dContactGeom& c) {
                                  return distance(pos(c), corner) <
                                         0.1 + tolerance;  // on the corner or above it
                                }))
            << x << ", " << y;
      }
    }
  }
}

// Aligned and of equal size, every corner on the other's side faces: taken literally the paper's
// rule finds nothing here.
TEST_F(ApiValues, OfAlignedEqualCubesPushThemApartTheShortWay) {
  const TestMesh cube = make_cube(2);
  const Contacts contacts = contacts_of(cube, at(0, 0, 1.9), cube, {});
  EXPECT_GE(contacts.size(), 4u);
  for (const dContactGeom& c : contacts) {
    EXPECT_LT(distance(normal(c), {0, 0, 1}), 1e-6);
    EXPECT_NEAR(c.depth, 0.1, rounding_bound(4));
  }
}

// Spheres that overlap by 0.05: contacts within the lens, normals along the centres.
TEST_F(ApiValues, OfSpheresLieInTheLensAndPointAlongTheCentres) {
  const TestMesh ball = make_icosphere(1, 3);
  Random random(9);
  for (int i = 0; i < 10; ++i) {
    const Point direction = random.direction();
    const TestPose second{1.95 * direction, random.pose(0).rotation};
    const Contacts contacts = contacts_of(ball, random.pose(0), ball, second);
    ASSERT_FALSE(contacts.empty());
    // The lens is acos(1.95 / 2) = 0.224 rad wide each way, a facet's normal is off by up to half
    // an edge (0.16 rad at most) more.
    for (const dContactGeom& c : contacts) {
      EXPECT_GT(dot(normal(c), -1 * direction), std::cos(0.224 + 0.16));
      EXPECT_LE(c.depth, 0.05 + rounding_bound(3));
      EXPECT_LT(distance(pos(c), 0.975 * direction), std::sin(0.224) + 0.05);
    }
    // A vertex is at most half an edge from the line of centres, and there 0.16^2 / 2 less deep.
    EXPECT_GT(contacts[0].depth, 0.05 - 0.16 * 0.16 / 2 - 2 * (1 - std::cos(0.08)));
  }
}

// By distances of the vertices from the other surface. (How deep they are is compared with the
// reference of contacts in contacts/assembly_test.cpp.)
TEST_F(ApiValues, AtVerticesAreOfVerticesInside) {
  const TestMesh torus = make_torus(0.6, 0.25, 24, 16), ball = make_icosphere(0.6, 3);
  const oracle::Mesh surfaces[] = {{torus.vertices, torus.indices}, {ball.vertices, ball.indices}};
  Random random(21);
  int compared = 0;
  for (int i = 0; i < 20; ++i) {
    const TestPose poses[] = {random.pose(0.5), random.pose(0.5)};
    const double tolerance = 10 * comparison_tolerance(torus, poses[0], ball, poses[1]);
    const Contacts contacts = contacts_of(torus, poses[0], ball, poses[1]);
    for (const dContactGeom& c : contacts)
      for (const std::size_t side : {0u, 1u}) {
        const TestMesh& source = side == 0 ? torus : ball;
        bool is_vertex = false;
        for (std::size_t v = 0; v < static_cast<std::size_t>(source.vertex_count()); ++v)
          is_vertex = is_vertex || distance(to_world(poses[side], source.vertex(v)), pos(c)) < 1e-9;
        if (!is_vertex) continue;
        const Point p = to_local(poses[1 - side], pos(c));
        const double inside = -surfaces[1 - side].signed_distance({p[0], p[1], p[2]});
        EXPECT_GT(inside, -tolerance) << "pair " << i;
        ++compared;
      }
  }
  EXPECT_GT(compared, 50);
}

TEST_F(ApiValues, AreNoneWhereNothingMeets) {
  const TestMesh torus = make_torus(0.6, 0.25, 12, 8), l = make_l(1.2);
  Random random(33);
  int apart = 0;
  for (int i = 0; i < 200; ++i) {
    const TestPose pa = random.pose(0.8), pb = random.pose(0.8);
    if (surfaces_intersect_robustly(torus, pa, l, pb) != OracleAnswer::Apart) continue;
    if (one_contains_the_other(torus, pa, l, pb)) continue;
    ++apart;
    EXPECT_TRUE(contacts_of(torus, pa, l, pb).empty()) << "pair " << i;
  }
  EXPECT_GT(apart, 20);
}

// Wherever the reference finds a vertex inside there must be a contact.
TEST_F(ApiValues, ExistWhereverAVertexIsInside) {
  const TestMesh torus = make_torus(0.6, 0.25, 12, 8), l = make_l(1.2);
  Random random(34);
  int inside = 0;
  for (int i = 0; i < 200; ++i) {
    const TestPose pa = random.pose(0.8), pb = random.pose(0.8);
    const auto hits = reference_hits(torus, pa, l, pb);
    if (std::none_of(hits.begin(), hits.end(), [](const ReferenceHit& hit) {
          return !hit.ambiguous && hit.kind != HitKind::Touching;
        })) {
      continue;
    }
    ++inside;
    EXPECT_FALSE(contacts_of(torus, pa, l, pb).empty()) << "pair " << i;
  }
  EXPECT_GT(inside, 50);
}

TEST_F(ApiValues, ExistWhereOneMeshIsInsideTheOther) {
  Random random(35);
  for (int i = 0; i < 20; ++i) {
    const TestPose pa = random.pose(0.2), pb = random.pose(0.2);
    const TestMesh large = make_cube(4, 2), small = make_torus(0.6, 0.25, 12, 8);
    EXPECT_FALSE(contacts_of(small, pa, large, pb).empty());
    EXPECT_FALSE(contacts_of(large, pa, small, pb).empty());
  }
}

// For shallow overlaps of convex meshes the contacts' normals and depths are the true ones:
// libccd's least separation. Shallow: a face's depth is the separation only while no side is
// nearer.
TEST_F(ApiValues, OfShallowConvexPairsAreTheShortestWayOut) {
  const TestMesh cube = make_cube(1), block = make_box({6, 6, 2});
  Random random(36);
  for (int i = 0; i < 50; ++i) {
    const TestPose tilt = random.pose(0);
    double lowest = 0;
    for (std::size_t v = 0; v < 8; ++v) {
      lowest = std::min(lowest, rotate(tilt, cube.vertex(v))[2]);
    }
    const double depth = random.uniform(0.005, 0.03);
    const Point place{random.uniform(-1, 1), random.uniform(-1, 1), 1 - lowest - depth};
    const TestPose upper{place, tilt.rotation};
    const ConvexPenetration out = convex_penetration(cube, upper, block, {});
    ASSERT_TRUE(out.overlap);
    ASSERT_NEAR(out.depth, depth, 1e-4);
    const Contacts contacts = contacts_of(cube, upper, block, {});
    ASSERT_FALSE(contacts.empty());
    EXPECT_NEAR(contacts[0].depth, depth, rounding_bound(4));
    for (const dContactGeom& c : contacts) {
      EXPECT_LT(distance(normal(c), {0, 0, 1}), 1e-6);
      EXPECT_LE(c.depth, depth + rounding_bound(4));
    }
  }
}

}  // namespace
}  // namespace ode_ext::test
