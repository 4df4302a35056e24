// SPDX-License-Identifier: BSD-3-Clause
// A mesh on its own copy: nothing but the handles tells the two apart.
#include <gtest/gtest.h>

#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

class ApiCoincident : public testing::Test {
 protected:
  OdeWorld world_;
  dSpaceID space_ = world_.space(SpaceKind::Simple);
  const OdeMesh& mesh_ = world_.mesh(make_l(1));
  const TestPose pose_ = turned({1, 2, 3}, 0.5, {1, 2, 3});
  const dGeomID g1_ = world_.geom(mesh_, pose_, space_);
  const dGeomID g2_ = world_.geom(mesh_, pose_, space_);
};

TEST_F(ApiCoincident, CopiesHaveContacts) { EXPECT_FALSE(fresh_answer(g1_, g2_).empty()); }

TEST_F(ApiCoincident, CopiesAreAnsweredAlikeAloneAndInABatchAndInBothOrders) {
  Contacts in_a_batch;
  {
    const BatchCollider collider;
    collider.pass(space_);
    in_a_batch = collide(g1_, g2_);
  }
  EXPECT_EQ(difference(fresh_answer(g1_, g2_), in_a_batch), "");
  EXPECT_EQ(difference(flipped(fresh_answer(g2_, g1_)), in_a_batch), "");
  const BatchCollider collider;  // asked before any pass, through the override
  EXPECT_EQ(difference(flipped(collide(g2_, g1_)), in_a_batch), "");
}

}  // namespace
}  // namespace ode_ext::test
