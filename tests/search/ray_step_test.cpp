// SPDX-License-Identifier: BSD-3-Clause
// The ray step against the brute-force reference, and through edges and corners.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "reference/reference_hits.h"
#include "search/oriented_box.h"
#include "support/rig.h"

namespace ode_ext::test {
namespace {

using Key = std::tuple<std::size_t, int, Point>;  // pair, side, vertex in its own frame

struct FoundHit {
  std::uint32_t kind;
  int triangle;  // as in the TestMesh
  double t, depth;
};

std::map<Key, FoundHit> found_hits(const TestScene& scene, const StepRecords& records) {
  std::map<Key, FoundHit> found;
  for (const ox_hit& hit : records.hits) {
    const std::size_t pair = hit.pair_side >> 1, side = hit.pair_side & 1;
    const std::uint32_t source = scene.objects[scene.pairs[pair][side]].mesh;
    const std::uint32_t target = scene.objects[scene.pairs[pair][1 - side]].mesh;
    const Mesh& mesh = *scene.scene.meshes[source];
    const Point vertex = point_of(mesh.vertices.at(Rig::shared().local_vertex(source, hit.vertex)));
    const std::uint32_t triangle = scene.scene.meshes[target]->topology->source_triangle.at(
        Rig::shared().local_triangle(target, hit.triangle));
    const FoundHit entry{hit.kind, static_cast<int>(triangle), static_cast<double>(hit.t),
                         static_cast<double>(hit.depth)};
    EXPECT_TRUE(found.insert({{pair, static_cast<int>(side), vertex}, entry}).second)
        << "two hits of one ray";
  }
  return found;
}

// Unit normal of a triangle, and the largest error of a point on it that is interpolated between
// its corners with weights that are ratios of rounded areas: 2^-22 of the longest side, times how
// much longer that is than the triangle is high. Slivers are what it is for.
struct Facet {
  Point normal;
  double blur;
};
Facet facet(const TestMesh& mesh, int triangle) {
  const auto t = static_cast<std::size_t>(triangle);
  const Point a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
  const Point normal = cross(b - a, c - a);
  const double side = std::max({distance(a, b), distance(b, c), distance(c, a)});
  return {unit(normal), 0x1p-22 * side * (side * side / length(normal))};
}

struct HitComparison {
  int rays = 0, hits = 0, ambiguous = 0;
};

bool is_inside(HitKind kind) { return kind == HitKind::Contact || kind == HitKind::Fallback; }

// Every ray of the reference that is not ambiguous has the hit it should have; rays start some
// epsilons before their vertices.
HitComparison compare_hits(const TestScene& scene, const StepRecords& records) {
  HitComparison comparison;
  const auto found = found_hits(scene, records);
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    if (gap_of_pair(scene, i) > 0) continue;
    const TestMesh &a = scene.mesh_of(i, 0), &b = scene.mesh_of(i, 1);
    const TestPose &pa = scene.pose_of(i, 0), &pb = scene.pose_of(i, 1);
    const double tolerance = comparison_tolerance(a, pa, b, pb);
    const double ahead = kInflation * static_cast<double>(records.pairs[i].epsilon);
    for (const ReferenceHit& expected : reference_rays(a, pa, b, pb)) {
      ++comparison.rays;
      if (expected.ambiguous) {
        ++comparison.ambiguous;
        continue;
      }
      const auto hit = found.find({i, expected.side, expected.vertex});
      const bool is_hit = hit != found.end();
      EXPECT_EQ(is_hit, is_inside(expected.kind))
          << "pair " << i << " side " << expected.side << " t " << expected.t;
      if (!is_hit || !is_inside(expected.kind)) continue;
      ++comparison.hits;
      const FoundHit& actual = hit->second;
      EXPECT_EQ(actual.kind, expected.kind == HitKind::Contact ? OX_HIT_INSIDE : OX_HIT_FALLBACK)
          << "pair " << i;
      const TestMesh& target = expected.side == 0 ? b : a;
      const Facet met = facet(target, actual.triangle), should = facet(target, expected.triangle);
      // A neighbour in the same plane will do.
      EXPECT_TRUE(actual.triangle == expected.triangle || dot(met.normal, should.normal) > 1 - 1e-6)
          << "pair " << i;
      const double slack = tolerance + met.blur;
      const double slope = expected.t > 0 ? expected.depth / expected.t : 1;
      EXPECT_NEAR(actual.depth, expected.depth + slope * ahead, slack) << "pair " << i;
      EXPECT_NEAR(actual.t, expected.t + ahead, slack / std::max(slope, 0.01)) << "pair " << i;
    }
  }
  return comparison;
}

TEST(RayStep, FindsTheHitsOfTheReference) {
  const TestScene scene = random_scene(1500, 21);
  const HitComparison comparison = compare_hits(scene, Rig::shared().run(scene.scene));
  EXPECT_GT(comparison.hits, 5000);
  EXPECT_LT(1000 * comparison.ambiguous, comparison.rays)
      << comparison.ambiguous << " of " << comparison.rays;
}

TEST(RayStep, FindsTheSameHitsWhateverTheNumberOfPairs) {
  for (const int count : {0, 1, 63, 64, 65, 1234}) {
    const TestScene scene = random_scene(count, 22);
    const StepRecords records = Rig::shared().run(scene.scene);
    EXPECT_EQ(records.ranges.size(), static_cast<std::size_t>(count));
    compare_hits(scene, records);
  }
}

TEST(RayStep, FindsTheSameHitsWithLargerMeshes) {
  TestScene scene;
  scene.add_mesh(jittered(make_icosphere(0.6, 3), 0.002, 1));
  scene.add_mesh(jittered(make_torus(0.5, 0.2, 32, 20), 0.002, 2));
  scene.add_mesh(jittered(make_cube(1, 8), 0.002, 3));
  Random random(23);
  for (std::uint32_t i = 0; i < 12; ++i) {
    const TestPose a = random.pose(0.3);
    scene.add_pair(i % 3, a, i / 3 % 3, random.pose(0.3));
  }
  const HitComparison comparison = compare_hits(scene, Rig::shared().run(scene.scene));
  EXPECT_GT(comparison.hits, 2000);
  EXPECT_LT(1000 * comparison.ambiguous, comparison.rays);
}

TEST(RayStep, FindsTheSameHitsAtEverySize) {
  for (const double scale : {1e-4, 1e-2, 1e2, 1e4}) {
    TestScene scene;
    const TestScene model = random_scene(60, 24);
    for (const TestMesh& mesh : model.meshes) scene.add_mesh(scaled(mesh, scale));
    for (std::size_t i = 0; i < model.pairs.size(); ++i) {
      TestPose a = model.pose_of(i, 0), b = model.pose_of(i, 1);
      a.position = scale * a.position;
      b.position = scale * b.position;
      scene.add_pair(model.objects[model.pairs[i][0]].mesh, a,
                     model.objects[model.pairs[i][1]].mesh, b);
    }
    EXPECT_GT(compare_hits(scene, Rig::shared().run(scene.scene)).hits, 200) << scale;
  }
}

TEST(RayStep, TellsFrontFacesFromBackFaces) {
  // A flat tetrahedron over, in and under a cube, and in the cube's inside-out twin.
  const TestMesh tetrahedron = make_tetrahedron(0.2);
  for (const TestMesh& cube : {make_cube(1), inverted(make_cube(1))}) {
    for (const double height : {-0.8, -0.3, 0.0, 0.3, 0.8}) {
      const TestScene scene = one_pair(tetrahedron, at(0.1, 0.2, height), cube, at(0, 0, 0));
      const std::size_t from_tetrahedron = std::fabs(height) < 0.5 ? 4 : 0;
      const StepRecords records = Rig::shared().run(scene.scene);
      EXPECT_EQ(records.hits.size(), from_tetrahedron) << height;
    }
  }
}

TEST(RayStep, MeetsAnOpenSheetFromItsBackOnly) {
  const TestMesh cube = make_cube(0.5, 2);
  // Facing up: what hangs down through the sheet's front is inside; turned over it is not.
  for (const bool turned_over : {false, true}) {
    const TestPose pose =
        turned_over ? turned({1, 0, 0}, 3.14159265358979, {0.03, 0.04, 0}) : at(0.03, 0.04, 0);
    const TestScene scene = one_pair(cube, at(0, 0, 0.2), make_sheet(2, 1), pose);
    const StepRecords records = Rig::shared().run(scene.scene);
    ASSERT_FALSE(records.hits.empty());
    for (const ox_hit& hit : records.hits) {
      EXPECT_EQ(hit.kind, OX_HIT_INSIDE);
      const float z =
          scene.built_mesh_of(0, 0).vertices[Rig::shared().local_vertex(0, hit.vertex)].z;
      // Under the sheet (z = -0.25 in the cube), or over it if the sheet faces down.
      EXPECT_EQ(z > -0.2f, turned_over);
    }
  }
}

}  // namespace
}  // namespace ode_ext::test
