// SPDX-License-Identifier: BSD-3-Clause
// The reduction: the contacts of a pair are those of its candidates that the same rule gives when
// it is followed plainly.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "contacts/reference_reduce.h"
#include "support/rig.h"

namespace ode_ext::test {
namespace {

using Words = std::array<ox_u32, sizeof(ox_contact) / sizeof(ox_u32)>;

Words words_of(const ox_contact& contact) {
  Words words;
  std::memcpy(&words, &contact, sizeof(words));
  return words;
}

Words words_of(const Candidate& c) {
  ox_contact contact{};
  contact.side_kind = c.side_kind;
  contact.vertex = c.vertex;
  contact.triangle = c.triangle;
  contact.depth = c.depth;
  std::copy_n(c.position, 3, contact.position);
  std::copy_n(c.normal, 3, contact.normal);
  std::copy_n(c.feature, 2, contact.feature);
  contact.region = c.region;
  return words_of(contact);
}

std::vector<Words> contacts_of(const StepRecords& records, std::size_t pair = 0) {
  std::vector<Words> contacts;
  for (ox_u32 k = 0; k < records.ranges[pair].count; ++k)
    contacts.push_back(words_of(records.contacts.at(records.ranges[pair].first + k)));
  return contacts;
}

// How large and how thick they are is all that the reduction knows of them.
const TestScene& cubes() {
  static const TestScene scene = one_pair(make_cube(1), at(0, 0, 0.9), make_cube(1), at(0, 0, 0));
  return scene;
}
float radius() { return cubes().built_mesh_of(0, 0).radius; }
double merge() { return 0.02 * static_cast<double>(radius()); }

std::vector<Words> reduced(const std::vector<Candidate>& candidates, std::uint32_t limit = 16,
                           const TestScene& scene = cubes()) {
  return contacts_of(Rig::shared().run_reduction(scene.scene, candidates, limit));
}

std::vector<Words> plainly_reduced(const std::vector<Candidate>& candidates, std::size_t limit,
                                   const TestScene& scene = cubes(), std::size_t pair = 0) {
  std::vector<Words> contacts;
  ReferenceReduce reduce(candidates, scene, pair);
  for (const Candidate& c : reduce.run(limit).taken) contacts.push_back(words_of(c));
  return contacts;
}

Candidate candidate(Point position, float depth, ox_u32 region = 0, ox_u32 manifold = 0,
                    Point normal = {0, 0, 1}) {
  Candidate c{};
  for (std::size_t k = 0; k < 3; ++k) {
    c.position[k] = static_cast<float>(position[k]);
    c.normal[k] = static_cast<float>(normal[k]);
  }
  c.depth = depth;
  c.region = region;
  c.manifold = manifold;
  c.distance2 = INFINITY;
  return c;
}

// So many of some regions, with two manifolds each that face their own ways. On a lattice many are
// as far apart and as deep as others.
std::vector<Candidate> random_candidates(Random& random, int count, bool lattice) {
  const int regions = 1 + random.below(6);
  std::vector<Point> normals;
  for (int i = 0; i < 2 * regions; ++i)
    normals.push_back(i % 3 == 0 ? Point{0, 0, 1} : random.direction());
  std::vector<Candidate> candidates;
  for (int i = 0; i < count; ++i) {
    Point position{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-0.1, 0.1)};
    double depth = random.uniform(0, 0.1);
    if (lattice) {
      for (double& x : position) x = 0.125 * std::floor(8 * x);
      depth = 0.03125 * std::floor(32 * depth);
    }
    const int manifold = random.below(2 * regions);
    Candidate c =
        candidate(position, static_cast<float>(depth), static_cast<ox_u32>(manifold / 2),
                  static_cast<ox_u32>(manifold), normals[static_cast<std::size_t>(manifold)]);
    c.side_kind = random.below(2) == 0 ? OX_HIT_POINT : OX_HIT_SIDE;
    c.vertex = static_cast<ox_u32>(i);
    c.triangle = static_cast<ox_u32>(random.below(10));
    candidates.push_back(c);
  }
  return candidates;
}

TEST(Reduction, TakesWhatThePlainRuleTakes) {
  Random random(41);
  for (const int count : {1, 2, 3, 5, 17, 63, 300})
    for (int i = 0; i < 6; ++i) {
      const auto candidates = random_candidates(random, count, i % 2 == 1);
      for (const std::uint32_t limit : {1u, 2u, 4u, 16u, 64u})
        EXPECT_EQ(reduced(candidates, limit), plainly_reduced(candidates, limit))
            << count << " candidates, limit " << limit << ", case " << i;
    }
}

TEST(Reduction, TakesWhatThePlainRuleTakesOfEveryPairOfAScene) {
  for (const int pairs : {0, 1, 63, 64, 65, 400}) {
    const TestScene scene = random_scene(pairs, 42);
    const StepRecords records =
        Rig::shared().run_with_edges(scene.scene, Organization::kPipelined, {8, 64}, true);
    std::size_t contacts = 0;
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      EXPECT_EQ(contacts_of(records, i), plainly_reduced(records.candidates_of(i), 16, scene, i))
          << "pair " << i << " of " << pairs;
      contacts += records.ranges[i].count;
    }
    if (pairs == 400) {
      EXPECT_GT(contacts, 1000u);
    }
  }
}

