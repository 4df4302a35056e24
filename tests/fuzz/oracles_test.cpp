// SPDX-License-Identifier: BSD-3-Clause
// An oracle that cannot fail says nothing: each is shown what it must flag.
#include "fuzz/oracles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fuzz/decode_mesh.h"

namespace ode_ext::fuzz {
namespace {

using namespace test;

const dGeomID kFirst = reinterpret_cast<dGeomID>(1), kSecond = reinterpret_cast<dGeomID>(2);

dContactGeom sound_contact() {
  dContactGeom c{};
  c.normal[2] = 1;
  c.depth = 0.25;
  c.g1 = kFirst;
  c.g2 = kSecond;
  c.side1 = 11;
  return c;
}

std::string malformed(const dContactGeom& contact) {
  return fuzz::malformed({&contact, 1}, {kFirst, 12}, {kSecond, 1});
}

TEST(FuzzOracles, TakeASoundContact) { EXPECT_EQ(malformed(sound_contact()), ""); }

TEST(FuzzOracles, FlagEveryFieldThatIsNotAsPromised) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::function<void(dContactGeom&)> mistakes[] = {
      [&](dContactGeom& c) { c.pos[1] = nan; },    [&](dContactGeom& c) { c.pos[2] = HUGE_VAL; },
      [&](dContactGeom& c) { c.normal[0] = nan; }, [](dContactGeom& c) { c.normal[2] = 1.00001; },
      [](dContactGeom& c) { c.normal[2] = 0; },    [](dContactGeom& c) { c.depth = -1e-12; },
      [&](dContactGeom& c) { c.depth = nan; },     [](dContactGeom& c) { c.depth = HUGE_VAL; },
      [](dContactGeom& c) { c.g1 = kSecond; },     [](dContactGeom& c) { c.g2 = kFirst; },
      [](dContactGeom& c) { c.side1 = 12; },       [](dContactGeom& c) { c.side2 = -1; }};
  for (std::size_t i = 0; i < std::size(mistakes); ++i) {
    dContactGeom contact = sound_contact();
    mistakes[i](contact);
    EXPECT_NE(malformed(contact), "") << i;
  }
}

// Two meshes and what untrue() says of them.
struct Case {
  Case(TestMesh first, const TestPose& first_pose, TestMesh second, const TestPose& second_pose)
      : a(std::move(first)),
        b(std::move(second)),
        surface_a(a),
        surface_b(b),
        pose_a(first_pose),
        pose_b(second_pose) {}
  std::string untrue(bool has_contact) {
    return fuzz::untrue({a, tame(a) ? &surface_a : nullptr, solid, pose_a},
                        {b, tame(b) ? &surface_b : nullptr, solid, pose_b}, has_contact, tally);
  }

  TestMesh a, b;
  FclSurface surface_a, surface_b;
  TestPose pose_a, pose_b;
  bool solid = true;
  Tally tally;
};

TEST(FuzzOracles, FlagSurfacesThatIntersectWithoutAContact) {
  Case overlap(make_cube(1), {}, make_cube(1), at(0.5, 0.25, 0.125));
  EXPECT_NE(overlap.untrue(false), "");
  EXPECT_EQ(overlap.untrue(true), "");
  EXPECT_EQ(overlap.tally.colliding, 1);
}

TEST(FuzzOracles, FlagAMeshInsideAnotherWithoutAContact) {
  Case inside(make_cube(1), {}, make_cube(0.25), at(0.125, 0, 0));
  EXPECT_NE(inside.untrue(false), "");
  EXPECT_EQ(inside.untrue(true), "");
  EXPECT_EQ(inside.tally.contained, 1);
}

TEST(FuzzOracles, FlagAContactOfMeshesThatAreApart) {
  Case apart(make_cube(1), {}, make_cube(1), at(1.25, 0, 0));
  EXPECT_NE(apart.untrue(true), "");
  EXPECT_EQ(apart.untrue(false), "");
  EXPECT_EQ(apart.tally.apart, 1);
}

TEST(FuzzOracles, LeaveWhatIsOnTheEdgeOpen) {
  Case touching(make_cube(1), {}, make_cube(1), at(1 + 1e-6, 0.25, 0.125));
  EXPECT_EQ(touching.untrue(true), "");
  EXPECT_EQ(touching.tally.on_edge, 1);
}

TEST(FuzzOracles, SayOfOpenMeshesThatAreApartNothing) {
  Case open(make_sheet(1, 2), {}, make_cube(1), at(0, 0, 2));
  open.solid = false;
  EXPECT_EQ(open.untrue(true), "");
  EXPECT_EQ(open.tally.unjudged, 1);
}

TEST(FuzzOracles, SayOfMeshesAndPosesThatAreNotTameNothing) {
  Case thin(make_box({1, 1, 1e-5}), {}, make_cube(1), {});
  EXPECT_EQ(thin.untrue(false), "");
  Case far(make_cube(1), at(1e9, 0, 0), make_cube(1), at(1e9, 0, 0));
  EXPECT_EQ(far.untrue(false), "");
  Case mirrored(make_cube(1), {}, make_cube(1), {});
  mirrored.pose_a.rotation[0] = -1;
  EXPECT_EQ(mirrored.untrue(false), "");
  EXPECT_EQ(thin.tally.unjudged + far.tally.unjudged + mirrored.tally.unjudged, 3);
}

}  // namespace
}  // namespace ode_ext::fuzz
