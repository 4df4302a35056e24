// SPDX-License-Identifier: BSD-3-Clause
// Several threads and one collider. What they may do at once is bounded by ODE (a space and its
// geoms belong to one thread at a time), not by the collider: whoever comes second is refused or
// waits, and nothing is read while it is written. Small scenes, for ThreadSanitizer.
#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

constexpr int kPasses = 100;

// A space with geoms of its own, for one thread.
struct Corner {
  Corner(OdeWorld& world, std::uint64_t seed)
      : space(world.space(SpaceKind::Simple)), pile(world, space, 6, seed) {}
  dSpaceID space;
  Pile pile;
};

constexpr int kLimit = 16;

// The pairs of a corner that are asked for, each geom with the next, and what they are told by a
// collider that knows nothing else.
struct Questions {
  explicit Questions(const Pile& pile) {
    for (std::size_t i = 0; i < pile.geoms.size(); ++i) {
      pairs.push_back({pile.geoms[i], pile.geoms[(i + 1) % pile.geoms.size()]});
      expected.push_back(fresh_answer(pairs.back().first, pairs.back().second, kLimit));
      contacts += expected.back().size();
    }
  }
  // Whether a collider that others use gives the same for pair number `i`, over and over.
  bool is_answered_by(dBatchColliderID collider, std::size_t i) const {
    const auto& [a, b] = pairs[i % pairs.size()];
    const dGeomID pair[] = {a, b};
    Contacts found(kLimit);
    int count = 0;
    if (dBatchColliderCollidePairs(collider, pair, 1, kLimit, found.data(), sizeof(dContactGeom),
                                   &count) < 0)
      return false;
    found.resize(static_cast<std::size_t>(count));
    return difference_with_geoms(found, expected[i % pairs.size()]).empty();
  }

  std::vector<GeomPair> pairs;
  std::vector<Contacts> expected;
  std::size_t contacts = 0;
};

// What a thread saw of its passes.
struct Passes {
  int delivered = 0, refused = 0, different = 0;
};

// Between two arrangements, so that every pass has something to compute.
struct Arrangements {
  Arrangements(Corner& where, const BatchCollider& collider) : corner(where) {
    for (std::uint64_t i = 0; i < 2; ++i) {
      corner.pile.shake(i);
      expected[i] = collider.pass(corner.space);
    }
  }
  Passes pass_again_and_again(dBatchColliderID collider) {
    Passes passes;
    for (std::uint64_t i = 0; i < kPasses; ++i) {
      corner.pile.shake(i % 2);
      Collected collected;
      const int result = dBatchColliderSpaceCollide(collider, corner.space, &collected, &collect);
      ++(result == 1 ? passes.delivered : passes.refused);
      if (result == 1)
        passes.different += !difference_with_geoms(collected, expected[i % 2]).empty();
    }
    return passes;
  }

  Corner& corner;
  Collected expected[2];
};

TEST(Threads, PassesOfOneColliderInTwoThreadsAreDeliveredOrRefused) {
  OdeWorld world;
  Corner corners[] = {Corner(world, 1), Corner(world, 2)};
  const BatchCollider collider;
  Arrangements mine(corners[0], collider), their(corners[1], collider);
  ASSERT_GT(mine.expected[0].total(), 0);
  Passes theirs;
  std::thread thread([&] { theirs = their.pass_again_and_again(collider); });
  const Passes ours = mine.pass_again_and_again(collider);
  thread.join();
  EXPECT_EQ(ours.different, 0);
  EXPECT_EQ(theirs.different, 0);
  EXPECT_GT(ours.delivered + theirs.delivered, 0);
}

TEST(Threads, PairsAskedOfOneColliderInTwoThreadsGetTheirOwnContacts) {
  OdeWorld world;
  const Corner corners[] = {Corner(world, 1), Corner(world, 2)};
  const Questions questions[] = {Questions(corners[0].pile), Questions(corners[1].pile)};
  ASSERT_GT(questions[0].contacts, 0u);
  ASSERT_GT(questions[1].contacts, 0u);
  const BatchCollider collider;
  std::atomic<int> answered = 0;
  const auto ask = [&](const Questions& asked) {
    for (std::size_t i = 0; i < kPasses; ++i) answered += asked.is_answered_by(collider, i);
  };
  std::thread thread([&] { ask(questions[1]); });
  ask(questions[0]);
  thread.join();
  EXPECT_EQ(answered, 2 * kPasses);
}

TEST(Threads, MayAskForPairsWhileTheCollidersPassRunsElsewhere) {
  OdeWorld world;
  Corner passing(world, 1), asking(world, 2);
  std::vector<Questions> questions;
  for (const std::uint64_t seed : {0, 1}) {
    asking.pile.shake(seed);
    questions.emplace_back(asking.pile);
    ASSERT_GT(questions.back().contacts, 0u);
  }
  const BatchCollider collider;
  std::atomic<bool> done = false;
  int bad = 0, asked = 0;
  std::thread thread([&] {
    while (!done) {
      const auto i = static_cast<std::size_t>(asked++);
      const std::size_t arrangement = i / 7 % 2;
      if (i % 7 == 0) asking.pile.shake(arrangement);  // else most answers are known already
      const Questions& now = questions[arrangement];
      const std::size_t k = i % now.pairs.size();
      const Contacts found = collide(now.pairs[k].first, now.pairs[k].second, kLimit);
      bad += !difference_with_geoms(found, now.expected[k]).empty();
    }
  });
  // A callback that asks for nothing takes no lock, behind which a mistake could hide; and it gives
  // the other thread time to ask while the pass runs.
  const auto wait = [](void*, dGeomID, dGeomID) {
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  };
  for (std::uint64_t i = 0; i < kPasses; ++i) {
    passing.pile.shake(i);
    dBatchColliderSpaceCollide(collider, passing.space, nullptr, wait);
  }
  done = true;
  thread.join();
  EXPECT_GT(asked, 0);
  EXPECT_EQ(bad, 0);
}

// A destroyed handle is refused; destroying during a pass is refused.
TEST(Threads, DestroyWhileAnotherPassesIsRefusedOrEndsThePasses) {
  OdeWorld world;
  Corner corner(world, 1);
  for (int round = 0; round < 5; ++round) {
    BatchCollider collider;
    const dBatchColliderID id = collider;
    std::atomic<int> passes = 0;
    std::thread thread([&] {
      Collected collected;
      while (dBatchColliderSpaceCollide(id, corner.space, &collected, &collect) == 1) ++passes;
    });
    while (passes < 3) std::this_thread::yield();
    do {
      dBatchColliderDestroy(id);
    } while (dBatchColliderGetStatus(id) >= 0);
    thread.join();
    EXPECT_GE(passes, 3);
  }
}

TEST(Threads, ReadStatisticsWhileAnotherPasses) {
  OdeWorld world;
  Corner corner(world, 1);
  const BatchCollider collider;
  collider.pass(corner.space);
  std::atomic<bool> done = false;
  std::thread thread([&] {
    long long last = 0;
    while (!done) {
      const long long passes = collider.stats().passes;
      EXPECT_GE(passes, last);
      last = passes;
    }
  });
  for (std::uint64_t i = 0; i < kPasses; ++i) {
    corner.pile.shake(i);
    collider.pass(corner.space);
  }
  done = true;
  thread.join();
}

}  // namespace
}  // namespace ode_ext::test
