// SPDX-License-Identifier: BSD-3-Clause
// The contact step: every hit becomes a candidate of its pair, and of these the contacts are those
// that the same rule gives when it is followed plainly on a sorted list.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "pipeline/reference_reduce.h"
#include "pipeline/rig.h"
#include "reference/reference_hits.h"

namespace ode_ext::test {
namespace {

std::vector<ox_candidate> sorted_candidates(const StepRecords& records, std::size_t pair) {
  std::vector<ox_candidate> candidates;
  if (records.found[pair].hits > 0) {
    const auto first = records.candidates.begin() + records.found[pair].first_candidate;
    candidates.assign(first, first + records.found[pair].hits);
  }
  std::sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
    const auto key = [](const ox_candidate& c) {
      return std::tuple(c.side_kind >> 3, c.position[0], c.position[1], c.position[2], c.vertex);
    };
    return key(a) < key(b);
  });
  return candidates;
}

using ContactKey = std::tuple<ox_u32, ox_u32, ox_u32, ox_f32>;  // side, vertex, triangle, depth

std::vector<ContactKey> contacts_of(const StepRecords& records, std::size_t pair) {
  std::vector<ContactKey> keys;
  for (ox_u32 k = 0; k < records.ranges[pair].count; ++k) {
    const ox_contact& c = records.contacts.at(records.ranges[pair].first + k);
    keys.emplace_back(c.side_kind >> 3, c.vertex, c.triangle, c.depth);
  }
  return keys;
}

std::vector<ContactKey> expected_contacts(const TestScene& scene, std::size_t pair,
                                          const std::vector<ox_candidate>& candidates,
                                          std::size_t limit) {
  const float radius =
      std::min(scene.built_mesh_of(pair, 0).radius, scene.built_mesh_of(pair, 1).radius);
  ReferenceReduce reduce(candidates, 0.02f * radius, static_cast<double>(radius));
  std::vector<ContactKey> keys;
  for (const std::size_t i : reduce.run(limit).taken) {
    const ox_candidate& c = candidates[i];
    keys.emplace_back(c.side_kind >> 3, c.vertex, c.triangle, c.depth);
  }
  return keys;
}

// Small meshes, and three pairs with hundreds of hits each.
TestScene scene_of(int small_pairs) {
  TestScene scene = random_scene(small_pairs, 41);
  const std::uint32_t sphere = scene.add_mesh(make_icosphere(0.6, 3));
  const std::uint32_t cube = scene.add_mesh(make_cube(1, 8));
  scene.add_pair(sphere, at(0.1, 0.2, 0.3), cube, turned({1, 2, 3}, 0.4));
  scene.add_pair(cube, at(0.2, 0, 0), cube, at(0, 0, 0));
  scene.add_pair(sphere, at(0, 0, 0.01), sphere, at(0, 0, 0));
  return scene;
}

TEST(ContactStep, GathersEveryHitAmongThoseOfItsPairInTheFrameOfB) {
  const TestScene scene = scene_of(200);
  const StepRecords records = Rig::shared().run(scene.scene);
  ASSERT_GT(records.hits.size(), 1000u);
  std::map<std::tuple<ox_u32, ox_u32>, ox_hit> hits;  // pair_side, vertex
  for (const ox_hit& hit : records.hits) hits[{hit.pair_side, hit.vertex}] = hit;
  std::size_t gathered = 0;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const double tolerance = comparison_tolerance(scene.mesh_of(i, 0), scene.pose_of(i, 0),
                                                  scene.mesh_of(i, 1), scene.pose_of(i, 1));
    const TestPose &pa = scene.pose_of(i, 0), &pb = scene.pose_of(i, 1);
    for (const ox_candidate& c : sorted_candidates(records, i)) {
      ++gathered;
      const ox_u32 side = c.side_kind >> 3;
      const auto found = hits.find({static_cast<ox_u32>(i) << 1 | side, c.vertex});
      ASSERT_NE(found, hits.end());
      EXPECT_EQ(c.side_kind & OX_HIT_KIND, found->second.kind);
      EXPECT_EQ(c.triangle, found->second.triangle);
      EXPECT_EQ(c.depth, found->second.depth);
      EXPECT_EQ(c.t, found->second.t);
      hits.erase(found);

      const std::uint32_t source = scene.objects[scene.pairs[i][side]].mesh;
      const std::uint32_t target = scene.objects[scene.pairs[i][1 - side]].mesh;
      const Mesh &source_mesh = *scene.scene.meshes[source],
                 &target_mesh = *scene.scene.meshes[target];
      Point position = point_of(source_mesh.vertices[Rig::shared().local_vertex(source, c.vertex)]);
      Point normal =
          point_of(target_mesh.face_normals[Rig::shared().local_triangle(target, c.triangle)]);
      if (side == 0) {
        position = rotate_back(pb, rotate(pa, position) + (pa.position - pb.position));
      } else {  // out of A -> into A, in B's frame
        normal = -1 * rotate_back(pb, rotate(pa, normal));
      }
      EXPECT_LT(distance(point_of(c.position), position), 2 * tolerance);
      EXPECT_LT(distance(point_of(c.normal), normal), 2 * rounding_bound(1));
    }
  }
  EXPECT_EQ(gathered, records.hits.size());
}

