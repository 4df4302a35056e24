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

TEST(ApiThreads, AskTheColliderOfTheirOwnPassesOutsideOfThem) {
  OdeWorld world;
  const dSpaceID space = world.space(SpaceKind::Simple);
  const Pile pile(world, space, 8, 1);
  const BatchCollider first, second;
  first.pass(space);
  const OdeMesh& cube = world.mesh(make_cube(1));
  const dGeomID a = world.geom(cube, {}), b = world.geom(cube, at(0.1, 0.2, 0.9));
  EXPECT_FALSE(collide(a, b).empty());
  EXPECT_EQ(dBatchColliderGetCount(first, dBatchCounterPairsAlone), 1);
  EXPECT_EQ(dBatchColliderGetCount(second, dBatchCounterPairsAlone), 0);
  std::thread([&] {  // this one made no pass: the latest created answers
    const dGeomID c = world.geom(cube, at(0.1, 0.2, 0.8));
    EXPECT_FALSE(collide(a, c).empty());
  })
      .join();
  EXPECT_EQ(dBatchColliderGetCount(second, dBatchCounterPairsAlone), 1);
}

// Another thread's pass may go on for long; this one makes none.
TEST(ApiThreads, OutsideOfPassesSeeMeshesAsTheyAreWhileAnotherPasses) {
  struct Bystander {
    OdeWorld world{};
    OdeMesh& mesh = world.mesh(make_cube(1));
    dGeomID a = world.geom(mesh, {});
    dGeomID b = world.geom(world.mesh(make_cube(1)), at(0.1, 0.2, 0.9));
    Contacts before{}, after{}, in_pass{};
  } bystander;
  const dSpaceID space = bystander.world.space(SpaceKind::Simple);
  const OdeMesh& ball = bystander.world.mesh(make_icosphere(0.6, 1));
  bystander.world.geom(ball, {}, space);
  bystander.world.geom(ball, at(0.5, 0, 0), space);
  const BatchCollider collider;
  const auto callback = [](void* data, dGeomID o1, dGeomID o2) {
    auto& c = *static_cast<Bystander*>(data);
    std::thread([&] {
      c.before = collide(c.a, c.b);
      for (auto& coordinate : c.mesh.edit().vertices) coordinate *= 0.1f;
      dGeomTriMeshDataUpdate(c.mesh.id());
      c.after = collide(c.a, c.b);
    }).join();
    c.in_pass = collide(o1, o2);
  };
  ASSERT_EQ(dBatchColliderSpaceCollide(collider, space, &bystander, callback), 1);
  EXPECT_FALSE(bystander.before.empty());
  EXPECT_TRUE(bystander.after.empty());
  EXPECT_FALSE(bystander.in_pass.empty());
  EXPECT_EQ(collider.stats().pairs_alone, 2);  // none of those of the pass was asked for again
}

TEST(ApiThreads, HaveAChangedMeshAnnouncedToWhicheverColliderAnswers) {
  OdeWorld world;
  OdeMesh& mesh = world.mesh(make_cube(1));
  const dGeomID a = world.geom(mesh, {});
  const dGeomID b = world.geom(world.mesh(make_cube(1)), at(0.1, 0.2, 0.9));
  const BatchCollider told, other;  // the latter answers
  const Contacts before = collide(a, b);
  ASSERT_FALSE(before.empty());
  for (auto& coordinate : mesh.edit().vertices) coordinate *= 0.8f;
  dBatchColliderTriMeshDataUpdate(told, mesh.id());
  EXPECT_NE(difference(collide(a, b), before), "");
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
