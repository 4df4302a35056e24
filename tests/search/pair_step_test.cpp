// SPDX-License-Identifier: BSD-3-Clause
// The pair step against plain double-precision geometry.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "search/oriented_box.h"
#include "support/fcl_oracle.h"
#include "support/rig.h"
#include "support/segment_crosses.h"

namespace ode_ext::test {
namespace {

// Single pairs, so that what became of each is known.
TestScene single(const TestScene& scene, std::size_t pair) {
  TestScene result;
  result.meshes = scene.meshes;
  result.scene.meshes = scene.scene.meshes;
  result.add_pair(scene.objects[scene.pairs[pair][0]].mesh, scene.pose_of(pair, 0),
                  scene.objects[scene.pairs[pair][1]].mesh, scene.pose_of(pair, 1));
  return result;
}

TestScene spread_scene(int count, std::uint64_t seed) {
  TestScene scene;
  for (const TestMesh& mesh : small_meshes()) scene.add_mesh(mesh);
  Random random(seed);
  for (int i = 0; i < count; ++i) {
    const auto mesh_a = static_cast<std::uint32_t>(random.below(kSmallMeshCount));
    const auto mesh_b = static_cast<std::uint32_t>(random.below(kSmallMeshCount));
    const TestPose a = random.pose(1.0);
    scene.add_pair(mesh_a, a, mesh_b, random.pose(1.0));
  }
  return scene;
}

TEST(PairStep, RelatesTheFramesToWithinItsEpsilon) {
  for (const double far : {0.0, 1e3, 1e6}) {
    TestScene scene = spread_scene(200, 1);
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
      const Point place{far, -0.7 * far, 0.3 * far};
      scene.objects[i].pose.position = scene.objects[i].pose.position + place;
      scene.scene.objects[i].pose = collider_pose(scene.objects[i].pose);
    }
    const StepRecords records = Rig::shared().run_pair_step(scene.scene);
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      const ox_pair& pair = records.pairs[i];
      const TestPose &a = scene.pose_of(i, 0), &b = scene.pose_of(i, 1);
      const Point offset = a.position - b.position;
      // Half of epsilon is left to the coordinates that are added.
      const double tolerance = 0.5 * static_cast<double>(pair.epsilon);
      EXPECT_LT(distance(point_of(pair.offset[0]), rotate_back(b, offset)), tolerance);
      EXPECT_LT(distance(point_of(pair.offset[1]), rotate_back(a, -1 * offset)), tolerance);
      for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t column = 0; column < 3; ++column) {
          double exact = 0;
          for (std::size_t k = 0; k < 3; ++k)
            exact += b.rotation[3 * k + row] * a.rotation[3 * k + column];
          // Two rounded factors, a product and two sums of numbers below 1: five roundings of
          // 2^-24, of which the sums apply to at most three terms that together stay below
          // sqrt(3).
          EXPECT_NEAR(pair.rotation[0][3 * row + column], exact, 9 * 0x1p-24);
          EXPECT_EQ(pair.rotation[1][3 * column + row], pair.rotation[0][3 * row + column]);
        }
      }
      EXPECT_EQ(pair.mesh[0], scene.objects[2 * i].mesh);
      EXPECT_EQ(pair.mesh[1], scene.objects[2 * i + 1].mesh);
    }
  }
}

// A point of one side in the other's frame, as a record takes it from base to base.
Point from_bases(const ox_pair& pair, std::size_t side, const Point& p) {
  const Point q = p - point_of(pair.base[side]);
  const ox_f32* r = pair.rotation[side];
  Point sum = point_of(pair.base_offset[side]) + point_of(pair.base[1 - side]);
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t k = 0; k < 3; ++k) sum[row] += double{r[3 * row + k]} * q[k];
  return sum;
}

TEST(PairStep, MeasuresFromWhereASmallMeshIsInALargeOne) {
  Random random(4);
  for (const double far : {1e3, 1e5}) {
    const Point place{far, -far, 0.1 * far};
    TestScene scene;
    const std::uint32_t small = scene.add_mesh(make_icosphere(0.5, 1));
    const std::uint32_t large = scene.add_mesh(far_out(make_waves(8, 16), place));
    for (int i = 0; i < 100; ++i) {
      TestPose a = random.pose(0.3), b = random.pose(1);
      const Point world{1e4, 2e4, -3e4};
      a.position = a.position + world;
      b.position = b.position + world - rotate(b, place);
      if (i % 2 == 0)
        scene.add_pair(small, a, large, b);
      else
        scene.add_pair(large, b, small, a);
    }
    const StepRecords records = Rig::shared().run_pair_step(scene.scene);
    int near = 0;
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      const ox_pair& pair = records.pairs[i];
      if (pair.near == 0) continue;
      ++near;
      EXPECT_LT(double{pair.epsilon}, 0x1p-20 * 8);  // a few meters
      EXPECT_GT(double{pair.margin}, 0x1p-20 * far);
      const std::size_t side = i % 2;  // the small one's
      const TestPose &of_small = scene.pose_of(i, side), &of_large = scene.pose_of(i, 1 - side);
      for (int k = 0; k < 10; ++k) {
        const Point p{random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5),
                      random.uniform(-0.5, 0.5)};
        const Point there =
            rotate_back(of_large, rotate(of_small, p) + (of_small.position - of_large.position));
        // Half of epsilon is left to the coordinates that are added. (And doubles so far out hold
        // the positions themselves to 2^-37.)
        EXPECT_LT(distance(from_bases(pair, side, p), there), 0.5 * double{pair.epsilon});
        EXPECT_LT(distance(from_bases(pair, 1 - side, there), p), 0.5 * double{pair.epsilon});
      }
    }
    EXPECT_GT(near, 50);
  }
}