// At the foot of a wall: what the floor holds up there, the wall does not.
TEST(Reduction, KeepsWhatIsNearAndFacesAnotherWay) {
  const double near = 0.1 * merge();
  const std::vector<Candidate> corner{
      candidate({0, 0, 0}, 0.002f, 0, 0, {1, 0, 0}), candidate({near, 0, 0}, 0.001f, 0, 1),
      candidate({0, 0.5, 0}, 0.002f, 0, 0, {1, 0, 0}), candidate({near, 0.5, 0}, 0.001f, 0, 1)};
  EXPECT_EQ(reduced(corner).size(), 4u);
  std::vector<Candidate> floor = corner;
  for (Candidate& c : floor) c.normal[0] = 0, c.normal[2] = 1;
  EXPECT_EQ(reduced(floor).size(), 2u);
}

TEST(Reduction, GivesAPrefixOfTheLongAnswerForASmallLimit) {
  Random random(43);
  for (int i = 0; i < 10; ++i) {
    const auto candidates = random_candidates(random, 100, i % 2 == 1);
    const auto all = reduced(candidates, 64);
    for (const std::uint32_t limit : {1u, 2u, 3u, 4u, 8u, 16u, 32u}) {
      auto prefix = all;
      prefix.resize(std::min<std::size_t>(prefix.size(), limit));
      EXPECT_EQ(reduced(candidates, limit), prefix);
    }
  }
}

TEST(Reduction, DoesNotDependOnTheOrderOfCandidates) {
  Random random(44);
  for (int i = 0; i < 10; ++i) {
    auto candidates = random_candidates(random, 60, i % 2 == 1);
    const auto expected = reduced(candidates);
    for (int order = 0; order < 5; ++order) {
      for (std::size_t k = candidates.size(); k > 1; --k)
        std::swap(candidates[k - 1],
                  candidates[static_cast<std::size_t>(random.below(static_cast<int>(k)))]);
      EXPECT_EQ(reduced(candidates), expected);
    }
  }
}

// Edges that meet on a face cross it in one place: whose contact it is does not hang on which came
// first.
TEST(Reduction, TakesOfEqualCandidatesThatOfTheLesserFeature) {
  Candidate lesser = candidate({0, 0, 0}, 0.1f), greater = lesser;
  lesser.feature[1] = OX_OF(OX_OF_EDGE, 7u);
  greater.feature[1] = OX_OF(OX_OF_EDGE, 8u);
  EXPECT_EQ(reduced({lesser, greater}), std::vector{words_of(lesser)});
  EXPECT_EQ(reduced({greater, lesser}), std::vector{words_of(lesser)});
}

std::vector<Words> words_of_all(const std::vector<Candidate>& candidates) {
  std::vector<Words> words;
  for (const Candidate& c : candidates) words.push_back(words_of(c));
  return words;
}

TEST(Reduction, TakesTheDeepestAndThenTheDeepestOfEveryOtherRegionHoweverNear) {
  const Candidate deepest = candidate({0, 0, 0}, 0.3f, 0, 0);
  const Candidate second = candidate({0, 0, 0}, 0.2f, 1, 1);
  const Candidate third = candidate({1e-6, 0, 0}, 0.1f, 2, 2);
  const Candidate far = candidate({1, 0, 0}, 0.29f, 0, 0);
  EXPECT_EQ(reduced({far, third, deepest, second}), words_of_all({deepest, second, third, far}));
}

