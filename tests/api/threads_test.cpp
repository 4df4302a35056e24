// SPDX-License-Identifier: BSD-3-Clause
// Different colliders in different threads, each with a space and geoms of its own. What ODE itself
// shares between threads (its mesh cache) is not touched by mesh pairs that a collider answers.
#include <atomic>
#include <thread>

#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

TEST(ApiThreads, TwoCollidersInTwoThreadsGiveTheAnswersOfOne) {
  OdeWorld world;
  struct Task {
    dSpaceID space;
    Pile pile;
    BatchCollider collider;
    std::vector<std::vector<Contacts>> answers{};

    Task(OdeWorld& world, std::uint64_t seed)
        : space(world.space(SpaceKind::Simple)), pile(world, space, 8, seed) {}
    void run(int passes, std::uint64_t seed) {
      answers.clear();
      for (int i = 0; i < passes; ++i) {
        pile.shake(seed + static_cast<std::uint64_t>(i));
        answers.push_back(answers_of(collider.pass(space)));
      }
    }
  };
  constexpr int kPasses = 20;
  Task first(world, 100), second(world, 200);
  first.run(kPasses, 100);
  second.run(kPasses, 200);
  const auto expected_first = first.answers, expected_second = second.answers;
  for (int round = 0; round < 3; ++round) {
    std::thread thread([&] { first.run(kPasses, 100); });
    second.run(kPasses, 200);
    thread.join();
    for (std::size_t i = 0; i < kPasses; ++i) {
      EXPECT_EQ(difference(first.answers[i], expected_first[i]), "") << "pass " << i;
      EXPECT_EQ(difference(second.answers[i], expected_second[i]), "") << "pass " << i;
    }
  }
}

TEST(ApiThreads, CreateAndDestroyCollidersWhileAnotherWorks) {
  OdeWorld world;
  const dSpaceID space = world.space(SpaceKind::Simple);
  Pile pile(world, space, 8, 1);
  const BatchCollider collider;
  std::vector<Collected> expected;
  for (const std::uint64_t seed : {1, 2}) {  // between which each pass has something to compute
    pile.shake(seed);
    expected.push_back(collider.pass(space));
  }
  std::atomic<bool> made = false;
  std::thread thread([&] {
    for (int i = 0; i < 5; ++i) BatchCollider();
    made = true;
  });
  int passes = 0;
  for (; passes < 20 || !made; ++passes) {
    pile.shake(passes % 2 == 0 ? 1 : 2);
    EXPECT_EQ(difference_with_geoms(collider.pass(space), expected[passes % 2 == 0 ? 0 : 1]), "");
    EXPECT_GT(collider.stats().pairs_computed, 0);
  }
  thread.join();
}

TEST(ApiThreads, KeepTheirErrorMessagesApart) {
  dBatchColliderParams params{};
  dBatchColliderCreate(&params);
  const std::string mine = last_error();
  std::string theirs;
  std::thread([&] {
    dBatchColliderParams other;
    dBatchColliderParamsInit(&other);
    other.max_contacts = -5;
    dBatchColliderCreate(&other);
    theirs = last_error();
  }).join();
  EXPECT_EQ(last_error(), mine);
  EXPECT_NE(theirs, mine);
  EXPECT_NE(theirs, "");
}

}  // namespace
}  // namespace ode_ext::test