TEST(PairStep, MeasuresMeshesOfOneSizeFromTheirOrigins) {
  const TestScene scene = spread_scene(100, 5);
  const StepRecords records = Rig::shared().run_pair_step(scene.scene);
  for (const ox_pair& pair : records.pairs)
    for (std::size_t side = 0; side < 2 && pair.near != 0; ++side)
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(pair.base[side][k], 0);
        EXPECT_EQ(pair.base_offset[side][k], pair.offset[side][k]);
      }
}

TEST(PairStep, DropsExactlyThePairsWhoseBoxesAreApart) {
  const TestScene scene = spread_scene(600, 2);
  int apart = 0, overlapping = 0, undecided = 0;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const StepRecords records = Rig::shared().run_pair_step(single(scene, i).scene);
    const double gap = gap_of_pair(scene, i);
    const double margin = static_cast<double>(records.pairs[0].margin);
    if (gap > 2 * margin) {
      ++apart;
      EXPECT_EQ(records.bounded, 0u) << "pair " << i << ", gap " << gap;
      EXPECT_TRUE(records.tasks.empty());
    } else if (gap < 0) {
      ++overlapping;
      EXPECT_EQ(records.bounded, 1u) << "pair " << i << ", gap " << gap;
    } else {
      ++undecided;
    }
  }
  EXPECT_GT(apart, 100);
  EXPECT_GT(overlapping, 100);
  EXPECT_LT(undecided, 6);
}

TEST(PairStep, KeepsBoxesThatTouchWhereverTheyAre) {
  Random random(3);
  const TestMesh cube = make_cube(1);
  for (int i = 0; i < 100; ++i) {
    const TestPose frame = random.pose(1e4);
    // Face to face, edge to edge, corner to corner.
    const Point offset{1, i % 3 > 0 ? 1.0 : 0.25, i % 3 > 1 ? 1.0 : 0.25};
    const TestScene scene =
        one_pair(cube, composed(frame, at(offset[0], offset[1], offset[2])), cube, frame);
    EXPECT_EQ(Rig::shared().run_pair_step(scene.scene).bounded, 1u);
  }
}

// What must be tasks, and what may be.
using Task =
    std::tuple<std::size_t, std::uint32_t, std::uint32_t>;  // pair, side, chunk of the mesh

struct Tasks {
  std::set<Task> certain, possible;
};

// Whether a vertex of the chunk is inside the closed target.
bool has_vertex_inside(const TestScene& scene, std::size_t pair, std::size_t side,
                       const VertexChunk& chunk) {
  const TestPose &ps = scene.pose_of(pair, side), &pt = scene.pose_of(pair, 1 - side);
  for (std::uint32_t v = chunk.first; v < chunk.first + chunk.count; ++v) {
    const Point p = point_of(scene.built_mesh_of(pair, side).vertices[v]);
    const Point in_target = rotate_back(pt, rotate(ps, p) + (ps.position - pt.position));
    if (std::fabs(winding_number(scene.mesh_of(pair, 1 - side), in_target)) > 0.5) return true;
  }
  return false;
}

// Whether the ray of a vertex of the chunk meets the open target within its exit.
bool has_ray_that_meets(const TestScene& scene, std::size_t pair, std::size_t side,
                        const VertexChunk& chunk) {
  const Mesh& source = scene.built_mesh_of(pair, side);
  const Mesh& target = scene.built_mesh_of(pair, 1 - side);
  const TestPose &ps = scene.pose_of(pair, side), &pt = scene.pose_of(pair, 1 - side);
  const auto in_target = [&](Vec3d p) {
    const Point q = rotate_back(pt, rotate(ps, {p.x, p.y, p.z}) + (ps.position - pt.position));
    return Vec3d{q[0], q[1], q[2]};
  };
  for (std::uint32_t v = chunk.first; v < chunk.first + chunk.count; ++v) {
    if (!std::isfinite(source.exits[v])) continue;
    const Vec3d from(source.vertices[v]);
    const Vec3d to = from - double{source.exits[v]} * Vec3d(source.normals[v]);
    const Segment ray{in_target(from), in_target(to)};
    for (const Triangle& t : target.topology->triangles)
      if (crosses(ray, {Vec3d(target.vertices[t[0]]), Vec3d(target.vertices[t[1]]),
                        Vec3d(target.vertices[t[2]])}))
        return true;
  }
  return false;
}

