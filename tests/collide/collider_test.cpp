// SPDX-License-Identifier: BSD-3-Clause
// The pipeline as a whole: what decides how long a batch takes must not decide what it gives.
#include "collide/collider.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "abi/contacts.h"
#include "support/points.h"
#include "support/test_scene.h"

namespace ode_ext::test {
namespace {

using Bits = std::vector<std::vector<ContactBits>>;

Bits collide(const TestScene& scene, const ColliderOptions& options = {}) {
  Collider collider(options);
  return bits_of(collider.collide(scene.scene, nullptr));
}

std::size_t contact_count(const Bits& bits) {
  return std::accumulate(bits.begin(), bits.end(), std::size_t{0},
                         [](std::size_t sum, const auto& pair) { return sum + pair.size(); });
}

// 300 pairs, and some with thousands of vertices.
TestScene scene_with_large_meshes() {
  TestScene scene = random_scene(300, 51);
  const std::uint32_t sphere = scene.add_mesh(make_icosphere(0.6, 4));
  const std::uint32_t cube = scene.add_mesh(make_cube(1, 12));
  Random random(52);
  for (int i = 0; i < 10; ++i) {
    const TestPose a = random.pose(0.5);
    scene.add_pair(i % 2 == 0 ? sphere : cube, a, i % 3 == 0 ? sphere : cube, random.pose(0.5));
  }
  return scene;
}

// The same objects and pairs, in the order that `order` names.
TestScene reordered(const TestScene& scene, const std::vector<std::size_t>& order) {
  TestScene result;
  result.scene.meshes = scene.scene.meshes;
  for (const std::size_t i : order)
    result.add_pair(scene.objects[scene.pairs[i][0]].mesh, scene.pose_of(i, 0),
                    scene.objects[scene.pairs[i][1]].mesh, scene.pose_of(i, 1));
  return result;
}

std::vector<std::size_t> shuffled_order(std::size_t count, std::uint64_t seed) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  Random random(seed);
  for (std::size_t i = count; i > 1; --i)
    std::swap(order[i - 1], order[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
  return order;
}

TEST(Collider, AnswersNothingForNoPairs) {
  Collider collider({});
  TestScene scene = random_scene(3, 1);
  scene.scene.pairs.clear();
  PassMemory history{{5, {9, 9, 9, 9}}, nullptr};
  const PairContacts& result = collider.collide(scene.scene, &history);
  EXPECT_TRUE(result.ranges.empty());
  EXPECT_TRUE(result.contacts.empty());
  EXPECT_TRUE(collider.collide(Scene{}, nullptr).ranges.empty());
  EXPECT_EQ(collider.report().synchronizations, 0);
}

TEST(Collider, AnswersEveryPairInItsPlace) {
  Collider collider({});
  for (const int count : {1, 63, 64, 65, 1234}) {
    const TestScene scene = random_scene(count, 53);
    const PairContacts& result = collider.collide(scene.scene, nullptr);
    ASSERT_EQ(result.ranges.size(), static_cast<std::size_t>(count));
    std::size_t next = 0;
    for (const PairContacts::Range& range : result.ranges) {
      EXPECT_EQ(range.first, next);
      EXPECT_LE(range.count, 16u);
      next += range.count;
    }
    EXPECT_EQ(next, result.contacts.size());
    for (std::size_t i = 0; i < result.ranges.size(); ++i) {
      for (std::uint32_t k = 0; k < result.ranges[i].count; ++k) {
        const Contact& c = result.contacts[result.ranges[i].first + k];
        EXPECT_NEAR(length(c.normal), 1, 1e-12);
        EXPECT_GT(c.depth, 0);
        EXPECT_LT(distance(point_of(c.position), scene.pose_of(i, 0).position), 2);
        for (std::size_t side = 0; side < 2; ++side)
          EXPECT_LT(c.triangles[side],
                    static_cast<std::uint32_t>(scene.mesh_of(i, side).triangle_count()));
      }
    }
  }
}

// How nearly a normal is that of one of its sides.
double along_a_side(const TestMesh& mesh, std::uint32_t triangle, const Point& normal) {
  double least = 1;
  for (std::size_t k = 0; k < 3; ++k)
    least = std::min(least, std::fabs(dot(normal, unit(mesh.corner(triangle, (k + 1) % 3) -
                                                       mesh.corner(triangle, k)))));
  return least;
}

// One of them has the normal; or it is the common normal of a side of each.
TEST(Collider, HandsOutTheTrianglesOfBothMeshesAtTheContact) {
  const TestScene scene = scene_with_large_meshes();
  Collider collider({});
  const PairContacts& result = collider.collide(scene.scene, nullptr);
  std::size_t of_faces = 0, of_edges = 0;
  for (std::size_t i = 0; i < result.ranges.size(); ++i) {
    for (std::uint32_t k = 0; k < result.ranges[i].count; ++k) {
      const Contact& c = result.contacts[result.ranges[i].first + k];
      bool of_face = false, of_edge = true;
      for (std::size_t side = 0; side < 2; ++side) {
        const TestMesh& mesh = scene.mesh_of(i, side);
        const Point normal = rotate_back(scene.pose_of(i, side), point_of(c.normal));
        const std::size_t t = c.triangles[side];
        const Point facing = unit(
            cross(mesh.corner(t, 1) - mesh.corner(t, 0), mesh.corner(t, 2) - mesh.corner(t, 0)));
        // Of inverted meshes it is turned outwards.
        of_face = of_face || std::fabs(dot(normal, facing)) > 1 - 1e-6;
        of_edge = of_edge && along_a_side(mesh, c.triangles[side], normal) < 1e-4;
      }
      EXPECT_TRUE(of_face || of_edge) << "pair " << i;
      ++(of_face ? of_faces : of_edges);
    }
  }
  EXPECT_GT(of_faces, 300u);
  EXPECT_GT(of_edges, 10u);
}

TEST(Collider, GivesTheSameBytesAgain) {
  const TestScene scene = scene_with_large_meshes();
  Collider collider({});
  PassMemory history;
  const Bits first = bits_of(collider.collide(scene.scene, &history));
  ASSERT_GT(contact_count(first), 1000u);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(bits_of(collider.collide(scene.scene, &history)), first);
  EXPECT_EQ(collide(scene), first);
}

TEST(Collider, GivesTheSameBytesWhateverItComputedBefore) {
  const TestScene scene = scene_with_large_meshes();
  const Bits expected = collide(scene);
  Collider collider({});
  PassMemory history;
  for (std::uint64_t seed = 1; seed < 4; ++seed) {
    collider.collide(random_scene(50 * static_cast<int>(seed), seed).scene, &history);
    EXPECT_EQ(bits_of(collider.collide(scene.scene, &history)), expected);
  }
}

TEST(Collider, GivesTheSameBytesForEveryWorkGroupSize) {
  const TestScene scene = scene_with_large_meshes();
  const Bits expected = collide(scene);
  for (const bool whole_steps : {true, false})  // those are in groups of one
    for (const std::uint32_t size : {1u, 32u, 256u}) {
      ColliderOptions options;
      options.whole_steps = whole_steps;
      options.work_group_size = size;
      EXPECT_EQ(collide(scene, options), expected) << size;
    }
}

TEST(Collider, GivesTheSameBytesForEveryPrediction) {
  const TestScene scene = scene_with_large_meshes();
  const TestScene other = random_scene(7, 54);
  const Bits expected = collide(scene);
  for (const PredictionRule rule : {PredictionRule::kPairScaled, PredictionRule::kPlain}) {
    for (const double confidence : {0.01, 1.0, 10.0}) {
      ColliderOptions options;
      options.prediction = rule;
      options.confidence = confidence;
      options.initial_capacity = 16;
      Collider collider(options);
      PassMemory history;
      collider.collide(other.scene, &history);  // far too little to go by
      EXPECT_EQ(bits_of(collider.collide(scene.scene, &history)), expected);
      EXPECT_EQ(bits_of(collider.collide(scene.scene, &history)), expected);
    }
  }
}

TEST(Collider, GivesTheSameBytesForTheExactWorkload) {
  const TestScene scene = scene_with_large_meshes();
  ColliderOptions options;
  options.launches = LaunchRule::kExact;
  EXPECT_EQ(collide(scene, options), collide(scene));
}

TEST(Collider, RedoesAStepWhoseBuffersOverflowAndLosesNothing) {
  const TestScene scene = scene_with_large_meshes();
  ColliderOptions roomy, tight;
  roomy.initial_capacity = 1 << 20;
  tight.initial_capacity = 1;
  Collider with_room(roomy), without(tight);
  const Bits expected = bits_of(with_room.collide(scene.scene, nullptr));
  EXPECT_EQ(with_room.report().redone, 0);
  EXPECT_EQ(bits_of(without.collide(scene.scene, nullptr)), expected);
  // Meshlets, crossings, words of the flood, rays, hits and contacts one after the other at most.
  EXPECT_GE(without.report().redone, 1);
  EXPECT_LE(without.report().redone, 6);
  EXPECT_EQ(without.report().actual, with_room.report().actual);
  EXPECT_EQ(without.report().pairs_bounded, with_room.report().pairs_bounded);
  EXPECT_EQ(bits_of(without.collide(scene.scene, nullptr)), expected);
  EXPECT_EQ(without.report().redone, 0) << "what has grown stays";
}

TEST(Collider, GivesTheSameBytesInManyTiles) {
  const TestScene scene = scene_with_large_meshes();
  const Bits expected = collide(scene);
  Collider whole({});
  whole.collide(scene.scene, nullptr);
  for (const bool whole_steps : {false, true})
    for (const std::uint64_t vertices : {1, 100, 5000}) {
      ColliderOptions options;
      options.whole_steps = whole_steps;
      options.tile_vertices = vertices;
      Collider collider(options);
      EXPECT_EQ(bits_of(collider.collide(scene.scene, nullptr)), expected) << vertices;
      EXPECT_GT(collider.report().synchronizations, 1);
      EXPECT_EQ(collider.report().actual, whole.report().actual);
      EXPECT_EQ(collider.report().pairs_bounded, whole.report().pairs_bounded);
    }
}

// What does not fit the device is cut up, pass after pass, and small batches are as ever.
TEST(Collider, GivesTheSameBytesOnADeviceOfSmallBuffers) {
  const TestScene scene = random_scene(4000, 51), small = random_scene(3, 57);
  Collider whole({});
  const Bits expected = bits_of(whole.collide(scene.scene, nullptr));
  const std::uint64_t crossings = whole.report().actual[OX_LIST_CROSSINGS];
  const Bits of_small = bits_of(whole.collide(small.scene, nullptr));
  ColliderOptions options;
  options.whole_steps = false;  // they need less room
  options.initial_capacity = 64;
  options.largest_buffer = std::uint64_t{3} << 20;  // the meshes, which are not cut up, take less
  ASSERT_GT(crossings * OX_PLANES_PER_FEATURE * OX_PLANE_WORDS * sizeof(ox_f32),
            2 * options.largest_buffer)
      << "it would fit at once";
  Collider collider(options);
  PassMemory memory, memory_of_small;
  for (int pass = 0; pass < 3; ++pass) {
    EXPECT_EQ(bits_of(collider.collide(scene.scene, &memory)), expected) << "pass " << pass;
    EXPECT_GT(memory.tile_pairs, 0u);
    EXPECT_LT(memory.tile_pairs, scene.pairs.size());
    EXPECT_EQ(bits_of(collider.collide(small.scene, &memory_of_small)), of_small);
    EXPECT_EQ(memory_of_small.tile_pairs, 0u);
  }
}

TEST(Collider, TriesAgainAfterAWhileWhatDidNotFit) {
  const TestScene scene = random_scene(65, 58);
  Collider collider({});
  PassMemory memory;
  memory.tile_pairs = 20;
  for (int pass = 0; pass < 200; ++pass) collider.collide(scene.scene, &memory);
  EXPECT_GE(memory.tile_pairs, scene.pairs.size());
}

// Equation 1 multiplies what one pair of fine meshes had by however many pairs come next.
TEST(Collider, IsNotHeldUpByAPredictionThatExceedsTheDevice) {
  const TestScene scene = random_scene(65, 59);
  const Bits expected = collide(scene);
  Collider collider({});
  for (const std::uint64_t count : {std::uint64_t{1} << 24, std::uint64_t{1} << 31}) {
    PassMemory memory;
    memory.history.pairs = 1;
    memory.history.counts.fill(count);
    EXPECT_EQ(bits_of(collider.collide(scene.scene, &memory)), expected);
    EXPECT_EQ(collider.report().redone, 0);
    std::uint64_t records = 0;
    for (const std::uint64_t capacity : collider.report().capacity) records += capacity;
    EXPECT_LT(records, count * 65 / 8);
    EXPECT_EQ(memory.history.pairs, 65u);
    EXPECT_EQ(memory.history.counts, collider.report().actual);
  }
}

TEST(Collider, GivesAPairTheSameBytesAloneAndAmongOthers) {
  const TestScene scene = scene_with_large_meshes();
  Collider collider({});
  const Bits all = bits_of(collider.collide(scene.scene, nullptr));
  for (std::size_t i = 0; i < scene.pairs.size(); i += 7) {
    const Bits alone = bits_of(collider.collide(reordered(scene, {i}).scene, nullptr));
    EXPECT_EQ(alone, Bits{all[i]}) << "pair " << i;
  }
}

TEST(Collider, GivesTheSameBytesInEveryOrderOfPairs) {
  const TestScene scene = scene_with_large_meshes();
  Collider collider({});
  const Bits bits = bits_of(collider.collide(scene.scene, nullptr));
  const auto order = shuffled_order(scene.pairs.size(), 55);
  const Bits shuffled = bits_of(collider.collide(reordered(scene, order).scene, nullptr));
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(shuffled[i], bits[order[i]]);
}

TEST(Collider, GivesTheSameBytesInEveryOrderOfMeshes) {
  const TestScene scene = scene_with_large_meshes();
  const auto order = shuffled_order(scene.meshes.size(), 56);
  Scene moved = scene.scene;
  for (std::size_t i = 0; i < order.size(); ++i) {
    moved.meshes[i] = scene.scene.meshes[order[i]];
    for (std::size_t k = 0; k < moved.objects.size(); ++k)
      if (scene.objects[k].mesh == order[i]) moved.objects[k].mesh = static_cast<std::uint32_t>(i);
  }
  Collider collider({});
  const Bits bits = bits_of(collider.collide(scene.scene, nullptr));
  EXPECT_EQ(bits_of(collider.collide(moved, nullptr)), bits);
}

// Poses whose differences are exact wherever they are: then the whole step must be the same.
TEST(Collider, GivesTheSameDepthsAMillionMetresFromTheOrigin) {
  TestScene near = scene_with_large_meshes();
  const Point place{1e6, -1e6, 1e6 + 0.5};
  TestScene far;
  far.scene.meshes = near.scene.meshes;
  for (std::size_t i = 0; i < near.pairs.size(); ++i) {
    TestPose poses[2];
    for (std::size_t side = 0; side < 2; ++side) {
      poses[side] = near.pose_of(i, side);
      for (double& x : poses[side].position) x = std::round(x * 0x1p20) / 0x1p20;
      const std::uint32_t object = near.pairs[i][side];
      near.scene.objects[object].pose = collider_pose(poses[side]);
      poses[side].position = poses[side].position + place;
    }
    far.add_pair(near.objects[near.pairs[i][0]].mesh, poses[0], near.objects[near.pairs[i][1]].mesh,
                 poses[1]);
  }
  Collider collider({});
  const PairContacts at_origin = collider.collide(near.scene, nullptr);
  const PairContacts& far_away = collider.collide(far.scene, nullptr);
  ASSERT_EQ(far_away.contacts.size(), at_origin.contacts.size());
  for (std::size_t i = 0; i < at_origin.contacts.size(); ++i) {
    const Contact &a = at_origin.contacts[i], &b = far_away.contacts[i];
    EXPECT_EQ(a.depth, b.depth);
    EXPECT_EQ(a.normal, b.normal);
    EXPECT_EQ(a.triangles, b.triangles);
    // A double at 1e6 m is known to 2^-33 m.
    EXPECT_LT(distance(point_of(b.position) - place, point_of(a.position)), 0x1p-31);
  }
}

TEST(Collider, WaitsForTheDeviceOnceInAStepLikeTheLast) {
  for (const int pairs : {20, 300, 1234}) {
    const TestScene scene = random_scene(pairs, 57);
    Collider collider({});
    PassMemory history;
    collider.collide(scene.scene, &history);
    collider.collide(scene.scene, &history);
    EXPECT_EQ(collider.report().synchronizations, 1) << pairs << " pairs, second batch";
    collider.collide(scene.scene, &history);
    EXPECT_EQ(collider.report().synchronizations, 1) << pairs << " pairs, third batch";
  }
}

TEST(Collider, WaitsForEveryCountWhereTheExactWorkloadIsAskedFor) {
  const TestScene scene = random_scene(100, 58);
  ColliderOptions options;
  options.launches = LaunchRule::kExact;
  Collider collider(options);
  PassMemory history;
  for (int i = 0; i < 3; ++i) collider.collide(scene.scene, &history);
  // Meshlets, pairs of them, chunks, rays, hits and crossings, and the answer.
  EXPECT_EQ(collider.report().synchronizations, 6);
}

TEST(Collider, ReportsWhatItPredictedAndWhatCame) {
  const TestScene scene = random_scene(100, 59);
  Collider collider({});
  PassMemory history;
  collider.collide(scene.scene, &history);
  const BatchReport first = collider.report();
  EXPECT_EQ(first.pairs, 100u);
  EXPECT_EQ(history.history.pairs, 100u);
  EXPECT_EQ(history.history.counts, first.actual);
  EXPECT_EQ(first.predicted, (ListCounts{1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}));
  collider.collide(scene.scene, &history);
  const BatchReport& second = collider.report();
  EXPECT_EQ(second.actual, first.actual);
  for (std::size_t i = 0; i < kListCount; ++i) {
    const double expected = std::ceil(1.2 * static_cast<double>(first.actual[i]));
    EXPECT_EQ(second.predicted[i],
              std::max<std::uint64_t>(1, static_cast<std::uint64_t>(expected)));
    EXPECT_GE(second.capacity[i], second.predicted[i]);
  }
  for (const List list : {List::kCrossings, List::kRays, List::kHits, List::kContacts})
    EXPECT_GT(first.actual[static_cast<std::size_t>(list)], 0u);
  const double rays = second.milliseconds(Stage::kBvhRays) + second.milliseconds(Stage::kWholeStep);
  EXPECT_GT(rays, 0);
  EXPECT_GE(second.ms_total, rays);
}

TEST(Collider, LeavesTheHistoryOfAPassAloneInSingleCalls) {
  const TestScene scene = random_scene(100, 60);
  Collider collider({});
  PassMemory history;
  collider.collide(scene.scene, &history);
  const History before = history.history;
  collider.collide(random_scene(3, 61).scene, nullptr);
  EXPECT_EQ(history.history.pairs, before.pairs);
  collider.collide(scene.scene, &history);
  EXPECT_EQ(collider.report().redone, 0);
}

TEST(Collider, AnswersNothingForMeshesWithoutTriangles) {
  TestScene scene;
  const std::uint32_t empty = scene.add_mesh(TestMesh{});
  const std::uint32_t cube = scene.add_mesh(make_cube(1));
  TestMesh not_finite = make_cube(1);
  not_finite.vertices[4] = std::numeric_limits<float>::quiet_NaN();
  const std::uint32_t broken = scene.add_mesh(not_finite);
  scene.add_pair(empty, at(0, 0, 0), cube, at(0, 0, 0));
  scene.add_pair(cube, at(0, 0, 0), broken, at(0, 0, 0));
  scene.add_pair(cube, at(0, 0, 0.9), cube, at(0.1, 0.2, 0));
  const Bits bits = collide(scene);
  EXPECT_TRUE(bits[0].empty());
  EXPECT_TRUE(bits[1].empty());
  EXPECT_FALSE(bits[2].empty());
}

// Powers of two round alike, so that what differs has over- or underflowed. Within the range of
// sizes for which contacts are right (mesh/range.h).
TEST(Collider, GivesMeshesPowersOfTwoLargerTheSameContactsToTheLastBit) {
  Collider collider({});
  const auto contacts_at = [&](double scale) {
    TestScene scene = random_scene(60, 82);
    const std::uint32_t cube = scene.add_mesh(make_cube(1)), small = scene.add_mesh(make_cube(0.5));
    for (const Point& place :  // rays leave by edges
         {Point{0.5, 0, 0}, Point{0.5, 0.25, 0}, Point{0.5, 0.5, 0.5}, Point{0.25, 0.25, 0}}) {
      scene.add_pair(cube, TestPose{}, cube, {place});
      scene.add_pair(cube, TestPose{}, small, {place});
    }
    for (std::size_t i = 0; i < scene.meshes.size(); ++i)
      scene.scene.meshes[i] =
          std::make_shared<const Mesh>(build_mesh(soup_of(scaled(scene.meshes[i], scale))));
    for (Scene::Object& object : scene.scene.objects)
      object.pose.position = scale * object.pose.position;
    std::vector<ContactBits> bits;
    for (Contact contact : collider.collide(scene.scene, nullptr).contacts) {
      contact.position = (1 / scale) * contact.position;
      contact.depth /= scale;
      bits.push_back(bits_of(contact));
    }
    return bits;
  };
  const std::vector<ContactBits> expected = contacts_at(1);
  EXPECT_GT(expected.size(), 200u);
  for (const int exponent : {-29, -13, 11, 35})
    EXPECT_EQ(contacts_at(std::ldexp(1, exponent)), expected) << exponent;
}

// Such meshes are refused before (mesh/range.h), but no kernel may rely on that: where products
// of lengths overflow or underflow, rays have no distances and regions no corners.
TEST(Collider, SurvivesMeshesOfAnySize) {
  Random random(81);
  Collider collider({});
  for (int exponent = -40; exponent <= 37; exponent += 3) {
    const double size = std::pow(10.0, exponent);
    TestScene scene;
    const std::uint32_t cube = scene.add_mesh(make_cube(size));
    const std::uint32_t ball = scene.add_mesh(make_icosphere(0.6 * size, 1));
    const std::uint32_t sheet = scene.add_mesh(make_sheet(size, 4));
    for (int i = 0; i < 8; ++i) {
      scene.add_pair(cube, random.pose(0.4 * size), ball, random.pose(0.4 * size));
      scene.add_pair(sheet, random.pose(0.4 * size), ball, random.pose(0.4 * size));
    }
    EXPECT_EQ(collider.collide(scene.scene, nullptr).ranges.size(), scene.pairs.size());
  }
}

// ODE scenes blow up; the collider must neither hang nor spoil the other pairs.
TEST(Collider, AnswersNothingForPosesThatAreNotFinite) {
  constexpr double kBad[] = {std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity(), 1e300};
  const TestScene good = one_pair(make_cube(1), at(0, 0, 0), make_cube(1), at(0.1, 0.1, 0.9));
  const Bits expected = collide(good);
  ASSERT_FALSE(expected[0].empty());
  for (const double bad : kBad) {
    TestScene scene;
    const std::uint32_t cube = scene.add_mesh(make_cube(1));
    TestPose skewed;
    skewed.rotation[4] = bad;
    scene.add_pair(cube, at(bad, 0, 0), cube, at(0, 0, 0));
    scene.add_pair(cube, skewed, cube, at(0.1, 0.1, 0.9));
    scene.add_pair(cube, at(0, 0, 0), cube, at(0.1, 0.1, 0.9));
    EXPECT_EQ(collide(scene), (Bits{{}, {}, expected[0]})) << bad;
  }
}

}  // namespace
}  // namespace ode_ext::test
