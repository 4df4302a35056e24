// SPDX-License-Identifier: BSD-3-Clause
// Scenes so small that Oclgrind, which interprets the kernels and watches every access, gets
// through them in a minute or two; together they reach every branch of every kernel:
//   oclgrind --build-options -cl-opt-disable --data-races --uninitialized ode_ext_tests ...
// with --gtest_filter='*Oclgrind*' (optimised kernels have shuffles with undefined lanes, at which
// --uninitialized of Oclgrind 21.10 crashes).
// Here their answers are looked at too.
#include <gtest/gtest.h>

#include "pipeline/collider.h"
#include "pipeline/deform_rig.h"
#include "pipeline/moving_scene.h"
#include "pipeline/test_scene.h"

namespace ode_ext::test {
namespace {

ColliderOptions small_options() {
  ColliderOptions options;
  options.work_group_size = 16;
  options.initial_capacity = 256;
  return options;
}

std::vector<std::uint32_t> counts(Collider& collider, const TestScene& scene) {
  std::vector<std::uint32_t> counts;
  for (const auto& range : collider.collide(scene.scene, nullptr).ranges)
    counts.push_back(range.count);
  return counts;
}

TEST(OclgrindPipeline, CollidesClosedMeshes) {
  TestScene scene;
  const std::uint32_t cube = scene.add_mesh(make_cube(1));
  const std::uint32_t sphere = scene.add_mesh(make_icosphere(0.6, 1));
  const std::uint32_t torus = scene.add_mesh(make_torus(0.5, 0.2, 8, 6));
  scene.add_pair(cube, turned({1, 2, 3}, 0.1, {0.2, 0.1, 0.9}), cube, at(0, 0, 0));
  scene.add_pair(sphere, at(0.1, 0.05, 0.9), cube, at(0, 0, 0));
  scene.add_pair(torus, turned({1, 0, 0}, 0.7), sphere, at(0.5, 0, 0.1));
  scene.add_pair(sphere, at(3, 3, 3), cube, at(0, 0, 0));  // apart
  Collider collider(small_options());
  const auto found = counts(collider, scene);
  EXPECT_GT(found[0], 0u);
  EXPECT_GT(found[1], 0u);
  EXPECT_GT(found[2], 1u);
  EXPECT_EQ(found[3], 0u);
}

TEST(OclgrindPipeline, RedoesWhatOverflows) {
  TestScene scene;
  const std::uint32_t sphere = scene.add_mesh(make_icosphere(0.6, 1));
  scene.add_pair(sphere, at(0.1, 0.05, 0.9), sphere, at(0, 0, 0));
  scene.add_pair(sphere, at(0.1, 0.8, 0.1), sphere, at(0, 0, 0));
  ColliderOptions tight = small_options();
  tight.initial_capacity = 1;
  Collider collider(tight), roomy(small_options());
  EXPECT_EQ(counts(collider, scene), counts(roomy, scene));
  EXPECT_GT(collider.report().redone, 0);
  EXPECT_EQ(roomy.report().redone, 0);
}

TEST(OclgrindPipeline, CollidesAnOpenMesh) {
  TestScene scene;
  const std::uint32_t sheet = scene.add_mesh(make_sheet(1.5, 4));
  const std::uint32_t sphere = scene.add_mesh(make_icosphere(0.6, 1));
  scene.add_pair(sphere, at(0.05, 0.02, 0.4), sheet, at(0, 0, 0));
  scene.add_pair(sheet, turned({0, 1, 0}, 0.3, {0, 0, 0.05}), sheet, at(0, 0, 0));
  Collider collider(small_options());
  EXPECT_GT(counts(collider, scene)[0], 0u);
}

// Rays through corners, along ridges, and into the valley of an L: they graze, and are decided by
// others; equal cubes touch and coincide.
TEST(OclgrindPipeline, DecidesGrazingRaysAndTouches) {
  TestScene scene;
  const std::uint32_t cube = scene.add_mesh(make_cube(1, 2));
  const std::uint32_t l = scene.add_mesh(make_l(1));
  const std::uint32_t small = scene.add_mesh(make_cube(0.5));
  scene.add_pair(cube, at(0, 0, 1), cube, at(0, 0, 0));
  scene.add_pair(cube, at(0, 0, 0), cube, at(0, 0, 0));
  scene.add_pair(small, at(0.25, 0.25, 0), l, at(0, 0, 0));
  scene.add_pair(small, at(0, 0, 0), cube, at(0, 0, 0));
  Collider collider(small_options());
  const auto found = counts(collider, scene);
  EXPECT_GT(found[0], 0u);
  EXPECT_GT(found[1], 0u);
  EXPECT_GT(found[3], 0u);
}

TEST(OclgrindPipeline, ReducesToOneContact) {
  TestScene scene;
  const std::uint32_t cube = scene.add_mesh(make_cube(1, 3));
  scene.add_pair(cube, turned({1, 1, 0}, 0.2, {0, 0, 0.9}), cube, at(0, 0, 0));
  ColliderOptions one = small_options();
  one.max_contacts = 1;
  Collider collider(one);
  EXPECT_EQ(counts(collider, scene)[0], 1u);
}

TEST(OclgrindPipeline, CountsExactlyAndInTiles) {
  TestScene scene;
  const std::uint32_t cube = scene.add_mesh(make_cube(1));
  scene.add_pair(cube, turned({1, 2, 3}, 0.1, {0.2, 0.1, 0.9}), cube, at(0, 0, 0));
  scene.add_pair(cube, turned({3, 2, 1}, 0.1, {0.2, 0.1, 0.9}), cube, at(0, 0, 0));
  ColliderOptions exact = small_options();
  exact.workload = Workload::kExact;
  exact.tile_vertices = 1;
  Collider collider(exact), plain(small_options());
  EXPECT_EQ(counts(collider, scene), counts(plain, scene));
}

// Iterative rays that are proven, handed on, and that walk off a border; in both organisations.
TEST(OclgrindPipeline, CastsIteratively) {
  const std::vector<TestMesh> meshes = {make_icosphere(0.6, 1), make_cube(1), make_sheet(1.5, 4)};
  for (const Organisation organisation : {Organisation::kPipelined, Organisation::kMonolithic}) {
    for (const Rays rays : {Rays::kIterative, Rays::kIterativePaper}) {
      ColliderOptions options = small_options();
      options.organisation = organisation;
      options.rays = rays;
      options.count_work = true;
      Collider collider(options);
      MovingScene moving(meshes, 3, 0.01, 1);
      PassMemory memory;
      std::uint64_t iterative = 0;
      for (int i = 0; i < 3; ++i, moving.advance()) {
        collider.collide(moving.scene(), &memory);
        iterative += collider.report().actual[static_cast<std::size_t>(Arrow::kRaysIterative)];
      }
      EXPECT_GT(iterative, 0u);
    }
  }
}

// A sheet that moves through a cube, as source and as target, by every algorithm.
TEST(OclgrindPipeline, CollidesASheet) {
  const auto base = deformable(soup_of(make_sheet(1.5, 4)), 0.05f);
  for (const DeformableTarget target : {DeformableTarget::kRefit, DeformableTarget::kBasic}) {
    for (const Organisation organisation : {Organisation::kPipelined, Organisation::kMonolithic}) {
      ColliderOptions options = small_options();
      options.deformable_target = target;
      options.organisation = organisation;
      Collider collider(options);
      PassMemory memory;
      Scene scene;
      scene.meshes = {std::make_shared<const Mesh>(build_mesh(soup_of(make_cube(1, 2)))), base};
      scene.objects = {{Pose{}, 0, 1}, {Pose{{0.01, 0.02, 0.3}}, 1, 2}};
      scene.pairs = {{0, 1}};
      for (const float phase : {0.0f, 0.1f}) {
        TriangleSoup soup;
        for (const std::uint32_t vertex : base->corner_vertex)
          soup.push_back(base->vertices[vertex]);
        scene.meshes[1] = deformed(base, bent(soup, phase));
        EXPECT_GT(collider.collide(scene, &memory).ranges[0].count, 0u);
      }
    }
  }
}

}  // namespace
}  // namespace ode_ext::test
