// SPDX-License-Identifier: BSD-3-Clause
// The vertex step: no vertex that may be inside is lost, and few others get a ray.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "reference/reference_hits.h"
#include "search/oriented_box.h"
#include "support/fcl_oracle.h"
#include "support/rig.h"
#include "support/segment_crosses.h"

namespace ode_ext::test {
namespace {

using Key = std::tuple<std::size_t, int, Point>;  // pair, side, vertex in its own frame

std::set<Key> rays_of(const TestScene& scene, const StepRecords& records) {
  std::set<Key> rays;
  for (const ox_ray& ray : records.rays) {
    const std::size_t pair = ray.pair_side >> 1;
    const std::uint32_t side = ray.pair_side & 1;
    const std::uint32_t mesh = scene.objects[scene.pairs[pair][side]].mesh;
    const std::uint32_t vertex = Rig::shared().local_vertex(mesh, ray.vertex);
    const Point p = point_of(scene.scene.meshes[mesh]->vertices.at(vertex));
    EXPECT_TRUE(rays.insert({pair, static_cast<int>(side), p}).second) << "two rays of a vertex";
  }
  return rays;
}

// A point of the source in the frame of the target, not by way of the world, which may be far.
Point in_target(const TestScene& scene, std::size_t pair, std::size_t side, const Point& p) {
  const TestPose &ps = scene.pose_of(pair, side), &pt = scene.pose_of(pair, 1 - side);
  return rotate_back(pt, rotate(ps, p) + (ps.position - pt.position));
}

TEST(VertexStep, GivesARayToEveryVertexThatTheReferenceFindsInContact) {
  const TestScene scene = random_scene(800, 11);
  const auto rays = rays_of(scene, Rig::shared().run(scene.scene));
  int in_contact = 0, ambiguous = 0;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    // Two open meshes apart, but less than their thickness: none of the pair step's business.
    if (gap_of_pair(scene, i) > 0) continue;
    for (const ReferenceHit& hit : reference_hits(scene.mesh_of(i, 0), scene.pose_of(i, 0),
                                                  scene.mesh_of(i, 1), scene.pose_of(i, 1))) {
      ++in_contact;
      if (hit.ambiguous) {
        ++ambiguous;
        continue;
      }
      EXPECT_TRUE(rays.contains({i, hit.side, hit.vertex})) << "pair " << i;
    }
  }
  EXPECT_GT(in_contact, 3000);
  EXPECT_LT(1000 * ambiguous, in_contact);
}

TEST(VertexStep, GivesARayToEveryVertexInsideAClosedMesh) {
  const TestScene scene = random_scene(250, 12, kSmallClosedMeshCount);
  const auto rays = rays_of(scene, Rig::shared().run(scene.scene));
  int inside = 0;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    for (std::size_t side = 0; side < 2; ++side) {
      const TestMesh& target = scene.mesh_of(i, 1 - side);
      for (const Vec3f& vertex : scene.built_mesh_of(i, side).vertices) {
        const Point p = in_target(scene, i, side, point_of(vertex));
        // A half is as far from 0 as from 1: vertices on the surface itself do not come up.
        if (std::fabs(winding_number(target, p)) < 0.5) continue;
        ++inside;
        EXPECT_TRUE(rays.contains({i, static_cast<int>(side), point_of(vertex)})) << "pair " << i;
      }
    }
  }
  EXPECT_GT(inside, 1000);
}

// The least distance of the segment from p along d [m] to the box; convex, so a ternary search.
double distance_to_box(const Box& box, const Point& p, const Point& d, double reach) {
  const auto at = [&](double t) {
    Point apart{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = p[k] + t * d[k];
      apart[k] = std::fmax(
          0, std::fmax(x - static_cast<double>(box.hi[k]), static_cast<double>(box.lo[k]) - x));
    }
    return length(apart);
  };
  double lo = 0, hi = reach;
  for (int i = 0; i < 200; ++i) {
    const double third = (hi - lo) / 3;
    if (at(lo + third) < at(hi - third))
      hi -= third;
    else
      lo += third;
  }
  return at(lo);
}

// Whether the ray from p along d, as long as the exit, runs through a triangle.
bool meets(const Mesh& target, const Point& p, const Point& d, double exit) {
  const Vec3d from{p[0], p[1], p[2]};
  const Segment ray{from, from + exit * Vec3d{d[0], d[1], d[2]}};
  return std::any_of(
      target.topology->triangles.begin(), target.topology->triangles.end(), [&](const Triangle& t) {
        return crosses(ray, {Vec3d(target.vertices[t[0]]), Vec3d(target.vertices[t[1]]),
                             Vec3d(target.vertices[t[2]])});
      });
}

TEST(VertexStep, CastsARayAtAnOpenMeshWhereItMeetsItAndNoneThatDoesNotReachTheBox) {
  // A bowl: an open mesh whose box has a volume.
  const TestMesh whole = make_icosphere(0.6, 2);
  TestMesh bowl{whole.vertices, {}};
  for (std::size_t t = 0; t < static_cast<std::size_t>(whole.triangle_count()); ++t)
    if (whole.corner(t, 0)[2] + whole.corner(t, 1)[2] + whole.corner(t, 2)[2] < 0)
      for (std::size_t k = 0; k < 3; ++k) bowl.indices.push_back(whole.indices[3 * t + k]);
  TestScene scene;
  const std::uint32_t open[] = {scene.add_mesh(bowl), scene.add_mesh(make_sheet(1, 6))};
  const std::uint32_t closed[] = {scene.add_mesh(make_cube(0.7, 4)),
                                  scene.add_mesh(make_torus(0.5, 0.1, 16, 8))};
  Random random(14);
  for (int i = 0; i < 60; ++i) {
    // Drawn one after the other: compilers differ in the order of arguments.
    const TestPose a = random.pose(0.4), b = random.pose(0.4);
    scene.add_pair(closed[i % 2], a, open[random.below(2)], b);
  }
  const StepRecords records = Rig::shared().run(scene.scene);
  const auto rays = rays_of(scene, records);
  int near = 0, far = 0;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const double margin = static_cast<double>(records.pairs[i].margin);
    const Mesh& source = scene.built_mesh_of(i, 0);
    const Mesh& target = scene.built_mesh_of(i, 1);
    ASSERT_FALSE(target.closed());
    const TestPose &ps = scene.pose_of(i, 0), &pt = scene.pose_of(i, 1);
    for (std::size_t v = 0; v < source.vertices.size(); ++v) {
      const Point p = in_target(scene, i, 0, point_of(source.vertices[v]));
      const Point d = rotate_back(pt, rotate(ps, -1 * point_of(source.normals[v])));
      const double exit = static_cast<double>(source.exits[v]);
      const double apart = distance_to_box(target.box, p, d, exit);
      const bool has_ray = rays.contains({i, 0, point_of(source.vertices[v])});
      if (apart == 0) {
        if (!meets(target, p, d, exit)) continue;
        ++near;
        EXPECT_TRUE(has_ray);
      } else if (apart > 3 * margin) {  // on every axis, and beyond the end
        ++far;
        EXPECT_FALSE(has_ray) << apart;
      }
    }
  }
  EXPECT_GT(near, 1000);
  EXPECT_GT(far, 1000);
}

}  // namespace
}  // namespace ode_ext::test
