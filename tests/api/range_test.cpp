// SPDX-License-Identifier: BSD-3-Clause
// Sizes and places for which there are contacts, and what is said of the others.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>

#include "support/batch_collider.h"
#include "support/messages.h"

namespace ode_ext::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A body one vertex of which is lowest, that far below the ground's top.
struct Sunk {
  TestMesh body, ground;
  TestPose pose;
  Point lowest;
};
constexpr double kDepth = 0.05;

Sunk sunk(const TestMesh& body, const TestMesh& ground, double top) {
  Sunk result{body, ground, turned({1, 2, 3}, 0.7), {}};
  double least = kInfinity;
  for (int i = 0; i < body.vertex_count(); ++i) {
    const Point p = rotate(result.pose, body.vertex(static_cast<std::size_t>(i)));
    if (p[2] < least) result.lowest = p;
    least = std::min(least, p[2]);
  }
  result.pose.position = Point{0.1, 0.07, top - kDepth} - result.lowest;
  result.lowest = {0.1, 0.07, top - kDepth};
  return result;
}

TestMesh without_bottom(const TestMesh& mesh) {
  TestMesh open{mesh.vertices, {}};
  for (std::size_t t = 0; t < static_cast<std::size_t>(mesh.triangle_count()); ++t)
    if (std::max({mesh.corner(t, 0)[2], mesh.corner(t, 1)[2], mesh.corner(t, 2)[2]}) > 0)
      for (std::size_t k = 0; k < 3; ++k) open.indices.push_back(mesh.indices[3 * t + k]);
  return open;
}

class ApiRange : public ::testing::Test {
 protected:
  static std::vector<Sunk> all_sunk() {
    return {sunk(make_cube(1), make_box({3, 3, 1}), 0.5),
            sunk(make_icosphere(0.6, 1), without_bottom(make_box({3, 3, 1})), 0.5),
            sunk(make_torus(0.5, 0.2, 12, 8), make_box({3, 3, 1}), 0.5)};
  }
  // The contacts of each, made `scale` times as large.
  std::vector<Contacts> contacts_of(const std::vector<Sunk>& pairs, double scale) {
    std::vector<dGeomID> geoms;
    for (const Sunk& pair : pairs) {
      TestPose pose = pair.pose;
      pose.position = scale * pose.position;
      geoms.push_back(world.geom(world.mesh(scaled(pair.body, scale)), pose));
      geoms.push_back(world.geom(world.mesh(scaled(pair.ground, scale)), {}));
    }
    constexpr int kLimit = 16;
    Contacts all(kLimit * pairs.size());
    std::vector<int> counts(pairs.size());
    EXPECT_GE(dBatchColliderCollidePairs(collider, geoms.data(), static_cast<int>(pairs.size()),
                                         kLimit, all.data(), sizeof(dContactGeom), counts.data()),
              0)
        << last_error();
    std::vector<Contacts> contacts;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto first = all.begin() + static_cast<std::ptrdiff_t>(kLimit * i);
      contacts.emplace_back(first, first + counts[i]);
    }
    return contacts;
  }
  bool refused() const { return (collider.stats().status & dBatchStatusMeshRefused) != 0; }

  const TestMesh cube = make_cube(1);
  OdeWorld world;
  BatchCollider collider;
};

TEST_F(ApiRange, MeshesOfAnySizeHaveTheirContactsOrAreRefused) {
  const std::vector<Sunk> pairs = all_sunk();
  for (int exponent = -25; exponent <= 25; ++exponent) {
    const double scale = std::pow(10.0, exponent);
    const std::vector<Contacts> contacts = contacts_of(pairs, scale);
    ASSERT_EQ(refused(), exponent < -9 || exponent > 10) << exponent;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      SCOPED_TRACE(testing::Message() << "pair " << i << " at 1e" << exponent);
      ASSERT_EQ(contacts[i].empty(), refused());
      if (refused()) continue;
      const dContactGeom& deepest = contacts[i][0];
      EXPECT_NEAR(deepest.depth / scale, kDepth, 1e-4 * kDepth);
      EXPECT_NEAR(normal(deepest)[2], 1, 1e-4);
      EXPECT_LE(distance((1 / scale) * pos(deepest), pairs[i].lowest), 1e-4);
    }
  }
}

TEST_F(ApiRange, MeshesAHundredMillionTimesTheOthersSizeCollide) {
  for (const double large : {1e-1, 1.0, 1e4, 1e10}) {
    const double small = 1e-8 * large;
    const dGeomID ground = world.geom(world.mesh(make_box({large, large, large})), {});
    const dGeomID speck =
        world.geom(world.mesh(make_icosphere(small, 1)), at(0.1 * large, 0.2 * large, 0.5 * large));
    EXPECT_FALSE(collide(speck, ground).empty()) << large;
    EXPECT_FALSE(refused()) << large;
  }
}

