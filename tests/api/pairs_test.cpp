// SPDX-License-Identifier: BSD-3-Clause
// dBatchColliderCollidePairs.
#include <cstring>

#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

constexpr int kSkip = sizeof(dContactGeom);

class ApiCollidePairs : public ::testing::Test {
 protected:
  ApiCollidePairs() {
    for (std::size_t i = 0; i < pile.geoms.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        pairs.insert(pairs.end(), {pile.geoms[i], pile.geoms[j]});
      }
    }
  }
  int count() const { return static_cast<int>(pairs.size() / 2); }

  OdeWorld world;
  Pile pile{world, nullptr, 6, 1};
  std::vector<dGeomID> pairs;
  BatchCollider collider;
};

TEST_F(ApiCollidePairs, GivesEachPairItsContactsAtItsPlace) {
  constexpr int limit = 12;
  Contacts contacts(static_cast<std::size_t>(limit * count()));
  std::vector<int> counts(static_cast<std::size_t>(count()), -1);
  const int total = dBatchColliderCollidePairs(collider, pairs.data(), count(), limit,
                                               contacts.data(), kSkip, counts.data());
  ASSERT_GT(total, 0) << last_error();
  int sum = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    sum += counts[i];
    const auto start = contacts.begin() + static_cast<long>(i) * limit;
    EXPECT_EQ(difference_with_geoms(Contacts(start, start + counts[i]),
                                    fresh_answer(pairs[2 * i], pairs[2 * i + 1], limit)),
              "");
  }
  EXPECT_EQ(sum, total);
}

TEST_F(ApiCollidePairs, WritesOnlyTheReturnedContacts) {
  constexpr int limit = 12;
  Contacts contacts(static_cast<std::size_t>(limit * count() + 1));
  std::memset(static_cast<void*>(contacts.data()), 0xAB, contacts.size() * sizeof(dContactGeom));
  const Contacts untouched = contacts;
  std::vector<int> counts(static_cast<std::size_t>(count()));
  ASSERT_GT(dBatchColliderCollidePairs(collider, pairs.data(), count(), limit, contacts.data(),
                                       kSkip, counts.data()),
            0);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const std::size_t pair = i / limit, place = i % limit;
    if (pair < counts.size() && place < static_cast<std::size_t>(counts[pair])) continue;
    EXPECT_EQ(std::memcmp(&contacts[i], &untouched[i], sizeof(dContactGeom)), 0) << i;
  }
}

TEST_F(ApiCollidePairs, KeepsToALargerStride) {
  constexpr int limit = 4;
  std::vector<dContact> contacts(static_cast<std::size_t>(limit * count()));
  std::memset(static_cast<void*>(contacts.data()), 0xAB, contacts.size() * sizeof(dContact));
  const auto untouched = contacts;
  Contacts packed(contacts.size());
  std::vector<int> counts(static_cast<std::size_t>(count()));
  const int total = dBatchColliderCollidePairs(collider, pairs.data(), count(), limit,
                                               packed.data(), kSkip, counts.data());
  ASSERT_EQ(dBatchColliderCollidePairs(collider, pairs.data(), count(), limit, &contacts[0].geom,
                                       sizeof(dContact), nullptr),
            total);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    EXPECT_EQ(std::memcmp(&contacts[i].surface, &untouched[i].surface, sizeof(dSurfaceParameters)),
              0);
    if (i % limit < static_cast<std::size_t>(counts[i / limit])) {
      EXPECT_EQ(difference_with_geoms(Contacts{contacts[i].geom}, Contacts{packed[i]}), "");
    }
  }
}

TEST_F(ApiCollidePairs, IgnoresBitsBodiesAndEnabledAsDCollideDoes) {
  const auto [g1, g2] = std::pair(pairs[0], pairs[1]);
  const Contacts expected = fresh_answer(g1, g2);
  dGeomDisable(g1);
  dGeomSetCollideBits(g2, 0);
  EXPECT_EQ(difference_with_geoms(fresh_answer(g1, g2), expected), "");
}

