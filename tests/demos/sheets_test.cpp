// SPDX-License-Identifier: BSD-3-Clause
// Sheets and the collider together, in a scene small enough for a test.
#include "simulation/sheets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "judging/draping.h"
#include "simulation/collision.h"
#include "simulation/simulation.h"

namespace falling_objects {
namespace {

class DemoSheets : public testing::Test {
 protected:
  static void SetUpTestSuite() { dInitODE2(0); }
  static void TearDownTestSuite() { dCloseODE(); }
  static SimulationSettings one_sheet() {
    SimulationSettings options;
    options.objects = 4;
    options.sheets = 1;
    return options;
  }
  Cloth& cloth() { return sheets_.all()[0]->cloth(); }
  void SetUp() override { sheets_.introduce(collision_.batch()); }
  // Level, its middle where the object's is.
  void put_on_object(std::size_t object, double higher) {
    const dReal* at = dBodyGetPosition(scene_.objects()[object].body);
    const Vector move =
        Vector{at[0], at[1], at[2] + higher} - cloth().positions()[cloth().middle()];
    for (Vector& p : cloth().positions()) p = p + move;
  }

  SimulationSettings options_ = one_sheet();
  std::vector<std::string> warnings_;
  Scene scene_{make_shapes(), options_, warnings_};
  Collision collision_{options_, scene_.space()};
  Sheets sheets_{1, 1, scene_};
  DrapingMeter meter_{scene_, sheets_.all()};
};

TEST_F(DemoSheets, StayInTheBoxThatOdeTookOfThem) {
  const std::vector<Vector> level = cloth().positions();
  const Vector middle = level[cloth().middle()];
  const double sine = std::sqrt(0.5);
  for (const double stretch : {1.0, 1.09}) {
    for (std::size_t i = 0; i < level.size(); ++i) {  // upright, a diagonal along z
      const Vector p = stretch * (level[i] - middle);
      cloth().positions()[i] = Vector{7, sine * (p.x - p.y), sine * (p.x + p.y)};
    }
    sheets_.show(1.0 / 60);
    dReal box[6];
    dGeomGetAABB(sheets_.all()[0]->geom(), box);
    for (std::size_t i = 0; i < level.size(); ++i) {
      const Vector p = sheets_.all()[0]->seen(i);
      EXPECT_TRUE(box[0] <= p.x && p.x <= box[1] && box[2] <= p.y && p.y <= box[3] &&
                  box[4] <= p.z && p.z <= box[5]);
    }
  }
  sheets_.step(1.0 / 60, {});
  Simulation simulation(options_, scene_, collision_, &sheets_);
  EXPECT_EQ(simulation.step().status & dBatchStatusMeshLeftBox, 0u);
}

TEST_F(DemoSheets, AreMeasuredInsideAndAcrossAnObject) {
  EXPECT_EQ(meter_.measure().deepest, 0);
  EXPECT_EQ(meter_.measure().crossing, 0);
  EXPECT_EQ(meter_.measure().triangles, 8192);
  put_on_object(2, 0);  // the jack: thick in its middle
  const Draping draping = meter_.measure();
  EXPECT_GT(draping.deepest, 0.05);
  EXPECT_GT(draping.inside, 10);
  EXPECT_GT(draping.crossing, 10);
  EXPECT_LT(draping.crossing, 8192 / 4);
}

TEST_F(DemoSheets, ComeToRestOnObjectsThatAreAtRestAndInNone) {
  Simulation simulation(options_, scene_, collision_, &sheets_);
  double fastest = 0;
  for (int step = 0; step < 450; ++step) {
    const StepRecord record = simulation.step();
    if (step >= 420) fastest = std::max(fastest, record.fastest_vertex);
  }
  const Draping draping = meter_.measure();
  EXPECT_EQ(draping.inside, 0);
  EXPECT_LE(draping.crossing_share(), kTrianglesMayCross);
  EXPECT_LT(fastest, kVertexMayMove);
  // It lies on something: it neither fell through nor hangs in the air.
  EXPECT_GT(simulation.contacts().size(), 100u);
}

TEST_F(DemoSheets, WakeWhenWhatTheyLieOnMoves) {
  Simulation simulation(options_, scene_, collision_, &sheets_);
  for (int step = 0; step < 330; ++step) simulation.step();
  ASSERT_LT(sheets_.fastest(), kVertexMayMove);
  // The one that most of it lies on: another may touch it in passing.
  std::map<std::size_t, int> contacts_with;
  for (const dContactGeom& contact : simulation.contacts()) {
    const std::size_t lower = std::min(index_of(contact.g1), index_of(contact.g2));
    const std::size_t upper = std::max(index_of(contact.g1), index_of(contact.g2));
    if (upper > scene_.objects().size() && lower < scene_.objects().size()) ++contacts_with[lower];
  }
  ASSERT_FALSE(contacts_with.empty());
  const std::size_t touched =
      std::max_element(contacts_with.begin(), contacts_with.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; })
          ->first;
  const dBodyID body = scene_.objects()[touched].body;
  dBodyEnable(body);
  dBodySetLinearVel(body, 0, 0, 3);
  const std::vector<Vector> before = cloth().positions();
  const double body_before = dBodyGetPosition(body)[2];
  double lifted = 0;
  for (int step = 0; step < 10; ++step) simulation.step();
  const double rise = dBodyGetPosition(body)[2] - body_before;
  for (std::size_t i = 0; i < before.size(); ++i) {
    lifted = std::max(lifted, cloth().positions()[i].z - before[i].z);
  }
  // It follows the body, which what lies on it holds back; asleep it would not move at all.
  EXPECT_GT(rise, 0.05);
  EXPECT_GT(lifted, rise);
}

TEST_F(DemoSheets, PushAnObjectThatTheyFallOn) {
  const dBodyID body = scene_.objects()[2].body;
  dWorldSetGravity(scene_.world(), 0, 0, 0);
  dBodySetPosition(body, 0, 0, 5);
  for (std::size_t i = 0; i < 4; ++i) {
    if (i != 2) dBodySetPosition(scene_.objects()[i].body, 5.0 * static_cast<double>(i), 8, 5);
  }
  put_on_object(2, 0.6);
  Simulation simulation(options_, scene_, collision_, &sheets_);
  for (int step = 0; step < 60; ++step) simulation.step();
  EXPECT_LT(dBodyGetLinearVel(body)[2], -0.01);
}

}  // namespace
}  // namespace falling_objects
