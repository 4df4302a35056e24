// SPDX-License-Identifier: BSD-3-Clause
// The modes of a batch: the organizations and workloads give the same bytes, the paper's ways to
// meet a wrong prediction lose what they say they lose.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "collide/collider.h"
#include "support/moving_scene.h"

namespace ode_ext::test {
namespace {

using Bits = std::vector<std::vector<ContactBits>>;

std::uint64_t count(const BatchReport& report, List list) {
  return report.actual[static_cast<std::size_t>(list)];
}

std::vector<TestMesh> all_meshes() {
  std::vector<TestMesh> meshes = small_closed_meshes();
  for (const TestMesh& mesh : smooth_meshes()) meshes.push_back(mesh);
  return meshes;
}

class Organizations : public testing::TestWithParam<Rays> {};

// All modes of the paper find the vertices inside so, and give the same bytes; not those of the
// default, which finds them by crossings.
ColliderOptions by_rays_of_all_vertices() {
  ColliderOptions options;
  options.count_work = true;
  return options;
}

TEST_P(Organizations, GiveTheSameBytes) {
  ColliderOptions options;
  options.rays = GetParam();
  options.count_work = true;  // by rays of all vertices in either
  Collider pipelined(options);
  options.organization = Organization::kMonolithic;
  Collider monolithic(options);
  PassMemory memory, memory_of_monolithic;
  MovingScene moving(all_meshes(), 100, 0.003, 21);
  for (int i = 0; i < 10; ++i, moving.advance()) {
    const Bits expected = bits_of(pipelined.collide(moving.scene(), &memory));
    ASSERT_EQ(bits_of(monolithic.collide(moving.scene(), &memory_of_monolithic)), expected) << i;
    for (const List list :
         {List::kRaysIterative, List::kRays, List::kHits, List::kCrossings, List::kContacts})
      EXPECT_EQ(count(monolithic.report(), list), count(pipelined.report(), list)) << i;
    EXPECT_GT(count(pipelined.report(), List::kCrossings), 1000u);
    EXPECT_EQ(monolithic.report().unproven, pipelined.report().unproven);
    EXPECT_EQ(monolithic.report().dropped, pipelined.report().dropped);
    EXPECT_EQ(count(monolithic.report(), List::kChunks), 0u);  // no list in between
  }
}

TEST_P(Organizations, DoTheSameWork) {
  ColliderOptions options;
  options.rays = GetParam();
  options.count_work = true;
  options.edges = false;  // every vertex is looked at in both
  Collider pipelined(options);
  options.organization = Organization::kMonolithic;
  Collider monolithic(options);
  PassMemory memory, memory_of_monolithic;
  MovingScene moving(smooth_meshes(), 30, 0.003, 22);
  for (int i = 0; i < 4; ++i, moving.advance()) {
    pipelined.collide(moving.scene(), &memory);
    monolithic.collide(moving.scene(), &memory_of_monolithic);
  }
  WorkCount sum;
  for (const WorkCount& work : pipelined.report().work) {
    sum.items += work.items;
    sum.units += work.units;
    sum.lockstep32 += work.lockstep32;
    sum.lockstep64 += work.lockstep64;
    EXPECT_LE(work.units, work.lockstep32);
    EXPECT_LE(work.lockstep32, work.lockstep64);
  }
  const WorkCount& alone =
      monolithic.report().work[static_cast<std::size_t>(CountedKernel::kMonolithic)];
  const auto items = [&](CountedKernel kernel) {
    return pipelined.report().work[static_cast<std::size_t>(kernel)].items;
  };
  const auto chosen_from = items(CountedKernel::kVertexStep);
  // One unit each for the vertices that only the monolithic kernel looks at, to find them dropped.
  EXPECT_EQ(alone.units - (alone.items - chosen_from), sum.units);
  EXPECT_GT(alone.lockstep32, sum.lockstep32);
}

TEST_P(Organizations, WaitForTheDeviceOnceInAStepLikeTheLast) {
  for (const Organization organization : {Organization::kPipelined, Organization::kMonolithic}) {
    ColliderOptions options;
    options.rays = GetParam();
    options.organization = organization;
    Collider collider(options);
    PassMemory memory;
    MovingScene moving(all_meshes(), 60, 0.001, 23);
    for (int i = 0; i < 5; ++i, moving.advance()) collider.collide(moving.scene(), &memory);
    EXPECT_EQ(collider.report().synchronizations, 1);
  }
}

std::string name_of(const testing::TestParamInfo<Rays>& info) {
  if (info.param == Rays::kFull) return "Full";
  return info.param == Rays::kIterative ? "Iterative" : "IterativePaper";
}

INSTANTIATE_TEST_SUITE_P(Rays, Organizations,
                         testing::Values(Rays::kFull, Rays::kIterative, Rays::kIterativePaper),
                         name_of);

TEST(Modes, MeetMeshesWithoutTriangles) {
  MovingScene moving(smooth_meshes(), 20, 0.001, 28);
  TriangleSoup broken = soup_of(make_cube(1));
  broken[0].x = NAN;
  for (const Organization organization : {Organization::kPipelined, Organization::kMonolithic}) {
    ColliderOptions options;
    options.organization = organization;
    options.count_work = true;
    Collider collider(options);
    Collider whole(by_rays_of_all_vertices());
    PassMemory memory;
    collider.collide(moving.scene(), &memory);
    Scene scene = moving.scene();
    // In the place of a mesh that left tasks behind.
    scene.meshes[1] = std::make_shared<const Mesh>(build_mesh(broken));
    ASSERT_FALSE(scene.meshes[1]->finite);
    EXPECT_EQ(bits_of(collider.collide(scene, &memory)), bits_of(whole.collide(scene, nullptr)));
  }
}

TEST(Modes, LoseNothingToAnyDisplacementLimit) {
  MovingScene moving(smooth_meshes(), 20, 0.001, 29);
  Collider whole(by_rays_of_all_vertices());
  for (const float limit : {0.0f, std::numeric_limits<float>::max()}) {
    for (const Rays rays : {Rays::kFull, Rays::kIterative}) {
      ColliderOptions options;
      options.displacement_limit = limit;
      options.rays = rays;
      options.count_work = true;
      Collider collider(options);
      PassMemory memory;
      const Bits expected = bits_of(whole.collide(moving.scene(), nullptr));
      EXPECT_EQ(bits_of(collider.collide(moving.scene(), nullptr)), expected);
      for (int i = 0; i < 2; ++i)
        EXPECT_EQ(bits_of(collider.collide(moving.scene(), &memory)), expected);
    }
  }
}

TEST(Misprediction, IgnoredLosesWhatWasNotPredictedAndSaysHowMuch) {
  ColliderOptions options;
  options.misprediction = Misprediction::kIgnore;
  options.rays = Rays::kFull;
  options.confidence = 1.0;
  options.prediction = PredictionRule::kPlain;
  Collider ignoring(options);
  Collider whole(by_rays_of_all_vertices());
  PassMemory memory;
  MovingScene moving(smooth_meshes(), 40, 0, 24);
  const auto all = moving.scene().pairs;
  moving.scene().pairs.resize(20);
  const Bits first = bits_of(whole.collide(moving.scene(), nullptr));
  EXPECT_EQ(bits_of(ignoring.collide(moving.scene(), &memory)), first);  // nothing was predicted
  EXPECT_EQ(ignoring.report().missed, 0u);
  EXPECT_EQ(bits_of(ignoring.collide(moving.scene(), &memory)), first);  // right to the last entry
  EXPECT_EQ(ignoring.report().missed, 0u);

  moving.scene().pairs = all;
  const std::size_t contacts = whole.collide(moving.scene(), nullptr).contacts.size();
  const PairContacts& found = ignoring.collide(moving.scene(), &memory);
  EXPECT_LT(found.contacts.size(), contacts);
  EXPECT_EQ(found.ranges.size(), 40u);
  std::uint64_t missed = 0;
  const BatchReport& report = ignoring.report();
  for (std::size_t i = 0; i < kListCount; ++i)
    if (report.actual[i] > report.predicted[i]) missed += report.actual[i] - report.predicted[i];
  EXPECT_EQ(report.missed, missed);
  EXPECT_GT(missed, 0u);
  EXPECT_EQ(report.redone, 0);
}

TEST(Misprediction, IsOfNoListThatTheMonolithicOrganizationDoesNotHave) {
  ColliderOptions options;
  options.organization = Organization::kMonolithic;
  options.misprediction = Misprediction::kIgnore;
  options.rays = Rays::kFull;
  options.prediction = PredictionRule::kPlain;
  options.confidence = 4.0;  // enough for hits and contacts of four times as many pairs
  Collider collider(options);
  Collider whole(by_rays_of_all_vertices());
  PassMemory memory;
  MovingScene moving(smooth_meshes(), 40, 0, 27);
  const auto all = moving.scene().pairs;
  moving.scene().pairs.resize(12);
  collider.collide(moving.scene(), &memory);
  moving.scene().pairs = all;
  memory.history.counts[static_cast<std::size_t>(List::kRays)] = 1;  // of a list that it lacks
  EXPECT_EQ(bits_of(collider.collide(moving.scene(), &memory)),
            bits_of(whole.collide(moving.scene(), nullptr)));
  EXPECT_EQ(collider.report().missed, 0u);
}

TEST(Misprediction, ScaledByThePairsLosesLessWhereTheirNumberGrows) {
  std::array<std::uint64_t, 2> missed{};
  for (const PredictionRule rule : {PredictionRule::kPairScaled, PredictionRule::kPlain}) {
    ColliderOptions options;
    options.misprediction = Misprediction::kIgnore;
    options.rays = Rays::kFull;
    options.confidence = 1.02;
    options.prediction = rule;
    Collider collider(options);
    PassMemory memory;
    MovingScene moving(smooth_meshes(), 100, 0, 25);
    const auto all = moving.scene().pairs;
    for (std::size_t pairs = 20; pairs <= 100; pairs += 5) {
      moving.scene().pairs.assign(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(pairs));
      collider.collide(moving.scene(), &memory);
      missed[static_cast<std::size_t>(rule)] += collider.report().missed;
    }
  }
  EXPECT_LT(2 * missed[0], missed[1]);
}

TEST(Misprediction, BacktrackedDeliversNothingAndMakesRoom) {
  ColliderOptions options;
  options.misprediction = Misprediction::kBacktrack;
  options.prediction = PredictionRule::kPlain;
  options.initial_capacity = 1;
  options.confidence = 1.0;
  options.rays = Rays::kFull;
  Collider collider(options);
  Collider whole(by_rays_of_all_vertices());
  PassMemory memory;
  MovingScene moving(smooth_meshes(), 40, 0, 26);
  const auto all = moving.scene().pairs;
  moving.scene().pairs.resize(5);
  collider.collide(moving.scene(), &memory);
  EXPECT_FALSE(collider.report().backtracked);  // nothing was predicted

  moving.scene().pairs = all;
  const Bits expected = bits_of(whole.collide(moving.scene(), nullptr));
  int backtracked = 0;
  while (collider.collide(moving.scene(), &memory).ranges.empty()) {
    EXPECT_TRUE(collider.report().backtracked);
    ASSERT_LT(++backtracked, 5);  // one for every list that was too small, at most
  }
  EXPECT_GT(backtracked, 0);
  EXPECT_EQ(bits_of(collider.collide(moving.scene(), &memory)), expected);
}

}  // namespace
}  // namespace ode_ext::test
