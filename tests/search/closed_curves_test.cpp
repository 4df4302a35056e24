// SPDX-License-Identifier: BSD-3-Clause
// Crossings of meshes in general position: exact, so that the curves they lie on are closed.
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "search/batch_data.h"
#include "search/search.h"
#include "support/test_scene.h"

namespace ode_ext::test {
namespace {

std::vector<TestMesh> closed_meshes() {
  return {make_cube(1, 1),        make_cube(1, 4),
          make_icosphere(0.5, 2), make_torus(0.5, 0.2, 16, 8),
          make_rod(2, 0.05),      make_icosphere(0.6, 0)};
}

// All facets of these meshes are convex: two have one stretch of a line in common.
struct Curves {
  std::size_t pairs = 0;   // of facets that cross
  std::size_t others = 0;  // of those, with more or fewer crossings than two
};

// The steps up to the crossings, with room for all that there may be in these tests.
Curves find_curves(const TestScene& scene) {
  const auto& meshes = scene.scene.meshes;
  Device device("");
  Program program(device, "");
  Search search(program, program, 1);
  BatchData data(program);
  data.settings.modes = OX_MODE_EDGES | OX_MODE_FLOOD;
  data.meshes.set(meshes);
  data.pairs.upload_objects(scene.scene);
  data.pairs.upload_pairs(scene.scene, {0, scene.pairs.size()});
  ListCounts room{};
  room.fill(1u << 18);
  data.lists.reserve(room);
  data.lists.begin(data.lists.capacities());
  const Launch launch{8, 64};
  for (Kernel* kernel : {&search.pair_step, &search.cull, &search.match, &search.cross})
    data.launch(*kernel, launch);
  data.lists.count();
  EXPECT_FALSE(data.lists.overflowed([&] {
    ListCounts counts{};
    for (std::size_t i = 0; i < kListCount; ++i) counts[i] = data.lists.counted(i);
    return counts;
  }()));
  std::vector<ox_edge_crossing> crossings(data.lists.counted(std::size_t{OX_LIST_CROSSINGS}));
  data.lists.crossings().read(crossings.data(), crossings.size() * sizeof(ox_edge_crossing));
  std::size_t edge_count = 0;
  for (const auto& mesh : meshes)
    edge_count += mesh->topology->edges.size() + mesh->topology->flat_edges.size();
  std::vector<ox_edge> device_edges(edge_count);
  data.meshes.edges().read(device_edges.data(), edge_count * sizeof(ox_edge));
  device.finish();
  std::size_t triangle_count = 0;
  for (const auto& mesh : meshes) triangle_count += mesh->topology->triangles.size();
  std::vector<ox_triangle> device_triangles(triangle_count);
  data.meshes.triangles().read(device_triangles.data(), triangle_count * sizeof(ox_triangle));
  device.finish();
  std::map<std::tuple<ox_u32, ox_u32, ox_u32>, int> counts;  // pair, facet of A, of B
  for (const ox_edge_crossing& crossing : crossings) {
    const ox_edge& edge = device_edges.at(crossing.edge);
    if (device_triangles[edge.triangle[0]].facet == device_triangles[edge.triangle[1]].facet)
      continue;
    for (const ox_u32 at : edge.triangle) {
      const bool side = (crossing.pair_side & 1u) != 0;
      const ox_u32 own = device_triangles[at].facet,
                   crossed = device_triangles[crossing.triangle].facet;
      ++counts[{crossing.pair_side >> 1, side ? crossed : own, side ? own : crossed}];
    }
  }
  Curves curves;
  curves.pairs = counts.size();
  for (const auto& [triangles, count] : counts) curves.others += count != 2;
  return curves;
}

TestScene scene_of_closed_meshes() {
  TestScene scene;
  for (const TestMesh& mesh : closed_meshes()) scene.add_mesh(mesh);
  return scene;
}

TEST(ClosedCurves, TwoFacetsThatCrossHaveTwoCrossings) {
  TestScene scene = scene_of_closed_meshes();
  Random random(81);
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const TestPose pose = random.pose(0.5);
    scene.add_pair(i % 6, pose, i / 6 % 6, random.pose(0.5));
  }
  const Curves curves = find_curves(scene);
  EXPECT_GT(curves.pairs, 20000u);
  EXPECT_EQ(curves.others, 0u) << "of " << curves.pairs;
}

TEST(ClosedCurves, AreThoseOfCoincidentSurfacesToo) {
  TestScene scene = scene_of_closed_meshes();
  for (std::uint32_t i = 0; i < 6; ++i)
    for (std::uint32_t j = 0; j < 6; ++j)
      for (const Point& offset :
           {Point{0, 0, 0}, Point{0.5, 0, 0}, Point{0, 0, 1}, Point{0.5, 0.5, 1}, Point{1, 1, 1},
            Point{0.25, 0.5, 0.75}, Point{0, 1e-7, 0}})
        scene.add_pair(i, at(offset[0], offset[1], offset[2]), j, at(0, 0, 0));
  const Curves curves = find_curves(scene);
  EXPECT_GT(curves.pairs, 1000u);
  EXPECT_EQ(curves.others, 0u) << "of " << curves.pairs;
}

TEST(ClosedCurves, AreThoseOfSmallMeshesAndLargeOnes) {
  TestScene scene = scene_of_closed_meshes();
  const Point far{1e4, -1e4, 1e3};
  for (std::uint32_t i = 0; i < 6; ++i) scene.add_mesh(far_out(TestMesh(scene.meshes[i]), far));
  Random random(83);
  for (std::uint32_t i = 0; i < 100; ++i) {
    TestPose a = random.pose(0.5), b = random.pose(0.5);
    b.position = b.position - rotate(b, far);
    if (i % 2 == 0)
      scene.add_pair(i % 6, a, 6 + i / 6 % 6, b);
    else
      scene.add_pair(6 + i / 6 % 6, b, i % 6, a);
  }
  const Curves curves = find_curves(scene);
  EXPECT_GT(curves.pairs, 1000u);
  EXPECT_EQ(curves.others, 0u) << "of " << curves.pairs;
}

TEST(ClosedCurves, AreThoseOfMeshesFarFromTheOrigin) {
  TestScene scene = scene_of_closed_meshes();
  Random random(82);
  for (std::uint32_t i = 0; i < 100; ++i) {
    TestPose a = random.pose(0.5), b = random.pose(0.5);
    a.position = a.position + Point{1e6, -1e6, 1e6};
    b.position = b.position + Point{1e6, -1e6, 1e6};
    scene.add_pair(i % 6, a, i / 6 % 6, b);
  }
  const Curves curves = find_curves(scene);
  EXPECT_GT(curves.pairs, 1000u);
  EXPECT_EQ(curves.others, 0u) << "of " << curves.pairs;
}

}  // namespace
}  // namespace ode_ext::test
