// SPDX-License-Identifier: BSD-3-Clause
// Where rays run along faces, through edges and into corners, because everything lies on one
// lattice: a vertex inside has a hit all the same, one outside has none, by rays and by the flood.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <tuple>

#include "geometry/mesh_oracle.h"
#include "search/inside_oracle.h"
#include "support/rig.h"

namespace ode_ext::test {
namespace {

// One of the 24 rotations that map the axes onto the axes.
TestPose lattice_pose(Random& random) {
  TestPose pose;
  pose.rotation = {};
  std::array<std::size_t, 3> axis{0, 1, 2};
  for (std::size_t i = 3; i > 1; --i)
    std::swap(axis[i - 1], axis[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
  double sign[3];
  for (double& s : sign) s = random.below(2) == 0 ? 1 : -1;
  const bool even = (axis[1] + 3 - axis[0]) % 3 == 1;
  if (sign[0] * sign[1] * sign[2] * (even ? 1 : -1) < 0) sign[2] = -sign[2];
  for (std::size_t i = 0; i < 3; ++i) pose.rotation[3 * i + axis[i]] = sign[i];
  for (double& x : pose.position) x = 0.125 * (random.below(13) - 6);
  return pose;
}

std::vector<TestMesh> lattice_meshes() {
  return {
      make_cube(1, 2), make_cube(1),           make_box({1, 0.5, 0.25}, 2, 2, 1), make_cube(0.25),
      make_l(1),       make_plate(1, 0.25, 4), make_box({0.5, 1.5, 0.5}, 1, 3, 1)};
}

TEST(Aligned, HitsFromInsideAndOnlyFromThere) {
  TestScene scene;
  std::vector<oracle::Mesh> solids;
  for (const TestMesh& mesh : lattice_meshes()) {
    scene.add_mesh(mesh);
    solids.emplace_back(mesh.vertices, mesh.indices);
  }
  const int kinds = static_cast<int>(solids.size());
  Random random(81);
  for (int i = 0; i < 3000; ++i) {
    const auto a = static_cast<std::uint32_t>(random.below(kinds));
    const auto b = static_cast<std::uint32_t>(random.below(kinds));
    const TestPose frame = i % 3 == 0 ? random.pose(10) : TestPose{};  // exact, and rounded
    const TestPose pa = composed(frame, lattice_pose(random));
    scene.add_pair(a, pa, b, composed(frame, lattice_pose(random)));
  }
  for (const bool flooded : {false, true}) {
    const StepRecords records =
        flooded ? Rig::shared().run_with_edges(scene.scene, Organization::kPipelined, {8, 64}, true)
                : Rig::shared().run(scene.scene);
    std::set<std::tuple<ox_u32, std::uint32_t>> hits;  // pair_side, vertex of its mesh
    for (const ox_hit& hit : records.hits) {
      const auto& pair = scene.pairs[hit.pair_side >> 1];
      const std::uint32_t mesh = scene.objects[pair[hit.pair_side & 1]].mesh;
      hits.insert({hit.pair_side, Rig::shared().local_vertex(mesh, hit.vertex)});
    }
    int inside = 0, outside = 0, on_surface = 0;
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      const double doubt = kDoubt * static_cast<double>(records.pairs[i].epsilon);
      for (std::uint32_t side = 0; side < 2; ++side) {
        const TestPose &ps = scene.pose_of(i, side), &pt = scene.pose_of(i, 1 - side);
        const Mesh& source = scene.built_mesh_of(i, side);
        const oracle::Mesh& solid = solids[scene.objects[scene.pairs[i][1 - side]].mesh];
        const auto bounds = bounding_vertices(source, scene.built_mesh_of(i, 1 - side));
        for (std::uint32_t v = 0; v < source.vertices.size(); ++v) {
          const Point p = rotate_back(
              pt, rotate(ps, point_of(source.vertices[v])) + (ps.position - pt.position));
          const double distance = solid.signed_distance({p[0], p[1], p[2]});
          const bool is_hit = hits.contains({static_cast<ox_u32>(i) << 1 | side, v});
          if (distance < -doubt) {
            ++inside;
            // A flood leaves out what bounds nothing.
            EXPECT_EQ(is_hit, !flooded || bounds[v])
                << "pair " << i << " side " << side << ", deep " << -distance << ", flooded "
                << flooded;
          } else if (distance > doubt) {
            ++outside;
            EXPECT_FALSE(is_hit) << "pair " << i << " side " << side << ", flooded " << flooded;
          } else {
            ++on_surface;
          }
        }
      }
    }
    EXPECT_GT(inside, 1000);
    EXPECT_GT(outside, 10000);
    EXPECT_GT(on_surface, 1000);
  }
}

// Of the only pair, as by default.
StepRecords collided(const TestScene& scene) {
  return Rig::shared().run_with_edges(scene.scene, Organization::kPipelined, {8, 64}, true);
}

// How much larger A is taken, and rounding, show in depths of crossings and edges.
double tolerance_of(const StepRecords& records) {
  return (kInflation + 2) * static_cast<double>(records.pairs[0].epsilon);
}

// All corners on faces or edges of the other: nothing is inside, and yet there is an overlap.
TEST(Aligned, EqualBoxesAreInContactAtEveryOverlap) {
  Random random(82);
  for (const double overlap : {0.001, 0.1, 0.25, 0.5, 0.9, 0.999, 1.0}) {
    for (const int n : {1, 2, 3}) {
      for (int i = 0; i < 20; ++i) {
        const TestPose frame = i == 0 ? TestPose{} : random.pose(10);
        Point offset{};
        offset[static_cast<std::size_t>(i % 3)] = 1 - overlap;
        const TestScene scene =
            one_pair(make_cube(1, n), composed(frame, at(offset[0], offset[1], offset[2])),
                     make_cube(1, n), frame);
        const StepRecords records = collided(scene);
        ASSERT_GT(records.contacts.size(), 0u) << overlap << ", " << n;
        EXPECT_NEAR(records.contacts[0].depth, overlap, tolerance_of(records))
            << overlap << ", " << n << ", frame " << i;
        if (overlap == 1) continue;  // any plane is as near
        for (const ox_contact& contact : records.contacts)
          EXPECT_NEAR(std::fabs(contact.normal[i % 3]), 1, 1e-5) << overlap << ", " << n;
      }
    }
  }
}

TEST(Aligned, BoxesThatOnlyTouchHaveContactsOfDepthZero) {
  for (const double x : {0.0, 0.25, 0.5, 1.0}) {
    const TestScene scene = one_pair(make_cube(1, 2), at(x, 0, 1), make_cube(1, 2), TestPose{});
    const StepRecords records = collided(scene);
    EXPECT_GT(records.contacts.size(), 0u) << x;
    for (const ox_contact& contact : records.contacts)
      EXPECT_NEAR(contact.depth, 0, tolerance_of(records)) << x;
  }
}

// Rounding is a millimetre at the coordinates of a ground this wide. What is thinner than that
// has vertices on both of its sides that count as lying on the ground; they must not be taken for
// vertices that are as deep inside as the ground is thick.
TEST(Aligned, AThinPlateOnAWideGroundIsNotPushedThroughIt) {
  for (const double width : {10.0, 100.0, 1000.0, 2000.0}) {
    const TestMesh ground = make_box({width, width, 10}, 8, 8, 1);
    for (const double thickness : {0.01, 0.001, 0.0002}) {
      for (const double sunk : {0.1, 0.5, 0.9}) {
        const double height = 5 + thickness * (0.5 - sunk);
        const TestScene scene = one_pair(make_plate(0.2, thickness, 2),
                                         at(width / 4, width / 5, height), ground, TestPose{});
        const StepRecords records = collided(scene);
        ASSERT_GT(records.contacts.size(), 0u);
        for (const ox_contact& contact : records.contacts) {
          EXPECT_LE(contact.depth, 1.001 * thickness)
              << width << " m, " << thickness << " m, " << sunk;
        }
      }
    }
  }
}

}  // namespace
}  // namespace ode_ext::test
