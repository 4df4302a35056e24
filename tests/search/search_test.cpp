// SPDX-License-Identifier: BSD-3-Clause
// The search for crossings of edges against the brute-force reference, in both organizations: every
// one is found, and only those.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "collide/collider.h"
#include "search/crossing_comparison.h"
#include "support/rig.h"
#include "support/test_scene.h"

namespace ode_ext::test {
namespace {

Comparison compare_crossings(const TestScene& scene,
                             const std::map<CrossingKey, FoundCrossing>& found) {
  const std::vector<ReferenceSurface> surfaces(scene.meshes.begin(), scene.meshes.end());
  const Comparison comparison = compare_crossings(scene, surfaces, found);
  for (const std::string& difference : comparison.differences) ADD_FAILURE() << difference;
  return comparison;
}

Comparison compare_crossings(const TestScene& scene, Organization organization,
                             Launch launch = {8, 64}) {
  return compare_crossings(scene, found_crossings(scene, Rig::shared().run_with_edges(
                                                             scene.scene, organization, launch)));
}

constexpr Organization kBoth[] = {Organization::kPipelined, Organization::kMonolithic};

TEST(Search, FindsTheCrossingsOfTheReference) {
  const TestScene scene = random_scene(600, 71);
  for (const Organization organization : kBoth) {
    const Comparison comparison = compare_crossings(scene, organization);
    EXPECT_GT(comparison.certain, 5000u);
    EXPECT_LT(200 * comparison.ambiguous, comparison.certain) << comparison.ambiguous;
  }
}

TEST(Search, FindsTheSameWhateverTheNumberOfPairs) {
  for (const int count : {0, 1, 63, 64, 65, 1234}) {
    const TestScene scene = random_scene(count, 72);
    const auto pipelined =
        found_crossings(scene, Rig::shared().run_with_edges(scene.scene, kBoth[0]));
    const auto monolithic =
        found_crossings(scene, Rig::shared().run_with_edges(scene.scene, kBoth[1]));
    compare_crossings(scene, pipelined);
    ASSERT_EQ(pipelined.size(), monolithic.size());
    for (const auto& [key, crossing] : pipelined) {
      ASSERT_TRUE(monolithic.contains(key));
      EXPECT_EQ(monolithic.at(key).t, crossing.t);
      EXPECT_EQ(monolithic.at(key).leaves, crossing.leaves);
    }
  }
}

TEST(Search, FindsTheSameWhateverTheLaunch) {
  const TestScene scene = random_scene(65, 73);
  const auto keys = [&](Organization organization, Launch launch) {
    std::set<CrossingKey> result;
    for (const auto& [key, crossing] :
         found_crossings(scene, Rig::shared().run_with_edges(scene.scene, organization, launch)))
      result.insert(key);
    return result;
  };
  const std::set<CrossingKey> expected = keys(kBoth[0], {8, 64});
  EXPECT_GT(expected.size(), 500u);
  for (const Organization organization : kBoth)
    for (const Launch launch : {Launch{1, 1}, Launch{1, 64}, Launch{3, 32}, Launch{64, 256}})
      EXPECT_EQ(keys(organization, launch), expected);
}

TEST(Search, FindsTheCrossingsOfLargerMeshes) {
  TestScene scene;
  scene.add_mesh(jittered(make_icosphere(0.6, 3), 0.002, 1));
  scene.add_mesh(jittered(make_torus(0.5, 0.2, 32, 20), 0.002, 2));
  scene.add_mesh(make_cube(1, 8));
  Random random(74);
  for (std::uint32_t i = 0; i < 9; ++i) {
    const TestPose a = random.pose(0.3);
    scene.add_pair(i % 3, a, i / 3 % 3, random.pose(0.3));
  }
  for (const Organization organization : kBoth) {
    const Comparison comparison = compare_crossings(scene, organization);
    EXPECT_GT(comparison.certain, 500u);
    // One edge in fifty is so flat that it may as well not be cast.
    EXPECT_LT(20 * comparison.ambiguous, comparison.certain) << comparison.ambiguous;
  }
}

TEST(Search, FindsTheSameFarFromTheOrigin) {
  const TestScene near = random_scene(60, 75);
  for (const Point& place : {Point{1e4, -2e4, 5e3}, Point{1e6, 1e6, -1e6}}) {
    TestScene far;
    for (const TestMesh& mesh : near.meshes) far.add_mesh(mesh);
    for (std::size_t i = 0; i < near.pairs.size(); ++i) {
      TestPose a = near.pose_of(i, 0), b = near.pose_of(i, 1);
      a.position = a.position + place;
      b.position = b.position + place;
      far.add_pair(near.objects[near.pairs[i][0]].mesh, a, near.objects[near.pairs[i][1]].mesh, b);
    }
    EXPECT_GT(compare_crossings(far, Organization::kPipelined).certain, 500u);
  }
}

TEST(Search, FindsTheSameAtEverySize) {
  const TestScene model = random_scene(60, 76);
  for (const double scale : {1e-4, 1e-2, 1e2, 1e4}) {
    TestScene scene;
    for (const TestMesh& mesh : model.meshes) scene.add_mesh(scaled(mesh, scale));
    for (std::size_t i = 0; i < model.pairs.size(); ++i) {
      TestPose a = model.pose_of(i, 0), b = model.pose_of(i, 1);
      a.position = scale * a.position;
      b.position = scale * b.position;
      scene.add_pair(model.objects[model.pairs[i][0]].mesh, a,
                     model.objects[model.pairs[i][1]].mesh, b);
    }
    EXPECT_GT(compare_crossings(scene, Organization::kPipelined).certain, 500u) << scale;
  }
}

// Edges that lie in faces and on edges: whatever rounding says, they are no others.
TEST(Search, FindsNothingFarFromWhereAlignedBoxesTouch) {
  for (const Point& offset : {Point{0, 0, 0}, Point{0.5, 0, 0}, Point{0, 0, 1}, Point{0.5, 0.5, 1},
                              Point{1, 1, 1}, Point{0.25, 0.5, 0.75}}) {
    TestScene scene;
    const std::uint32_t cube = scene.add_mesh(make_cube(1, 2));
    scene.add_pair(cube, at(offset[0], offset[1], offset[2]), cube, at(0, 0, 0));
    for (const Organization organization : kBoth) compare_crossings(scene, organization);
  }
}

// What runs through the neighbour of a hole in the grid or past the box must not be culled: a rod
// through a ring, and thin rods past one another.
TEST(Search, CullsNothingThatCrosses) {
  TestScene scene;
  const std::uint32_t ring = scene.add_mesh(make_torus(1, 0.1, 40, 8));
  const std::uint32_t rod = scene.add_mesh(make_rod(4, 0.01));
  const std::uint32_t sheet = scene.add_mesh(make_sheet(2, 9));
  Random random(77);
  for (int i = 0; i < 60; ++i) {
    const TestPose pose = random.pose(1);
    scene.add_pair(rod, pose, ring, random.pose(0.1));
    scene.add_pair(sheet, pose, rod, random.pose(0.5));
    scene.add_pair(ring, pose, ring, random.pose(0.5));
  }
  for (const Organization organization : kBoth)
    EXPECT_GT(compare_crossings(scene, organization).certain, 300u);
}

// Its box is in that of the ring, and nothing of it near the ring.
TEST(Search, ListsNoMeshletOfABallInTheHoleOfARing) {
  TestScene scene;
  const std::uint32_t ball = scene.add_mesh(make_icosphere(0.3, 5));
  const std::uint32_t ring = scene.add_mesh(make_torus(1, 0.2, 40, 20));
  const auto listed = [&](double off) {
    TestScene pair = scene;
    pair.add_pair(ball, at(off, 0, 0), ring, at(0, 0, 0));
    const StepRecords records = Rig::shared().run_with_edges(pair.scene, Organization::kPipelined);
    EXPECT_EQ(records.crossings.empty(), off < 0.5);
    return records.meshlet_tasks.size();
  };
  EXPECT_EQ(listed(0), 0u);
  const std::size_t all = Rig::shared().run_with_edges(scene.scene, kBoth[0]).meshlets.size();
  EXPECT_GT(listed(0.6), 10u);
  EXPECT_LT(listed(0.6), all / 2);
}

TestMesh turned_mesh(TestMesh mesh, const TestPose& pose) {
  for (std::size_t i = 0; i < mesh.vertices.size(); i += 3) {
    const Point p = to_world(pose, mesh.vertex(i / 3));
    for (std::size_t k = 0; k < 3; ++k) mesh.vertices[i + k] = static_cast<float>(p[k]);
  }
  return mesh;
}

// A crate that stands on a corner in its own frame: its box is mostly empty, and all of the floor
// below is in it, of which the corner meets next to nothing.
TEST(Search, ListsOfAFineFloorWhatIsNearACrateNotWhatIsInItsBox) {
  TestScene scene;
  const std::uint32_t crate = scene.add_mesh(
      turned_mesh(make_cube(0.4), turned({1, -1, 0}, std::acos(1 / std::sqrt(3.0)))));
  const std::uint32_t floor = scene.add_mesh(make_box({2, 2, 0.2}, 40, 40, 1));
  scene.add_pair(crate, at(0.013, 0.007, 0.1 + 0.2 * std::sqrt(3.0) - 0.001), floor, at(0, 0, 0));
  const StepRecords records = Rig::shared().run_with_edges(scene.scene, kBoth[0]);
  EXPECT_GT(compare_crossings(scene, kBoth[0]).certain, 2u);
  EXPECT_LT(records.meshlet_pairs.size(), 12u);
  EXPECT_LT(records.meshlet_tasks.size(), 12u);
}

TEST(Search, FindsTheCrossingsOfCoarseMeshesWithFineOnes) {
  TestScene scene;
  const std::array coarse{scene.add_mesh(make_cube(0.6)),
                          scene.add_mesh(make_tetrahedron(0.9)),
                          scene.add_mesh(make_l(0.7)),
                          scene.add_mesh(make_icosphere(0.4, 0)),
                          scene.add_mesh(make_comb(3, 0.2, 0.3, 0.4)),
                          scene.add_mesh(make_triangle(0.8)),
                          scene.add_mesh(inverted(make_cube(0.5)))};
  const std::array fine{scene.add_mesh(make_icosphere(0.6, 4)), scene.add_mesh(make_waves(3, 40)),
                        scene.add_mesh(make_torus(0.6, 0.2, 60, 20))};
  Random random(82);
  for (std::size_t i = 0; i < 126; ++i) {
    const TestPose one = random.pose(0.6);
    const TestPose other = random.pose(0.2);
    const std::uint32_t few = coarse[i % coarse.size()];
    const std::uint32_t many = fine[i % fine.size()];
    if (i % 2 == 0)
      scene.add_pair(few, one, many, other);
    else
      scene.add_pair(many, one, few, other);
  }
  EXPECT_GT(compare_crossings(scene, kBoth[0]).certain, 3000u);
}

// The meshlets of a task's subtree, over all meshes: from the first up to the second.
std::pair<ox_u32, ox_u32> meshlets_of(const Scene& scene, const ox_meshlet_task& task) {
  const std::uint32_t object = scene.pairs[task.pair_side >> 1][1 - task.pair_side % 2];
  const std::uint32_t mesh = scene.objects[object].mesh;
  std::size_t before = 0;
  for (std::uint32_t i = 0; i < mesh; ++i)
    before += scene.meshes[i]->topology->meshlets.meshlets.size();
  const MeshletNode& node = scene.meshes[mesh]->topology->meshlets.tree[task.subtree >> 1];
  const auto first = static_cast<ox_u32>(before);
  return {first + node.first[0], first + node.first[node.count]};
}

// Two fine balls nearly in one place, of which each meshlet meets several subtrees of the other,
// and large sheets through one of them, of which a few meshlets meet as good as all.
TestScene scene_of_many_subtrees(int subdivisions) {
  TestScene scene;
  const std::uint32_t ball = scene.add_mesh(make_icosphere(0.6, subdivisions));
  scene.add_pair(ball, at(0, 0, 0), ball, turned({1, 2, 3}, 0.01, {0.001, 0.002, 0.003}));
  TestMesh sheets = moved(make_icosphere(0.6, subdivisions), {9, 0, 0});
  for (int i = -2; i <= 2; ++i) sheets = merged(sheets, moved(make_sheet(4, 5), {0, 0, 0.2 * i}));
  scene.add_pair(scene.add_mesh(sheets), at(0, 0, 0), ball, at(0.1, 0.2, 0.03));
  return scene;
}

// The way of each crossing: the meshlet of its edge and that of its triangle were matched, once,
// and the cull left one of them with a subtree of the other mesh that has the other.
TEST(Search, MatchesTheMeshletsOfEveryCrossingOnce) {
  TestScene scene = random_scene(65, 78);
  const std::uint32_t fine = scene.add_mesh(make_icosphere(0.6, 4));
  scene.add_pair(fine, at(30, 0, 0), fine, turned({1, 2, 3}, 0.4, {30.9, 0.1, 0.2}));
  const StepRecords records = Rig::shared().run_with_edges(scene.scene, Organization::kPipelined);
  std::map<std::pair<ox_u32, ox_u32>, std::vector<std::pair<ox_u32, ox_u32>>> tasks;
  std::set<std::tuple<ox_u32, ox_u32, ox_u32>> listed;
  for (const ox_meshlet_task& task : records.meshlet_tasks) {
    EXPECT_TRUE(listed.emplace(task.pair_side, task.meshlet, task.subtree).second);
    const std::pair<ox_u32, ox_u32> meshlets = meshlets_of(scene.scene, task);
    std::vector<std::pair<ox_u32, ox_u32>>& others = tasks[{task.pair_side, task.meshlet}];
    for (const auto& [first, end] : others)  // they share nothing
      EXPECT_TRUE(meshlets.second <= first || end <= meshlets.first);
    others.push_back(meshlets);
  }
  const auto subtrees_with = [&](ox_u32 pair_side, ox_u32 meshlet, ox_u32 other) {
    const auto found = tasks.find({pair_side, meshlet});
    std::size_t count = 0;
    if (found == tasks.end()) return count;
    for (const auto& [first, end] : found->second) count += first <= other && other < end;
    return count;
  };
  std::set<std::tuple<ox_u32, ox_u32, ox_u32>> matched;
  for (const ox_meshlet_pair& both : records.meshlet_pairs) {
    EXPECT_TRUE(matched.emplace(both.pair, both.meshlet[0], both.meshlet[1]).second);
    EXPECT_TRUE(tasks.contains({both.pair << 1, both.meshlet[0]}) ||
                tasks.contains({both.pair << 1 | 1, both.meshlet[1]}));
    EXPECT_EQ(subtrees_with(both.pair << 1, both.meshlet[0], both.meshlet[1]) +
                  subtrees_with(both.pair << 1 | 1, both.meshlet[1], both.meshlet[0]),
              1u);
  }
  std::map<ox_u32, ox_u32> of_edge, of_triangle;
  for (ox_u32 m = 0; m < records.meshlets.size(); ++m) {
    const ox_meshlet& meshlet = records.meshlets[m];
    for (ox_u32 e = 0; e < meshlet.edge_count; ++e)
      EXPECT_TRUE(of_edge.emplace(meshlet.edge[e], m).second);
    for (ox_u32 k = 0; k < meshlet.triangle_count; ++k)
      EXPECT_TRUE(of_triangle.emplace(meshlet.triangle[k], m).second);
  }
  EXPECT_EQ(of_edge.size(), records.edges.size());
  ASSERT_GT(records.crossings.size(), 500u);
  for (const ox_edge_crossing& c : records.crossings) {
    const ox_u32 edges = of_edge.at(c.edge), triangles = of_triangle.at(c.triangle);
    const bool of_a = (c.pair_side & 1) == 0;
    EXPECT_TRUE(
        matched.contains({c.pair_side >> 1, of_a ? edges : triangles, of_a ? triangles : edges}));
  }
}

TEST(Search, FindsTheCrossingsOfMeshesThatMeetInManySubtrees) {
  const TestScene scene = scene_of_many_subtrees(4);
  for (const Organization organization : kBoth)
    EXPECT_GT(compare_crossings(scene, organization).certain, 1000u);
}

// Of more than that a meshlet is listed with the whole tree.
TEST(Search, ListsAMeshletWithSixteenSubtreesAtMost) {
  const TestScene scene = scene_of_many_subtrees(5);
  const StepRecords records = Rig::shared().run_with_edges(scene.scene, kBoth[0]);
  std::map<std::pair<ox_u32, ox_u32>, int> subtrees;
  std::set<ox_u32> with_the_whole_tree, with_less;  // pairs
  for (const ox_meshlet_task& task : records.meshlet_tasks) {
    EXPECT_LE((++subtrees[{task.pair_side, task.meshlet}]), 16);
    (task.subtree == OX_TREE_ROOT ? with_the_whole_tree : with_less).insert(task.pair_side >> 1);
  }
  EXPECT_TRUE(with_the_whole_tree.contains(1));
  // On a GPU that is how each is listed.
  const bool is_processor = (Collider({}).device_info().type & CL_DEVICE_TYPE_CPU) != 0;
  EXPECT_EQ(with_less.contains(0), is_processor);
}

// Of two fine meshes in one place a list of the meshlets of one, each once, would be too short.
TEST(Search, HasRoomForEverySubtreeThatMeshletsMeet) {
  const TestScene scene = scene_of_many_subtrees(5);
  ColliderOptions by_steps, by_items;
  by_steps.whole_steps = by_items.whole_steps = false;
  by_items.vector_width = 1;
  Collider steps(by_steps), items(by_items);
  EXPECT_EQ(bits_of(steps.collide(scene.scene, nullptr)),
            bits_of(items.collide(scene.scene, nullptr)));
  EXPECT_EQ(steps.report().actual[OX_LIST_CROSSINGS], items.report().actual[OX_LIST_CROSSINGS]);
  EXPECT_EQ(steps.report().actual[OX_LIST_MESHLET_PAIRS],
            items.report().actual[OX_LIST_MESHLET_PAIRS]);
}

// One by one as on a GPU, or as vectors: lane by lane it is the same arithmetic. Each width is a
// program to compile, so each is a test; the whole step is of the same functions, and left out.
class SearchInLanes : public testing::TestWithParam<std::tuple<std::uint32_t, Lanes, bool>> {};

TEST_P(SearchInLanes, FindsTheSameBytesByVectorsAndByItems) {
  TestScene scene = random_scene(100, 81);
  // A tree of several levels.
  const std::uint32_t fine = scene.add_mesh(make_icosphere(0.6, 4));
  scene.add_pair(fine, at(30, 0, 0), fine, turned({1, 2, 3}, 0.4, {30.9, 0.1, 0.2}));
  const auto contacts = [&](const ColliderOptions& options) {
    Collider collider(options);
    return bits_of(collider.collide(scene.scene, nullptr));
  };
  ColliderOptions options;
  const auto expected = contacts(options);
  EXPECT_TRUE(
      std::any_of(expected.begin(), expected.end(), [](const auto& c) { return !c.empty(); }));
  std::tie(options.vector_width, options.lanes, options.builtins) = GetParam();
  options.whole_steps = false;
  EXPECT_EQ(contacts(options), expected);
}

INSTANTIATE_TEST_SUITE_P(
    Widths, SearchInLanes,
    testing::Values(std::tuple{1u, Lanes::kVectors, true}, std::tuple{4u, Lanes::kVectors, true},
                    std::tuple{8u, Lanes::kVectors, true}, std::tuple{8u, Lanes::kVectors, false},
                    std::tuple{16u, Lanes::kVectors, true}, std::tuple{16u, Lanes::kVectors, false},
                    std::tuple{1u, Lanes::kItems, true}, std::tuple{8u, Lanes::kItems, true}));

}  // namespace
}  // namespace ode_ext::test