TEST_F(ApiRange, AStrayVertexRefusesItsMeshAndSaysSoOnce) {
  for (const float stray : {1e11f, -1e13f, 1e20f, 1e30f, 3e38f}) {
    SCOPED_TRACE(stray);
    const dSpaceID space = world.space(SpaceKind::Simple);
    OdeMesh& mesh = world.mesh(cube);
    const dGeomID broken = world.geom(mesh, {}, space);
    const dGeomID other = world.geom(world.mesh(cube), at(0.1, 0.2, 0.9), space);
    mesh.edit().vertices[0] = stray;  // after ODE has sized the box
    const Messages messages;
    for (int pass = 0; pass < 3; ++pass) {
      EXPECT_EQ(collider.pass(space).total(), 0);
      EXPECT_TRUE(refused());
      mesh.edit().vertices[1] += 0.01f;  // it goes on changing
    }
    ASSERT_EQ(messages.said().size(), 1u);
    EXPECT_NE(messages.said()[0].find("a mesh of 12 triangles reaches"), std::string::npos)
        << messages.said()[0];
    mesh.edit().vertices = cube.vertices;  // in place
    EXPECT_GT(collider.pass(space).total(), 0);
    EXPECT_FALSE(refused());
    dGeomDisable(broken);
    dGeomDisable(other);
  }
}

TEST_F(ApiRange, ADeformableMeshIsRefusedForAsLongAsItIsTooLarge) {
  const dSpaceID space = world.space(SpaceKind::Simple);
  OdeMesh& mesh = world.mesh(cube);
  world.geom(mesh, {}, space);
  world.geom(world.mesh(cube), at(0.1, 0.2, 0.9), space);
  dBatchColliderTriMeshDataSetDeformable(collider, mesh.id(), 1);
  EXPECT_GT(collider.pass(space).total(), 0);
  mesh.edit().vertices[0] = 1e20f;
  EXPECT_EQ(collider.pass(space).total(), 0);
  EXPECT_TRUE(refused());
  mesh.edit().vertices = cube.vertices;  // in place
  EXPECT_GT(collider.pass(space).total(), 0);
  EXPECT_FALSE(refused());
}

TEST_F(ApiRange, PosesThatCannotBeComputedAreRefusedWithAStatusBit) {
  const dGeomID still = world.geom(world.mesh(cube), {});
  OdeMesh& mesh = world.mesh(cube);
  const TestPose good = at(0.1, 0.2, 0.9);
  const auto status_at = [&](const TestPose& pose) {
    const dGeomID geom = world.geom(mesh, {});
    set_pose(geom, pose);
    const dGeomID pair[] = {geom, still};
    dContactGeom contacts[8];
    int count = -1;
    dBatchColliderCollidePairs(collider, pair, 1, 8, contacts, sizeof contacts[0], &count);
    const unsigned status = collider.stats().status;
    EXPECT_EQ(count > 0, (status & dBatchStatusPoseRefused) == 0);
    return status;
  };
  EXPECT_EQ(status_at(good), 0u);
  for (const double bad : {kNan, kInfinity, -kInfinity, 1e37, 1e300}) {
    TestPose away = good, skewed = good;
    away.position[1] = bad;
    skewed.rotation[4] = bad;
    EXPECT_EQ(status_at(away), unsigned{dBatchStatusPoseRefused}) << bad;
    EXPECT_EQ(status_at(skewed), unsigned{dBatchStatusPoseRefused}) << bad;
    EXPECT_EQ(status_at(good), 0u);
  }
}

TEST_F(ApiRange, PosesTurnedByNoRotationAreRefusedWithAStatusBit) {
  const dGeomID still = world.geom(world.mesh(cube), {});
  const dGeomID moved = world.geom(world.mesh(cube), {});
  const auto status_at = [&](const std::array<double, 9>& rotation) {
    TestPose pose = at(0.1, 0.2, 0.9);
    pose.rotation = rotation;
    set_pose(moved, pose);
    const bool none = answer_of(collider, moved, still).empty();
    const unsigned status = collider.stats().status;
    EXPECT_EQ(none, (status & dBatchStatusPoseRefused) != 0);
    return status;
  };
  const double c = std::cos(0.3), s = std::sin(0.3);
  EXPECT_EQ(status_at({c, -s, 0, s, c, 0, 0, 0, 1}), 0u);
  EXPECT_EQ(status_at({0.955, -0.296, 0, 0.296, 0.955, 0, 0, 0, 1}), 0u) << "three digits";
  const std::array<double, 9> bad[] = {{1, 0, 0, 0, 1, 0, 0, 0, -1},       // a mirror
                                       {1.1, 0, 0, 0, 1.1, 0, 0, 0, 1.1},  // larger
                                       {1, 0, 0.1, 0, 1, 0, 0, 0, 1},      // askew
                                       {0, 0, 0, 0, 0, 0, 0, 0, 0}};
  for (const auto& rotation : bad)
    EXPECT_EQ(status_at(rotation), unsigned{dBatchStatusPoseRefused}) << rotation[8];
}

}  // namespace
}  // namespace ode_ext::test
