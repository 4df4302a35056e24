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

// Contacts that could not be an answer to dCollide(a, b).
int wrong(const Contacts& contacts, dGeomID a, dGeomID b) {
  int count = 0;
  for (const dContactGeom& c : contacts) {
    count += c.g1 != a || c.g2 != b || !std::isfinite(c.depth) || c.depth < 0;
  }
  return count;
}

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
  const BatchCollider collider;
  std::atomic<int> answered = 0, bad = 0;
  const auto ask = [&](const Corner& corner) {
    const auto& geoms = corner.pile.geoms;
    for (std::size_t i = 0; i < kPasses; ++i) {
      const dGeomID pair[] = {geoms[i % geoms.size()], geoms[(i + 1) % geoms.size()]};
      Contacts contacts(16);
      int count = 0;
      answered += dBatchColliderCollidePairs(collider, pair, 1, 16, contacts.data(),
                                             sizeof(dContactGeom), &count) >= 0;
      contacts.resize(static_cast<std::size_t>(count));
      bad += wrong(contacts, pair[0], pair[1]);
    }
  };
  std::thread thread([&] { ask(corners[1]); });
  ask(corners[0]);
  thread.join();
  EXPECT_EQ(answered, 2 * static_cast<int>(kPasses));
  EXPECT_EQ(bad, 0);
}

TEST(Threads, MayAskForPairsWhileTheCollidersPassRunsElsewhere) {
  OdeWorld world;
  Corner passing(world, 1), asking(world, 2);
  const BatchCollider collider;
  std::atomic<bool> done = false;
  int bad = 0, asked = 0;
  std::thread thread([&] {
    const auto& geoms = asking.pile.geoms;
    while (!done) {
      const std::size_t i = static_cast<std::size_t>(asked++);
      const dGeomID a = geoms[i % geoms.size()], b = geoms[(i + 1) % geoms.size()];
      if (i % 7 == 0) asking.pile.shake(i);  // else most answers are known already
      bad += wrong(collide(a, b), a, b);
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