TEST_F(ApiCollidePairs, OfTheSamePairTwiceAndInBothOrdersAgree) {
  const dGeomID repeated[] = {pairs[0], pairs[1], pairs[1], pairs[0], pairs[0], pairs[1]};
  Contacts contacts(3 * 16);
  int counts[3] = {};
  ASSERT_GE(dBatchColliderCollidePairs(collider, repeated, 3, 16, contacts.data(), kSkip, counts),
            0);
  const auto part = [&](int i) {
    const auto start = contacts.begin() + 16 * i;
    return Contacts(start, start + counts[i]);
  };
  EXPECT_EQ(difference_with_geoms(part(0), part(2)), "");
  EXPECT_EQ(difference_with_geoms(part(1), flipped(part(0))), "");
}

TEST_F(ApiCollidePairs, OfNoPairsIsZero) {
  dContactGeom contact;
  EXPECT_EQ(dBatchColliderCollidePairs(collider, pairs.data(), 0, 1, &contact, kSkip, nullptr), 0);
}

TEST_F(ApiCollidePairs, AnswersLaterQuestions) {
  Contacts contacts(16);
  ASSERT_GE(
      dBatchColliderCollidePairs(collider, pairs.data(), 1, 16, contacts.data(), kSkip, nullptr),
      0);
  collide(pairs[0], pairs[1]);
  EXPECT_EQ(collider.stats().pairs_alone, 0);
}

// A collider of 0 means plain ODE, so that a program whose Create failed goes on.
TEST_F(ApiCollidePairs, WithAColliderOfZeroAreWhatOdeAnswers) {
  collider.destroy();
  Contacts contacts(32);
  int counts[2] = {};
  const int total =
      dBatchColliderCollidePairs(nullptr, pairs.data(), 2, 16, contacts.data(), kSkip, counts);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto start = contacts.begin() + 16 * static_cast<long>(i);
    EXPECT_EQ(difference_with_geoms(Contacts(start, start + counts[i]),
                                    collide(pairs[2 * i], pairs[2 * i + 1], 16)),
              "");
  }
  EXPECT_EQ(total, counts[0] + counts[1]);
  EXPECT_GT(total, 0);
}

class ApiCollidePairsRefuses : public ApiCollidePairs {
 protected:
  void TearDown() override {
    EXPECT_NE(last_error(), "");
    EXPECT_EQ(counts[0], -7) << "nothing may be written";
  }
  dContactGeom contacts[4];
  int counts[4] = {-7, -7, -7, -7};
};

TEST_F(ApiCollidePairsRefuses, NoPairsArray) {
  EXPECT_EQ(dBatchColliderCollidePairs(collider, nullptr, 1, 4, contacts, kSkip, counts), -1);
}
TEST_F(ApiCollidePairsRefuses, ANegativePairCount) {
  EXPECT_EQ(dBatchColliderCollidePairs(collider, pairs.data(), -1, 4, contacts, kSkip, counts), -1);
}
TEST_F(ApiCollidePairsRefuses, NoContactsArray) {
  EXPECT_EQ(dBatchColliderCollidePairs(collider, pairs.data(), 1, 4, nullptr, kSkip, counts), -1);
}
TEST_F(ApiCollidePairsRefuses, ALimitOfZero) {
  EXPECT_EQ(dBatchColliderCollidePairs(collider, pairs.data(), 1, 0, contacts, kSkip, counts), -1);
}
TEST_F(ApiCollidePairsRefuses, AStrideBelowTheSizeOfAContact) {
  EXPECT_EQ(dBatchColliderCollidePairs(collider, pairs.data(), 1, 4, contacts, kSkip - 1, counts),
            -1);
}
TEST_F(ApiCollidePairsRefuses, AGeomOfZero) {
  pairs[1] = nullptr;
  EXPECT_EQ(dBatchColliderCollidePairs(collider, pairs.data(), 1, 4, contacts, kSkip, counts), -1);
}
TEST_F(ApiCollidePairsRefuses, AGeomThatIsNoMesh) {
  pairs[3] = world.own(dCreateSphere(nullptr, 1));
  EXPECT_EQ(dBatchColliderCollidePairs(collider, pairs.data(), 2, 2, contacts, kSkip, counts), -1);
}

