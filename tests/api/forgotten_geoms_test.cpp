// SPDX-License-Identifier: BSD-3-Clause
// Geoms that no pass met for a while are forgotten, some passes before or after the answers that
// are of them: whatever the phase, what comes back gets the contacts of a collider that never knew.
#include "support/batch_collider.h"
#include "support/sanitizers.h"

namespace ode_ext::test {
namespace {

class ApiForgottenGeoms : public ::testing::Test {
 protected:
  // A pass, and nothing of the geom met.
  void pass_without(dGeomID geom) {
    dGeomDisable(geom);
    collider.pass(space);
    dGeomEnable(geom);
  }
  Contacts answer_in_pass() {
    const Collected collected = collider.pass(space);
    for (const auto& [pair, contacts] : collected.contacts)
      if ((pair.first == a && pair.second == b) || (pair.first == b && pair.second == a))
        return pair.first == a ? contacts : flipped(contacts);
    return {};
  }

  OdeWorld world;
  dSpaceID space = world.space(SpaceKind::Simple);
  OdeMesh& cube = world.mesh(make_cube(1));
  OdeMesh& ball = world.mesh(make_icosphere(0.6, 2));
  dGeomID a = world.geom(cube, {}, space);
  dGeomID b = world.geom(cube, at(0.1, 0.2, 0.9), space);
  dGeomID rest = world.geom(ball, at(9, 0, 0), space);  // a pass of one mesh looks at nothing
  dGeomID beside = world.geom(ball, at(9.8, 0, 0), space);
  BatchCollider collider;
};

TEST_F(ApiForgottenGeoms, GetTheirContactsWhenTheyComeBack) {
  const Contacts expected = fresh_answer(a, b);
  ASSERT_GE(expected.size(), 4u);
  for (int round = 0; round < 16; ++round)
    for (int gap = 7; gap < 18; ++gap) {
      ASSERT_EQ(difference_with_geoms(answer_in_pass(), expected), "") << round << " " << gap;
      for (int i = 0; i < gap; ++i) pass_without(b);
    }
}

TEST_F(ApiForgottenGeoms, GetThoseOfWhatIsAtTheirPlaceNow) {
  const Contacts of_cube = fresh_answer(a, b);
  bool was_reused = false;
  for (int gap = 0; gap < 18; ++gap) {
    ASSERT_EQ(difference(answer_in_pass(), of_cube), "") << gap;
    const dGeomID before = b;
    for (int i = 0; i < gap; ++i) pass_without(b);
    world.destroy(b);
    b = world.geom(ball, at(0.1, 0.2, 0.9), space);
    was_reused = was_reused || b == before;
    ASSERT_EQ(difference(answer_in_pass(), fresh_answer(a, b)), "") << gap;
    world.destroy(b);
    b = world.geom(cube, at(0.1, 0.2, 0.9), space);
  }
  // AddressSanitizer holds back what was freed, to see who still uses it: here that is looked for.
  EXPECT_TRUE(was_reused || ODE_EXT_ADDRESS_SANITIZER) << "the allocator gave no address twice";
}

TEST_F(ApiForgottenGeoms, GetTheirContactsOutsideOfPassesToo) {
  const Contacts expected = fresh_answer(a, b);
  for (int gap = 0; gap < 30; ++gap) {
    ASSERT_EQ(difference_with_geoms(answer_of(collider, a, b), expected), "") << gap;
    for (int i = 0; i < gap; ++i) pass_without(b);
    ASSERT_EQ(difference_with_geoms(collide(a, b), expected), "") << gap;
  }
}

}  // namespace
}  // namespace ode_ext::test