// Side by side they would hold a body on one side alone. But what only touches does not come before
// what is to be pushed out.
TEST(Reduction, TakesOfRegionsAndOfManifoldsThatAreHalfAsDeepTheFarthestFirst) {
  for (const bool regions : {true, false}) {
    const auto facet = [&](double x, float depth, ox_u32 number) {
      return candidate({x, 0, 0}, depth, regions ? number : 0, regions ? 0 : number);
    };
    const Candidate deepest = facet(0, 0.3f, 0), beside = facet(0.5, 0.25f, 1);
    const Candidate far = facet(1, 0.13f, 2), of_far = facet(0.9, 0.2f, 2);
    const Candidate touches = facet(-2, 0.01f, 3);
    EXPECT_EQ(reduced({far, beside, touches, of_far, deepest}),
              words_of_all({deepest, of_far, beside, touches, far}));
  }
}

TEST(Reduction, TakesTheDeepestOfEveryManifoldUnlessOneIsThere) {
  const Point aside{1, 0, 0};
  const Candidate deepest = candidate({0, 0, 0}, 0.3f, 0, 0);
  const Candidate there = candidate({0.5 * merge(), 0, 0}, 0.2f, 0, 1, aside);
  const Candidate beside = candidate({0, 0.1, 0}, 0.1f, 0, 1, aside);
  const Candidate far = candidate({1, 0, 0}, 0.25f, 0, 0);
  EXPECT_EQ(reduced({far, there, beside, deepest}), words_of_all({deepest, beside, far, there}));
}

TEST(Reduction, ThenTakesWhatIsFarthestAndOfEquallyFarOnesTheDeepest) {
  const Candidate deepest = candidate({0, 0, 0}, 0.3f);
  const Candidate left = candidate({-1, 0, 0}, 0.1f), right = candidate({1, 0, 0}, 0.2f);
  const Candidate near = candidate({0.5, 0, 0}, 0.25f);
  const Candidate merged = candidate({0.9 * merge(), 0, 0}, 0.29f);
  EXPECT_EQ(reduced({near, left, merged, right, deepest}),
            words_of_all({deepest, right, left, near}));
}

// One above the other holds no more; one that faces another way does.
TEST(Reduction, MeasuresAcrossTheNormalWhereBothFaceOneWay) {
  const Candidate deepest = candidate({0, 0, 0}, 0.3f);
  const Candidate above = candidate({0, 0, 0.5}, 0.2f);
  const Candidate tilted = candidate({0, 0, 0.5}, 0.2f, 0, 0, {0.6, 0, 0.8});
  EXPECT_EQ(reduced({above, deepest}), words_of_all({deepest}));
  EXPECT_EQ(reduced({tilted, deepest}), words_of_all({deepest, tilted}));
}

// A pane of 1 m and 2 mm, which stands on one of 1 mm, both turned: thinner than what is merged.
const TestScene& panes() {
  static const TestScene scene = one_pair(make_box({1, 1, 0.002}), turned({1, 0.2, 0.1}, 1.5),
                                          make_box({2, 0.001, 2}), turned({0.3, 1, 0.2}, 0.4));
  return scene;
}

TEST(Reduction, TakesWhatThePlainRuleTakesOfThinBodies) {
  Random random(43);
  std::size_t more = 0;
  for (const int count : {17, 63, 300})
    for (int i = 0; i < 6; ++i) {
      auto candidates = random_candidates(random, count, false);
      for (Candidate& c : candidates)
        for (float& x : c.position) x *= 0.02f;
      const std::vector<Words> taken = reduced(candidates, 64, panes());
      EXPECT_EQ(taken, plainly_reduced(candidates, 64, panes())) << count << ", case " << i;
      more += taken.size() - plainly_reduced(candidates, 64).size();
    }
  EXPECT_GT(more, 100u);
}

// Across x it is thinner than what is merged, which is as far as across y.
TEST(Reduction, TakesBothSidesOfWhatIsThinAcrossTheNormal) {
  const TestScene pane =
      one_pair(make_box({0.01, 1, 1}), at(0, 0, 1), make_box({2, 2, 1}), at(0, 0, 0));
  const double near = 0.009;
  const Candidate deepest = candidate({0, 0, 0}, 0.3f);
  const Candidate beside = candidate({near, 0, 0}, 0.2f);
  EXPECT_EQ(reduced({deepest, beside}, 16, pane), words_of_all({deepest, beside}));
  EXPECT_EQ(reduced({deepest, beside}), words_of_all({deepest}));
  // Lying on it, it is as wide as any.
  const Point x{1, 0, 0};
  const Candidate lying = candidate({0, 0, 0}, 0.3f, 0, 0, x);
  const Candidate by_it = candidate({0, near, 0}, 0.2f, 0, 0, x);
  EXPECT_EQ(reduced({lying, by_it}, 16, pane), words_of_all({lying}));
}

}  // namespace
}  // namespace ode_ext::test
