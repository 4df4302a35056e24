// SPDX-License-Identifier: BSD-3-Clause
// What the grids of a mesh dismiss may change how much work is done, and nothing else.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pipeline/collider.h"
#include "pipeline/rig.h"
#include "pipeline/test_scene.h"

namespace ode_ext::test {
namespace {

// Hills of large triangles, the top of a closed slab or a sheet alone.
TestMesh hills(bool closed) {
  TestMesh mesh = closed ? make_box({8, 8, 1}, 16, 16, 1) : make_sheet(8, 16);
  const float top = closed ? 0.5f : 0;
  for (std::size_t i = 0; i + 2 < mesh.vertices.size(); i += 3)
    if (mesh.vertices[i + 2] == top)
      mesh.vertices[i + 2] +=
          0.2f * std::sin(1.5f * mesh.vertices[i]) * std::cos(mesh.vertices[i + 1]);
  return mesh;
}

// Fine bodies, open and closed, on hills and on one another, most of them at the surface.
TestScene scene_of(std::uint64_t seed) {
  TestScene scene;
  scene.add_mesh(hills(true));
  scene.add_mesh(hills(false));
  scene.add_mesh(jittered(make_icosphere(0.4, 3), 0.002, 1));
  scene.add_mesh(jittered(make_torus(0.4, 0.12, 24, 12), 0.002, 2));
  scene.add_mesh(make_plate(0.7, 0.02, 8));
  scene.add_mesh(make_sheet(0.8, 10));
  scene.add_mesh(make_cube(0.5));
  Random random(seed);
  for (int i = 0; i < 240; ++i) {
    TestPose body = random.pose(0.5);
    const auto kind = 2 + static_cast<std::uint32_t>(random.below(5));
    const auto other = static_cast<std::uint32_t>(random.below(7));
    if (other < 2) {  // over or in the ground
      body.position = {random.uniform(-3.5, 3.5), random.uniform(-3.5, 3.5),
                       (other == 0 ? 0.5 : 0) + random.uniform(-0.4, 0.7)};
      scene.add_pair(kind, body, other, TestPose{});
    } else {
      scene.add_pair(kind, body, other, random.pose(0.5));
    }
  }
  return scene;
}

// The same without grids.
Scene stripped(const TestScene& scene) {
  Scene result = scene.scene;
  for (std::shared_ptr<const Mesh>& mesh : result.meshes) {
    Mesh without = *mesh;
    without.grid = {};
    without.clearance = {};
    without.slabs = {};
    mesh = std::make_shared<const Mesh>(std::move(without));
  }
  return result;
}

std::vector<ContactBits> collide(const Scene& scene, const ColliderOptions& options,
                                 StepReport& report) {
  Collider collider(options);
  std::vector<ContactBits> bits;
  for (const Contact& contact : collider.collide(scene, nullptr).contacts)
    bits.push_back(bits_of(contact));
  report = collider.report();
  return bits;
}

std::uint64_t count_of(const StepReport& report, Arrow arrow) {
  return report.actual[static_cast<std::size_t>(arrow)];
}

TEST(Cull, ChangesNoContact) {
  for (const Organisation organisation : {Organisation::kPipelined, Organisation::kMonolithic})
    for (const std::uint64_t seed : {71u, 72u}) {
      const TestScene scene = scene_of(seed);
      ColliderOptions options;
      options.organisation = organisation;
      StepReport with, without;
      const auto contacts = collide(scene.scene, options, with);
      EXPECT_EQ(contacts, collide(stripped(scene), options, without));
      EXPECT_GT(contacts.size(), 500u);
      EXPECT_EQ(count_of(with, Arrow::kHits), count_of(without, Arrow::kHits));
      EXPECT_EQ(count_of(with, Arrow::kCrossings), count_of(without, Arrow::kCrossings));
    }
}

// Pairs round to more than the grids' margin, a share of the target's own size, where meshes lie
// far from their own origin, or the source is much larger.
TEST(Cull, ChangesNoContactWhereRoundingIsCoarse) {
  for (const double offset : {0.0, 1e2, 1e4}) {
    const double scale = offset == 0 ? 1000 : 1;
    const Point far{offset, 0, 0};
    TestScene scene;
    for (const TestMesh& mesh : {jittered(make_icosphere(0.6, 2), 0.01, 1),
                                 jittered(make_torus(0.5, 0.2, 16, 10), 0.01, 2), make_l(1)})
      scene.add_mesh(moved(mesh, far));
    scene.add_mesh(scaled(make_cube(1, 4), scale));
    Random random(74);
    for (int i = 0; i < 150; ++i) {
      TestPose a = random.pose(0.4);
      if (scale != 1) a.position[2] += 0.5 * scale;
      a.position = a.position - rotate(a, far);
      scene.add_pair(static_cast<std::uint32_t>(random.below(3)), a, 3, TestPose{});
    }
    StepReport with, without;
    const auto contacts = collide(scene.scene, {}, with);
    EXPECT_EQ(contacts, collide(stripped(scene), {}, without)) << offset;
    EXPECT_EQ(count_of(with, Arrow::kHits), count_of(without, Arrow::kHits)) << offset;
    EXPECT_GT(contacts.size(), 100u) << offset;
  }
}

// Spheres whose vertices were thrown about: they cut themselves, some turn inside out in places.
// `closed`: or lack a triangle.
TestScene crumpled_scene(bool closed) {
  TestScene scene;
  Random random(75);
  const std::uint32_t ball = scene.add_mesh(make_icosphere(0.3, 2));
  for (int i = 0; i < 40; ++i) {
    TestMesh crumpled = jittered(make_icosphere(0.8, 2), random.uniform(0.05, 0.5), random.next());
    if (!closed) crumpled.indices.resize(crumpled.indices.size() - 3);
    scene.add_pair(scene.add_mesh(crumpled), TestPose{}, ball, random.pose(0.7));
  }
  return scene;
}

// A mesh that changes in every pass is built without what pays in later passes only.
Scene built_in_haste(const TestScene& scene) {
  Scene result = scene.scene;
  for (std::size_t i = 0; i < result.meshes.size(); ++i)
    result.meshes[i] = std::make_shared<const Mesh>(
        build_mesh(soup_of(scene.meshes[i]), {.grids = false, .isolation = false}));
  return result;
}

TEST(Cull, ChangesNoContactOfMeshesThatCutThemselvesWhenBuiltInHaste) {
  for (const bool closed : {true, false}) {
    const TestScene scene = crumpled_scene(closed);
    StepReport with, without;
    const auto contacts = collide(scene.scene, {}, with);
    EXPECT_EQ(contacts, collide(built_in_haste(scene), {}, without)) << closed;
    EXPECT_GT(contacts.size(), 200u) << closed;
  }
}

TEST(Cull, IsLeftOutOfMeshesBuiltInHasteThatDoNotCutThemselves) {
  for (const TestMesh& mesh : {make_icosphere(0.8, 2), make_torus(0.5, 0.2, 16, 10), make_l(1),
                               make_sheet(1, 8), make_cube(1, 4)}) {
    const Mesh built = build_mesh(soup_of(mesh), {.grids = false, .isolation = false});
    EXPECT_TRUE(built.grid.surface.empty());
    EXPECT_TRUE(built.clearance.steps.empty());
  }
}

// In a valley, within the box of the hills and 12 cm above them: two cells.
TEST(Cull, LeavesNoRayToABodyJustAboveHills) {
  for (const bool closed : {true, false}) {
    const TestScene scene =
        one_pair(jittered(make_icosphere(0.1, 3), 0.001, 1),
                 at(-std::numbers::pi / 3, 0, (closed ? 0.5 : 0) - 0.2 + 0.12 + 0.1), hills(closed),
                 TestPose{});
    StepReport with, without;
    ColliderOptions options;
    options.rays = Rays::kIterative;  // looks at every vertex
    collide(scene.scene, options, with);
    collide(stripped(scene), options, without);
    EXPECT_EQ(with.pairs_bounded, 1u);
    // The rays of vertices are as long as the body is thick: at an open target they are cast.
    if (closed) {
      EXPECT_EQ(count_of(with, Arrow::kRaysBvh), 0u);
    }
    EXPECT_GT(count_of(without, Arrow::kRaysBvh), 0u);
    // Of the 1,280 triangles of the body, none reaches down as far as the hills below it do up.
    EXPECT_LT(count_of(with, Arrow::kMeshlets), 200u);
    EXPECT_LT(count_of(with, Arrow::kMeshletPairs), 200u);
    EXPECT_EQ(count_of(with, Arrow::kCrossings), 0u);
  }
}

}  // namespace
}  // namespace ode_ext::test
