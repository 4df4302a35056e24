// SPDX-License-Identifier: BSD-3-Clause
// Who answers dCollide: which collider, ODE's own, and after what.
#include <algorithm>
#include <array>

#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

BatchCollider::Change at_most(int contacts) {
  return [=](dBatchColliderParams& p) { p.max_contacts = contacts; };
}

class ApiOverride : public ::testing::Test {
 protected:
  // Both argument orders of every pair, from ODE itself.
  std::vector<Contacts> stock_answers() {
    std::vector<Contacts> answers;
    for (std::size_t i = 0; i < pile.geoms.size(); ++i) {
      for (std::size_t j = 0; j < pile.geoms.size(); ++j) {
        if (i != j) answers.push_back(collide(pile.geoms[i], pile.geoms[j]));
      }
    }
    return answers;
  }

  OdeWorld world;
  dSpaceID space = world.space(SpaceKind::Simple);
  Pile pile{world, space, 6, 1};
};

TEST_F(ApiOverride, GivesNoContactWhereContactsWouldLieInOneAnother) {
  const BatchCollider collider;
  const dGeomID g1 = world.geom(world.mesh(make_cube(1)), {});
  const dGeomID g2 = world.geom(world.mesh(make_cube(1)), at(0.1, 0.2, 0.9));
  dContactGeom contacts[8];
  EXPECT_GT(dCollide(g1, g2, 8, contacts, sizeof(dContactGeom)), 0);
  EXPECT_EQ(dCollide(g1, g2, 8, contacts, sizeof(dContactGeom) - 1), 0);
  EXPECT_EQ(last_error(), "dCollide: skip is " + std::to_string(sizeof(dContactGeom) - 1) +
                              ", less than sizeof(dContactGeom) = " +
                              std::to_string(sizeof(dContactGeom)) + ": no contact is given");
}

// ODE's own collider is not symmetric in its arguments, so both orders must be right.
TEST_F(ApiOverride, IsUndoneToTheByteWithTheLastCollider) {
  const auto stock = stock_answers();
  BatchCollider first, second;
  first.pass(space);
  EXPECT_NE(difference(stock_answers(), stock), "");
  first.destroy();
  EXPECT_NE(difference(stock_answers(), stock), "");  // one is left
  second.destroy();
  EXPECT_EQ(difference(stock_answers(), stock), "");
}

TEST_F(ApiOverride, IsUndoneWithTheGeomsInODEsOrder) {
  BatchCollider().pass(space);
  for (const dContactGeom& c : collide(pile.geoms[0], pile.geoms[1])) {
    EXPECT_EQ(c.g1, pile.geoms[0]);
    EXPECT_EQ(c.g2, pile.geoms[1]);
  }
}

TEST_F(ApiOverride, ComesBackWithTheNextCollider) {
  const auto stock = stock_answers();
  BatchCollider().pass(space);
  const BatchCollider again;
  EXPECT_NE(difference(stock_answers(), stock), "");
}

// ODE rebuilds its table in dInitODE2 and tells nobody.
TEST_F(ApiOverride, IsSetAgainAtTheNextCallAfterOdeWasRestarted) {
  const BatchCollider collider;
  const auto expected = answers_of(collider.pass(space));
  world.restart();
  const dSpaceID anew = world.space(SpaceKind::Simple);
  const Pile again(world, anew, 6, 1);
  EXPECT_EQ(difference(answers_of(collider.pass(anew)), expected), "");
}

TEST_F(ApiOverride, LeavesOtherClassesToOde) {
  const OdeMesh& torus = world.mesh(make_torus(1, 0.4, 12, 8));
  const dGeomID mesh = world.geom(torus, turned({1, 2, 3}, 1));
  std::array<dGeomID, 6> others{
      world.own(dCreateSphere(nullptr, 0.7)),     world.own(dCreateBox(nullptr, 1, 1, 1)),
      world.own(dCreateCapsule(nullptr, 0.3, 1)), world.own(dCreatePlane(nullptr, 0, 0, 1, 0)),
      world.own(dCreateRay(nullptr, 5)),          world.own(dCreateCylinder(nullptr, 0.4, 1))};
  for (std::size_t i : {0u, 1u, 2u, 4u, 5u}) dGeomSetPosition(others[i], 0.9, 0.1 * double(i), 0);
  const auto ask = [&] {
    std::vector<Contacts> answers;
    for (const dGeomID g : others) {
      answers.push_back(collide(mesh, g));
      answers.push_back(collide(g, mesh));
      for (const dGeomID h : others) {
        if (g != h && g != others[4] && h != others[4]) answers.push_back(collide(g, h));
      }
    }
    return answers;
  };
  const auto stock = ask();
  const BatchCollider collider;
  collider.pass(space);
  EXPECT_EQ(difference(ask(), stock), "");
}

TEST_F(ApiOverride, LetsTheColliderAnswerWhosePassRuns) {
  const BatchCollider one(at_most(1)), many(at_most(16));
  const Collected of_one = one.pass(space), of_many = many.pass(space), again = one.pass(space);
  std::size_t most = 0;
  for (const auto& [pair, contacts] : of_many.contacts) most = std::max(most, contacts.size());
  EXPECT_GT(most, 1u);
  for (const Collected* collected : {&of_one, &again}) {
    EXPECT_GT(collected->total(), 0);
    for (const auto& [pair, contacts] : collected->contacts) EXPECT_LE(contacts.size(), 1u);
  }
}

TEST_F(ApiOverride, LetsTheLatestColliderThatHoldsThePairAnswerAfterThePass) {
  const BatchCollider one(at_most(1)), many(at_most(16));
  const Collected collected = one.pass(space);  // the one created first holds the pairs
  for (const auto& [pair, contacts] : collected.contacts) {
    EXPECT_EQ(difference_with_geoms(collide(pair.first, pair.second), contacts), "");
  }
  EXPECT_EQ(many.stats().pairs_alone, 0);
}

// The later one knows the pair as it was when it last looked.
TEST_F(ApiOverride, LetsTheColliderOfTheLastPassAnswerThoughALaterOneHoldsThePair) {
  const dSpaceID edited = world.space(SpaceKind::Simple);
  OdeMesh& ball = world.mesh(make_icosphere(0.6, 2));
  const dGeomID a = world.geom(world.mesh(make_cube(1)), {}, edited);
  const dGeomID b = world.geom(ball, at(0.1, 0.2, 0.9), edited);
  const BatchCollider first, second;
  second.pass(edited);
  const Contacts before = collide(a, b);
  for (float& coordinate : ball.edit().vertices) coordinate *= 0.9f;
  first.pass(edited);
  EXPECT_EQ(difference(collide(a, b), fresh_answer(a, b)), "");
  EXPECT_NE(difference(collide(a, b), before), "");
}

TEST_F(ApiOverride, LetsTheLatestCreatedAnswerAPairThatNobodyHolds) {
  const BatchCollider one(at_most(1)), many(at_most(16));
  collide(pile.geoms[0], pile.geoms[1]);
  EXPECT_EQ(one.stats().pairs_alone, 0);
  EXPECT_EQ(many.stats().pairs_alone, 1);
}

TEST_F(ApiOverride, PassesToTheRemainingCollider) {
  BatchCollider remaining(at_most(16)), gone(at_most(1));
  const auto expected = answers_of(remaining.pass(space));
  gone.pass(space);
  gone.destroy();
  Collected collected;
  dSpaceCollide(space, &collected, &collect);  // no pass of ours
  EXPECT_EQ(difference(answers_of(collected), expected), "");
}

}  // namespace
}  // namespace ode_ext::test