TEST(ContactStep, TakesWhatThePlainRuleTakes) {
  for (const int pairs : {0, 1, 63, 64, 65, 1234}) {
    const TestScene scene = scene_of(pairs);
    for (const std::uint32_t limit : {1u, 2u, 4u, 16u, 64u}) {
      if (pairs == 1234 && limit != 16) continue;
      const StepRecords records = Rig::shared().run(scene.scene, limit);
      for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
        const auto candidates = sorted_candidates(records, i);
        EXPECT_EQ(contacts_of(records, i), expected_contacts(scene, i, candidates, limit))
            << "pair " << i << " of " << candidates.size() << " hits, limit " << limit;
      }
    }
  }
}

TEST(ContactStep, GivesAPrefixOfTheLongAnswerForASmallLimit) {
  const TestScene scene = scene_of(200);
  const StepRecords all = Rig::shared().run(scene.scene, 64);
  for (const std::uint32_t limit : {1u, 2u, 3u, 4u, 8u, 16u, 32u}) {
    const StepRecords few = Rig::shared().run(scene.scene, limit);
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      auto prefix = contacts_of(all, i);
      prefix.resize(std::min<std::size_t>(prefix.size(), limit));
      EXPECT_EQ(contacts_of(few, i), prefix);
    }
  }
}

TEST(ContactStep, PutsTheDeepestFirstAndThenTheDeepestOfEveryOtherPatch) {
  const TestScene scene = scene_of(300);
  const StepRecords records = Rig::shared().run(scene.scene, 64);
  int checked = 0;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const auto candidates = sorted_candidates(records, i);
    const auto contacts = contacts_of(records, i);
    ASSERT_EQ(candidates.empty(), contacts.empty());
    if (candidates.empty()) continue;
    ox_u32 kind = OX_HIT_TOUCHING;
    for (const ox_candidate& c : candidates) kind = std::min(kind, c.side_kind & OX_HIT_KIND);
    ox_f32 deepest = 0;
    for (const ox_candidate& c : candidates)
      if ((c.side_kind & OX_HIT_KIND) == kind) deepest = std::max(deepest, c.depth);
    EXPECT_EQ(std::get<3>(contacts[0]), deepest);
    // Every candidate faces the way of some contact (25.8 degrees), unless the limit was reached.
    if (contacts.size() == 64) continue;
    ++checked;
    for (const ox_candidate& c : candidates) {
      if ((c.side_kind & OX_HIT_KIND) != kind) continue;
      const bool covered = std::any_of(contacts.begin(), contacts.end(), [&](const auto& contact) {
        const auto other =
            std::find_if(candidates.begin(), candidates.end(), [&](const ox_candidate& candidate) {
              return std::tuple(candidate.side_kind >> 3, candidate.vertex) ==
                     std::tuple(std::get<0>(contact), std::get<1>(contact));
            });
        return dot(point_of(other->normal), point_of(c.normal)) > 0.9 - 1e-6;
      });
      EXPECT_TRUE(covered) << "pair " << i;
    }
  }
  EXPECT_GT(checked, 100);
}

TEST(ContactStep, KeepsFacesThatLookOppositeWaysApart) {
  // A cube in a slab leaves it on all six sides; each is a patch.
  const TestScene scene =
      one_pair(make_cube(0.4, 4), at(0.01, 0.02, 0), make_plate(3, 0.5, 1), at(0, 0, 0.02));
  const StepRecords records = Rig::shared().run(scene.scene, 6);
  const auto candidates = sorted_candidates(records, 0);
  std::vector<Point> normals;
  for (const auto& contact : contacts_of(records, 0))
    for (const ox_candidate& c : candidates)
      if (c.side_kind >> 3 == std::get<0>(contact) && c.vertex == std::get<1>(contact))
        normals.push_back(point_of(c.normal));
  ASSERT_EQ(normals.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_LT(dot(normals[i], normals[j]), 0.5);
}

}  // namespace
}  // namespace ode_ext::test