double longest_exit(const Mesh& mesh, const VertexChunk& chunk) {
  double longest = 0;
  for (std::uint32_t v = chunk.first; v < chunk.first + chunk.count; ++v)
    if (std::isfinite(mesh.exits[v])) longest = std::max(longest, double{mesh.exits[v]});
  return longest;
}

Tasks tasks_of(const TestScene& scene, const std::vector<ox_pair>& pairs) {
  Tasks tasks;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const double margin = static_cast<double>(pairs[i].margin);
    const double gap = gap_of_pair(scene, i);
    for (std::uint32_t side = 0; side < 2; ++side) {
      const Mesh& source = scene.built_mesh_of(i, side);
      const Mesh& target = scene.built_mesh_of(i, 1 - side);
      const TestPose &ps = scene.pose_of(i, side), &pt = scene.pose_of(i, 1 - side);
      const OrientedBox whole = oriented_box(target.box, pt, pt.position);
      for (std::uint32_t k = 0; k < source.topology->chunks.size(); ++k) {
        const VertexChunk& chunk = source.topology->chunks[k];
        const OrientedBox box = oriented_box(chunk.box, ps, pt.position);
        double apart = -INFINITY;  // along the axes of the target only
        for (const Point& axis : whole.axes) apart = std::max(apart, gap_along(box, whole, axis));
        if (!target.closed()) apart -= longest_exit(source, chunk);  // its rays reach beyond it
        if (gap < 2 * margin && apart < 2 * margin) tasks.possible.insert({i, side, k});
        if (gap < 0 && apart < 0 &&
            (target.closed() ? has_vertex_inside(scene, i, side, chunk)
                             : has_ray_that_meets(scene, i, side, chunk)))
          tasks.certain.insert({i, side, k});
      }
    }
  }
  return tasks;
}

TEST(PairStep, MakesTasksOfAllChunksThatMayBeInsideAndReachTheTarget) {
  TestScene scene = spread_scene(300, 4);
  // Meshes of many chunks: 642 and 600 vertices.
  const std::uint32_t sphere = scene.add_mesh(make_icosphere(0.6, 3));
  const std::uint32_t torus = scene.add_mesh(make_torus(0.5, 0.2, 30, 20));
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    const TestPose a = random.pose(0.6);
    scene.add_pair(i % 2 == 0 ? sphere : torus, a, i % 3 == 0 ? sphere : 8, random.pose(0.6));
  }
  const StepRecords records = Rig::shared().run_pair_step(scene.scene);
  const Tasks expected = tasks_of(scene, records.pairs);
  std::set<Task> tasks;
  std::vector<std::uint32_t> chunk_first{0};
  for (const auto& mesh : scene.scene.meshes)
    chunk_first.push_back(chunk_first.back() +
                          static_cast<std::uint32_t>(mesh->topology->chunks.size()));
  for (const ox_chunk_task& task : records.tasks) {
    const std::size_t pair = task.pair_side >> 1;
    const std::uint32_t side = task.pair_side & 1;
    ASSERT_LT(pair, scene.pairs.size());
    const std::uint32_t mesh = scene.objects[scene.pairs[pair][side]].mesh;
    ASSERT_GE(task.chunk, chunk_first[mesh]);
    ASSERT_LT(task.chunk, chunk_first[mesh + 1]);
    EXPECT_TRUE(tasks.insert({pair, side, task.chunk - chunk_first[mesh]}).second) << "twice";
  }
  EXPECT_TRUE(
      std::includes(tasks.begin(), tasks.end(), expected.certain.begin(), expected.certain.end()));
  EXPECT_TRUE(std::includes(expected.possible.begin(), expected.possible.end(), tasks.begin(),
                            tasks.end()));
  EXPECT_GT(expected.certain.size(), 300u);
}

TEST(PairStep, ClearsTheCountsOfEveryPair) {
  const TestScene scene = spread_scene(300, 6);
  Rig::shared().run(scene.scene);
  const StepRecords records = Rig::shared().run_pair_step(scene.scene);
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    EXPECT_EQ(records.found[i].features, 0u);
    EXPECT_EQ(records.found[i].placed, 0u);
    EXPECT_EQ(records.found[i].candidates, 0u);
    for (const ox_u32 head : records.found[i].head) EXPECT_EQ(head, OX_NONE);
    EXPECT_EQ(records.ranges[i].count, 0u);
  }
}

}  // namespace
}  // namespace ode_ext::test
