// SPDX-License-Identifier: BSD-3-Clause
// Scenes so small that Oclgrind, which interprets the kernels and watches every access, gets
// through them in a minute or two; together they reach every branch of every kernel:
//   oclgrind --build-options -cl-opt-disable --data-races --uninitialized ode_ext_tests ...
// with --gtest_filter='*Oclgrind*' (optimised kernels have shuffles with undefined lanes, at which
// --uninitialized of Oclgrind 21.10 crashes).
// Here their answers are looked at too.
#include <gtest/gtest.h>

#include <cstdlib>

#include "collide/collider.h"
#include "support/deform_rig.h"
#include "support/moving_scene.h"
#include "support/test_scene.h"

namespace ode_ext::test {
namespace {

ColliderOptions small_options() {
  ColliderOptions options;
  // It interprets idle items too. Elsewhere each size is all kernels compiled anew.
  if (std::getenv("ODE_EXT_TEST_UNDER_OCLGRIND") != nullptr) options.work_group_size = 16;
  options.initial_capacity = 256;
  options.whole_steps = false;  // every kernel by itself
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

TEST(OclgrindPipeline, CollidesClosedMeshesByPlanes) {
  TestScene scene;
  const std::uint32_t cube = scene.add_mesh(make_cube(1));
  const std::uint32_t torus = scene.add_mesh(make_torus(0.5, 0.2, 8, 6));
  scene.add_pair(cube, turned({1, 2, 3}, 0.1, {0.2, 0.1, 0.9}), cube, at(0, 0, 0));
  scene.add_pair(torus, turned({1, 0, 0}, 0.7), cube, at(0.5, 0, 0.6));
  scene.add_pair(cube, at(3, 3, 3), cube, at(0, 0, 0));  // apart
  Collider collider(small_options());
  const auto found = counts(collider, scene);
  EXPECT_GT(found[0], 0u);
  EXPECT_GT(found[1], 1u);
  EXPECT_EQ(found[2], 0u);
}

// One vertex is out: the flood's table grows with edges in it (kernels/lib/flood_table.h).
TEST(OclgrindPipeline, FloodsMoreThanItsFirstTableHolds) {
  TestScene scene;
  const std::uint32_t ball = scene.add_mesh(make_icosphere(0.5, 2));
  const std::uint32_t box = scene.add_mesh(make_cube(1.1));
  scene.add_pair(ball, turned({1, 2, 3}, 0.3, {0, 0, 0.055}), box, at(0, 0, 0));
  Collider collider(small_options());
  EXPECT_GT(counts(collider, scene)[0], 0u);
  EXPECT_GT(collider.report().actual[static_cast<std::size_t>(List::kHits)], 128u);
}

// Oclgrind's own device has no vectors.
TEST(OclgrindPipeline, CollidesTheSameByVectorsAndByItems) {
  TestScene scene;
  const std::uint32_t sphere = scene.add_mesh(make_icosphere(0.6, 1));
  scene.add_pair(sphere, at(0.1, 0.05, 0.9), sphere, at(0, 0, 0));
  const auto contacts = [&](std::uint32_t width, Lanes lanes) {
    ColliderOptions options = small_options();
    options.vector_width = width;
    options.lanes = lanes;
    Collider collider(options);
    return bits_of(collider.collide(scene.scene, nullptr));
  };
  const auto expected = contacts(1, Lanes::kVectors);
  EXPECT_FALSE(expected[0].empty());
  EXPECT_EQ(contacts(8, Lanes::kVectors), expected);
  EXPECT_EQ(contacts(1, Lanes::kItems), expected);
}

TEST(OclgrindPipeline, CollidesTheSameInOneLaunch) {
  TestScene scene;
  const std::uint32_t sphere = scene.add_mesh(make_icosphere(0.6, 1));
  const std::uint32_t sheet = scene.add_mesh(make_sheet(1, 2));
  scene.add_pair(sphere, at(0.1, 0.05, 0.9), sphere, at(0, 0, 0));
  scene.add_pair(sphere, at(0.1, 0.05, 0.5), sheet, at(0, 0, 0));
  Collider stepwise(small_options());
  const auto expected = bits_of(stepwise.collide(scene.scene, nullptr));
  EXPECT_FALSE(expected[0].empty());
  ColliderOptions options = small_options();
  options.whole_steps = true;
  Collider collider(options);
  EXPECT_EQ(bits_of(collider.collide(scene.scene, nullptr)), expected);
  EXPECT_EQ(collider.report().ms[static_cast<std::size_t>(Stage::kWholeStep)] > 0,
            (collider.device_info().type & CL_DEVICE_TYPE_CPU) != 0);
}

TEST(OclgrindPipeline, RedoesWhatOverflows) {
  TestScene scene;
  const std::uint32_t sphere = scene.add_mesh(make_icosphere(0.6, 0));
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

// Edges against edges, and whatever else crossings lead to (contacts/choose.cl): regions with and
// without a vertex inside, in closed and open targets, several in a pair, thin parts deep in
// the target, all of a mesh inside, and surfaces that touch.
TEST(OclgrindPipeline, FindsContactsOfEdges) {
  const double right = 1.5707963267948966;
  TestScene scene;
  const std::uint32_t rod = scene.add_mesh(make_rod(2, 0.2));
  const std::uint32_t cube = scene.add_mesh(make_cube(1));
  const std::uint32_t small = scene.add_mesh(make_cube(0.2));
  const std::uint32_t plate = scene.add_mesh(make_box({0.8, 0.05, 0.8}));
  const std::uint32_t sheet = scene.add_mesh(make_sheet(1.5, 2));
  const std::uint32_t triangle = scene.add_mesh(make_triangle(1));
  const std::uint32_t rods = scene.add_mesh(
      merged(moved(make_rod(1, 0.2), {0, 0.5, 0}), moved(make_rod(1, 0.2), {0, -0.5, 0})));
  const std::uint32_t comb = scene.add_mesh(make_comb(2, 0.2, 0.3, 0.2));
  const TestPose on_edge = turned({1, 0, 0}, right / 2);
  const TestPose across = composed(turned({0, 0, 1}, 1.2, {0.02, 0.01, 0.27}), on_edge);
  const TestPose upright = turned({0, 1, 0}, right, {0.05, 0.04, 0.1});
  const std::size_t apart = 3;
  scene.add_pair(rod, across, rod, on_edge);                      // edges pass
  scene.add_pair(rod, upright, cube, at(0, 0, 0));                // runs right through
  scene.add_pair(rod, turned({0, 0, 1}, 1.1), rod, at(0, 0, 0));  // and so do both
  scene.add_pair(rod, at(0, 0, 0.3), rod, at(0, 0, 0));           // apart
  scene.add_pair(cube, turned({1, 2, 0}, 1e-3, {0.3, 0.2, 0.995}), cube, at(0, 0, 0));
  scene.add_pair(cube, turned({1, 2, 0}, 1e-7, {0.3, 0.2, 1}), cube, at(0, 0, 0));
  scene.add_pair(small, turned({1, 2, 3}, 0.2, {0.2, 0.1, 0}), cube, at(0, 0, 0));  // inside
  scene.add_pair(cube, at(0, 0, 0), small, at(0.2, 0.1, 0));
  scene.add_pair(cube, at(0, 0, 0), cube, at(1e-8, 0, 0));
  scene.add_pair(plate, at(0.03, 0.02, 0.6), cube, at(0, 0, 0));  // deep
  scene.add_pair(cube, at(0, 0, 0), plate, turned({0, 0, 1}, 0.3, {0.03, 0.02, 0.6}));
  scene.add_pair(rods, at(0, 0, 0.19), rod, turned({0, 0, 1}, right));  // two regions
  scene.add_pair(comb, turned({1, 0, 0}, 2 * right, {0, 0, 0.6}), cube, at(0, 0, 0));
  scene.add_pair(rod, upright, sheet, at(0, 0, 0));  // open targets
  scene.add_pair(sheet, at(0, 0, 0), cube, at(0, 0, 0.1));
  scene.add_pair(triangle, turned({1, 1, 0}, 0.9), sheet, at(0, 0, 0));
  scene.add_pair(sheet, at(0, 0, 0.01), sheet, at(0, 0, 0));  // near, but apart
  scene.add_pair(sheet, at(0.2, 0, 0), sheet, at(0, 0, 0));   // on it
  for (const Organization organization : {Organization::kPipelined, Organization::kMonolithic}) {
    ColliderOptions options = small_options();
    options.organization = organization;
    Collider collider(options);
    const auto found = counts(collider, scene);
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (i >= 16) continue;  // of open surfaces that do not cross neither has an inside
      EXPECT_EQ(found[i] > 0, i != apart) << i;
    }
  }
}

// What crosses a deformable sheet: edges of a solid, edges of the sheet, another sheet.
TEST(OclgrindPipeline, FindsContactsOfEdgesOfSheets) {
  const auto base = deformable(soup_of(make_sheet(1.5, 3)), 0.05f);
  TriangleSoup soup;
  for (const std::uint32_t vertex : base->topology->corner_vertex)
    soup.push_back(base->vertices[vertex]);
  Scene scene;
  scene.meshes = {std::make_shared<const Mesh>(build_mesh(soup_of(make_rod(2, 0.1)))),
                  deformed(base, bent(soup)), deformed(base, bent(soup, 1))};
  const TestPose upright = turned({0, 1, 0}, 1.5, {0.05, 0.04, 0.1});
  scene.objects = {{collider_pose(upright), 0},
                   {Pose{}, 1},
                   {collider_pose(turned({1, 0, 0}, 1.2, {0.03, 0, 0})), 2}};
  scene.pairs = {{0, 1}, {1, 2}, {2, 0}};
  Collider collider(small_options());
  const PairContacts& found = collider.collide(scene, nullptr);
  EXPECT_GT(found.ranges[0].count, 0u);
  EXPECT_GT(found.ranges[1].count, 0u);
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
  exact.launches = LaunchRule::kExact;
  exact.tile_vertices = 1;
  Collider collider(exact), plain(small_options());
  EXPECT_EQ(counts(collider, scene), counts(plain, scene));
}

// Iterative rays that are believed, handed on, and that walk off a border; in both organizations.
TEST(OclgrindPipeline, CastsIteratively) {
  const std::vector<TestMesh> meshes = {make_icosphere(0.6, 0), make_cube(1), make_sheet(1.5, 4)};
  for (const Organization organization : {Organization::kPipelined, Organization::kMonolithic}) {
    for (const Rays rays : {Rays::kIterative, Rays::kIterativePaper}) {
      ColliderOptions options = small_options();
      options.organization = organization;
      options.rays = rays;
      options.count_work = true;
      Collider collider(options);
      MovingScene moving(meshes, 3, 0.01, 1);
      PassMemory memory;
      std::uint64_t iterative = 0;
      for (int i = 0; i < 2; ++i, moving.advance()) {
        collider.collide(moving.scene(), &memory);
        iterative += collider.report().actual[static_cast<std::size_t>(List::kRaysIterative)];
      }
      EXPECT_GT(iterative, 0u);
    }
  }
}

// A sheet that moves through a cube, as source and as target, by every algorithm.
TEST(OclgrindPipeline, CollidesASheet) {
  const auto base = deformable(soup_of(make_sheet(1.5, 4)), 0.05f);
  for (const DeformableTarget target : {DeformableTarget::kRefit, DeformableTarget::kBasic}) {
    for (const Organization organization : {Organization::kPipelined, Organization::kMonolithic}) {
      ColliderOptions options = small_options();
      options.deformable_target = target;
      options.organization = organization;
      Collider collider(options);
      PassMemory memory;
      Scene scene;
      scene.meshes = {std::make_shared<const Mesh>(build_mesh(soup_of(make_cube(1, 2)))), base};
      scene.objects = {{Pose{}, 0, 1}, {Pose{{0.01, 0.02, 0.3}}, 1, 2}};
      scene.pairs = {{0, 1}};
      for (const float phase : {0.0f, 0.1f}) {
        TriangleSoup soup;
        for (const std::uint32_t vertex : base->topology->corner_vertex)
          soup.push_back(base->vertices[vertex]);
        scene.meshes[1] = deformed(base, bent(soup, phase));
        EXPECT_GT(collider.collide(scene, &memory).ranges[0].count, 0u);
      }
    }
  }
}

}  // namespace
}  // namespace ode_ext::test