// So many cubes and as many more, each of the former with each of the latter.
class ApiManyPairs : public ::testing::Test {
 public:  // callbacks, plain functions, use it too
  void make(std::size_t half, const TestPose& pose = {}) {
    for (std::size_t i = 0; i < 2 * half; ++i) geoms.push_back(world.geom(cube, pose));
    move();
    for (std::size_t i = 0; i < half; ++i)
      for (std::size_t k = half; k < 2 * half; ++k) pairs.insert(pairs.end(), {geoms[i], geoms[k]});
    contacts.resize(pairs.size() / 2);
  }
  void ask() {
    dBatchColliderCollidePairs(collider, pairs.data(), static_cast<int>(contacts.size()), 1,
                               contacts.data(), kSkip, nullptr);
  }
  void move() {
    ++moves;
    for (std::size_t i = 0; i < geoms.size(); ++i)
      dGeomSetPosition(geoms[i], 0.01 * static_cast<double>(i) + 1e-4 * moves, 0, 0);
  }
  // Pairs computed one by one so far, a pair more than before if this one is not known.
  long long alone_after_asking() {
    EXPECT_FALSE(collide(kept[0], kept[1]).empty());
    return collider.stats().pairs_alone;
  }
  void ask_for_moved(int calls) {
    for (int i = 0; i < calls; ++i) {
      move();
      ask();
    }
  }

  OdeWorld world;
  OdeMesh& cube = world.mesh(make_cube(1));
  const dGeomID kept[2] = {world.geom(cube, {}), world.geom(cube, at(0.9, 0, 0))};
  std::vector<dGeomID> geoms, pairs;
  Contacts contacts;
  int moves = 0;
  BatchCollider collider;
};

// What passes do not age is bounded all the same: those without meshes keep nothing.
TEST_F(ApiManyPairs, AreForgottenBetweenPassesWithoutMeshes) {
  make(40);
  const dSpaceID empty = world.space(SpaceKind::Simple);
  const auto ask_between_passes = [&](int calls) {
    for (int i = 0; i < calls; ++i) {
      ask_for_moved(1);
      ASSERT_EQ(collider.stats().pairs_computed, 1600);
      collider.pass(empty);
    }
  };
  const long long alone = alone_after_asking();
  ask_between_passes(20);
  EXPECT_EQ(alone_after_asking(), alone) << "it is kept";
  ask_between_passes(25);
  EXPECT_EQ(alone_after_asking(), alone + 1) << "it is not";
}

// As of a program of which the spaces hold boxes that stand for meshes.
TEST_F(ApiManyPairs, AreForgottenThatPassesWithoutMeshesAskFor) {
  make(40);
  const dSpaceID boxes = world.space(SpaceKind::Simple);
  for (int i = 0; i < 2; ++i) world.own(dCreateBox(boxes, 1, 1, 1));
  const auto pass = [&](int calls) {
    const auto callback = [](void* data, dGeomID, dGeomID) {
      static_cast<ApiManyPairs*>(data)->ask_for_moved(1);
    };
    for (int i = 0; i < calls; ++i)
      ASSERT_EQ(dBatchColliderSpaceCollide(collider, boxes, this, callback), 1);
  };
  const long long alone = alone_after_asking();
  pass(20);
  EXPECT_EQ(alone_after_asking(), alone) << "it is kept";
  pass(25);
  EXPECT_EQ(alone_after_asking(), alone + 1) << "it is not";
}

// Nothing of them is computed, and they are known all the same.
TEST_F(ApiManyPairs, OfWhichNothingCanBeComputedAreForgottenToo) {
  TestPose skewed;
  skewed.rotation[0] = 2;
  make(40, skewed);
  const long long alone = alone_after_asking();
  ask_for_moved(45);
  EXPECT_EQ(collider.stats().pairs_computed, 0);
  EXPECT_EQ(alone_after_asking(), alone + 1);
}

// Eight times as many as are asked for at once are kept, and a question for one changes nothing.
TEST_F(ApiManyPairs, AreKeptWhereAsManyAreAskedForAtOnce) {
  make(100);
  const long long alone = alone_after_asking();
  ask_for_moved(7);
  EXPECT_EQ(alone_after_asking(), alone);
  ask();
  EXPECT_EQ(collider.stats().pairs_computed, 0);
  ask_for_moved(3);
  EXPECT_EQ(alone_after_asking(), alone + 1);
}

TEST_F(ApiManyPairs, ThatRestAreKeptHoweverOftenTheyAreAskedFor) {
  make(40);
  for (int call = 0; call < 50; ++call) {
    ask();
    ASSERT_EQ(collider.stats().pairs_computed, call == 0 ? 1600 : 0) << call;
  }
}

}  // namespace
}  // namespace ode_ext::test
