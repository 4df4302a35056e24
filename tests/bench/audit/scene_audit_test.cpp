// SPDX-License-Identifier: BSD-3-Clause
#include "bench/audit/scene_audit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "simulation/simulation.h"

namespace ode_ext::audit {
namespace {

// 60 objects on the ground: two frames of the audit that rigid_audit makes of a thousand.
class SceneAuditTest : public ::testing::Test {
 protected:
  SceneAuditTest() {
    dInitODE2(0);
    options_.objects = 60;
    std::vector<std::string> warnings;
    scene_ = std::make_unique<falling_objects::Scene>(falling_objects::make_shapes(), options_,
                                                      warnings);
    collision_ = std::make_unique<falling_objects::Collision>(options_, scene_->space());
    simulation_ =
        std::make_unique<falling_objects::Simulation>(options_, *scene_, *collision_, nullptr);
  }
  ~SceneAuditTest() override {
    simulation_.reset();
    collision_.reset();
    scene_.reset();
    dCloseODE();
  }

  void run(int steps) {
    for (int i = 0; i < steps; ++i) simulation_->step();
  }
  std::vector<dContactGeom> contacts_now() {
    collision_->collide(falling_objects::Collider::kBatch, list_);
    return {list_.contacts().begin(), list_.contacts().end()};
  }

  falling_objects::SimulationSettings options_;
  std::unique_ptr<falling_objects::Scene> scene_;
  std::unique_ptr<falling_objects::Collision> collision_;
  std::unique_ptr<falling_objects::Simulation> simulation_;
  falling_objects::ContactList list_{16};
};

TEST_F(SceneAuditTest, FindsNoPairOverlookedAndNoContactFalse) {
  const SceneAudit audit(*scene_);
  run(90);  // 1.5 s: on the ground, and not yet at rest
  for (int frame = 0; frame < 2; ++frame) {
    run(30);
    const Findings found = audit.look(contacts_now());
    EXPECT_GT(found.intersecting, 40);
    EXPECT_GT(found.in_contact, 40);
    EXPECT_GE(found.regions, found.intersecting);
    EXPECT_EQ(found.overlooked, 0);
    EXPECT_EQ(found.false_contacts, 0);
    EXPECT_LE(found.fragile, found.intersecting / 20);
    const long long colliding = found.intersecting + found.contained;
    EXPECT_LE(std::llabs(found.in_contact + found.edges_only - colliding), found.fragile);
  }
}

TEST_F(SceneAuditTest, SeesContactsThatAreMissingAndContactsThatAreFalse) {
  const SceneAudit audit(*scene_);
  run(120);
  auto contacts = contacts_now();
  const Findings whole = audit.look(contacts);
  const Findings none = audit.look({});
  EXPECT_EQ(none.in_contact, 0);
  EXPECT_GT(none.overlooked, 40);
  EXPECT_EQ(none.intersecting, whole.intersecting);

  // The two objects that are farthest apart.
  dContactGeom wrong{};
  const auto& objects = scene_->objects();
  const auto [lowest, highest] =
      std::minmax_element(objects.begin(), objects.end(), [](const auto& a, const auto& b) {
        return dGeomGetPosition(a.geom)[0] < dGeomGetPosition(b.geom)[0];
      });
  wrong.g1 = lowest->geom;
  wrong.g2 = highest->geom;
  contacts.push_back(wrong);
  EXPECT_EQ(audit.look(contacts).false_contacts, whole.false_contacts + 1);
}

}  // namespace
}  // namespace ode_ext::audit
