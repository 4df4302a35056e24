// SPDX-License-Identifier: BSD-3-Clause
// Parts that fit one another along a profile, pushed into one another by a little more than they
// have to spare. Taking that back parts them, so no contact is deeper.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "contacts/placed.h"
#include "support/extruded.h"

namespace ode_ext::test {
namespace {

// It is held by its flanks, which lean over it, however deep it sits. It had contacts as deep as
// that, straight up and out of the guide.
TEST(Profiles, ADovetailLeavesItsGuideByTheFlanks) {
  for (const double undercut : {0.5, 1.5, 3.0, 5.0, 8.0}) {
    const Profile tail{{-12.6 + (5 - undercut), -8},
                       {12.6 - (5 - undercut), -8},
                       {7.6, 3},
                       {30, 3},
                       {30, 20},
                       {-30, 20},
                       {-30, 3},
                       {-7.6, 3}};
    const Profile guide{
        {-30, -20}, {30, -20}, {30, 0}, {10, 0}, {10 + undercut, -10}, {-10 - undercut, -10},
        {-10, 0},   {-30, 0}};
    for (const double length : {40.0, 60.0, 80.0})
      for (const double pushed : {0.01, 0.1, 0.5}) {
        // Until a flank touches: along x by what there is between the lip and the flank.
        const double slope = (5.0 - (5 - undercut)) / 11;  // of the tail's flank
        const double apart = 10 - (7.6 + slope * 3);
        const Placed placed{scaled(extruded(tail, length), 0.001),
                            scaled(extruded(guide, 60), 0.001),
                            at(-0.001 * (apart + pushed), 0, 0.001), TestPose{}};
        const std::vector<Contact> found = placed.contacts(TestPose{});
        ASSERT_FALSE(found.empty()) << undercut << ", " << length;
        EXPECT_LT(deepest(found), 0.0011 * pushed) << undercut << ", " << length;
        for (const Contact& c : found) EXPECT_GT(c.normal.x, 0.7);
      }
  }
}

// From where a part fits, along z as well as across and by a turn of up to 0.003; lengths in mm.
struct Moved {
  // radius: of the part, about its middle
  Moved(Random& random, const Point& by, double radius) {
    const double angle = random.uniform(0, 0.003);
    const Point axis = random.direction();
    pose = turned(axis, angle, 0.001 * by);
    farthest = 0.001 * (std::hypot(by[0], by[1]) + radius * angle);
  }
  TestPose pose;
  double farthest = 0;  // [m] across the guide, of any of its points
};

// A tail that fills its guide and was then made larger, and moved, so that no point of either is
// farther from where it touches the other than that. A corner of the guide is nearest to the end of
// the tail, beyond which it does not go on. Of these 1,440 poses 7 had contacts up to 8.1 mm deep,
// straight out of the guide: no tail comes out that way.
TEST(Profiles, ATailThatIsTightIsHeldByItsFlanks) {
  Random random(11);
  std::size_t colliding = 0;
  for (const double slope : {0.15, 0.3, 0.45, 0.6})
    for (const double larger : {0.02, 0.05, 0.2})
      for (const double along : {0.0, 13.0, 31.0}) {
        const double mouth = 5, bottom = 5 + 8 * slope;
        const Profile tail{{-mouth - larger, -larger},
                           {mouth + larger, -larger},
                           {bottom + larger, 8 + larger},
                           {-bottom - larger, 8 + larger}};
        const Profile guide{{35, 20},     {-35, 20},   {-35, 0},   {-mouth, 0},
                            {-bottom, 8}, {bottom, 8}, {mouth, 0}, {35, 0}};
        const TestMesh a = scaled(extruded(tail, 30), 0.001);
        const TestMesh b = scaled(extruded(guide, 50), 0.001);
        for (int i = 0; i < 40; ++i) {
          const double x = random.uniform(-0.05, 0.05), y = random.uniform(-0.05, 0.05);
          const Moved moved(random, {x, y, along}, std::hypot(bottom, 8, 15) + larger);
          const std::vector<Contact> found =
              Placed{a, b, moved.pose, TestPose{}}.contacts(TestPose{});
          colliding += found.empty() ? 0 : 1;
          EXPECT_LT(deepest(found), 2 * (moved.farthest + 0.001 * std::sqrt(2) * larger))
              << slope << ", " << larger << " larger, at " << along << ", " << i;
        }
      }
  EXPECT_GT(colliding, 1000u);
}

// Three tails on one plate, as a joint of boards, made larger and moved as above. What one tail has
// in its guide is in a region with the others, and past its flank it goes into the bottom. Of these
// 720 poses 138 had a contact more than twice as deep as that, now 116.
TEST(Profiles, ThreeTailsThatAreTightAreMostlyHeldByTheirFlanks) {
  Random random(12);
  int too_deep = 0;
  for (const double slope : {0.15, 0.3, 0.45, 0.6})
    for (const double larger : {0.02, 0.05, 0.2})
      for (const double along : {0.0, 3.0, 9.0}) {
        Profile tails{{-30, -12}, {30, -12}, {30, larger - 0.5}};
        Profile guide{{30, 20}, {-30, 20}, {-30, 0}};
        for (int i = -1; i <= 1; ++i) {
          const double mouth = 3, bottom = 3 + 8 * slope;
          tails.insert(tails.end(), {{-16 * i + mouth + larger, larger - 0.5},
                                     {-16 * i + bottom + larger, 8},
                                     {-16 * i - bottom - larger, 8},
                                     {-16 * i - mouth - larger, larger - 0.5}});
          guide.insert(guide.end(), {{16 * i - mouth, 0},
                                     {16 * i - bottom, 8.5},
                                     {16 * i + bottom, 8.5},
                                     {16 * i + mouth, 0}});
        }
        tails.push_back({-30, larger - 0.5});
        guide.push_back({30, 0});
        const TestMesh a = scaled(extruded(tails, 12), 0.001);
        const TestMesh b = scaled(extruded(guide, 12), 0.001);
        for (int i = 0; i < 20; ++i) {
          const double x = random.uniform(-0.1, 0.1), y = random.uniform(0.3, 0.6);
          const Moved moved(random, {x, y, along}, std::hypot(30, 12, 6));
          const std::vector<Contact> found =
              Placed{a, b, moved.pose, TestPose{}}.contacts(TestPose{});
          too_deep += deepest(found) > 2 * (moved.farthest + 0.001 * std::sqrt(2) * larger);
        }
      }
  EXPECT_LE(too_deep, 116);
}

// Whatever its angle is: acute ones take both walls at once.
TEST(Profiles, ABarLeavesAVBlockByItsWalls) {
  Random random(9);
  std::size_t colliding = 0;
  for (const double half : {20.0, 30.0, 41.0, 45.0, 60.3, 75.0})
    for (const double narrower : {0.0, 0.1, 3.0})
      for (const auto& [bar, block] : {std::array{80.0, 60.0}, {60.0, 60.0}, {60.0, 80.0}}) {
        const double t = std::tan(half * std::numbers::pi / 180);
        const double s = std::tan((half - narrower) * std::numbers::pi / 180);
        const Profile v{{-30, -30}, {30, -30}, {30, 30 / t}, {0, 0}, {-30, 30 / t}};
        const Profile diamond{{0, 0}, {20, 20 / s}, {0, 40 / s}, {-20, 20 / s}};
        const TestMesh a = scaled(extruded(diamond, bar), 0.001);
        const TestMesh b = scaled(extruded(v, block), 0.001);
        for (int i = 0; i < 12; ++i) {
          const double angle = random.uniform(-std::numbers::pi, 0);
          const double pushed = 1e-5 * std::pow(10, random.uniform(0, 2));
          const Placed placed{
              a, b,
              at(pushed * std::cos(angle), pushed * std::sin(angle), random.uniform(-0.002, 0.002)),
              TestPose{}};
          const std::vector<Contact> found = placed.contacts(TestPose{});
          colliding += found.empty() ? 0 : 1;
          EXPECT_LT(deepest(found), 1.05 * pushed + placed.tolerance(TestPose{}))
              << half << " degrees, " << narrower << " narrower, " << bar << " in " << block;
        }
      }
  EXPECT_GT(colliding, 500u);
}

// Eight teeth with straight flanks, from sharp to blunt, that have 0.3 mm to spare.
TEST(Profiles, ASplineLeavesItsHubByTheFlanks) {
  Random random(10);
  std::size_t colliding = 0;
  for (const double tip : {50.0, 60.0, 78.0, 82.0, 90.0, 100.0, 120.0}) {
    const double half = tip * std::numbers::pi / 360, pitch = std::numbers::pi / 8;
    const auto star = [&](double smaller) {  // all flanks moved in by as much
      const double r = 12 - smaller / std::sin(half);
      const double s = r * std::tan(pitch) / (std::sin(half) + std::cos(half) * std::tan(pitch));
      const double valley = std::hypot(r - s * std::cos(half), s * std::sin(half));
      Profile profile;
      for (int i = 0; i < 16; ++i) {
        const double size = i % 2 == 0 ? r : valley;
        profile.push_back({size * std::cos(pitch * i), size * std::sin(pitch * i)});
      }
      return profile;
    };
    const TestMesh shaft = scaled(extruded(star(0.3), 40), 0.001);
    const TestMesh around = scaled(hub(star(0), 20, 20), 0.001);
    for (int i = 0; i < 60; ++i) {
      const double angle = random.uniform(0, 2 * std::numbers::pi);
      const double pushed = 0.0003 * random.uniform(1.1, 2.5);
      const Placed placed{
          shaft, around,
          at(pushed * std::cos(angle), pushed * std::sin(angle), random.uniform(-0.002, 0.002)),
          TestPose{}};
      const std::vector<Contact> found = placed.contacts(TestPose{});
      colliding += found.empty() ? 0 : 1;
      EXPECT_LT(deepest(found), pushed) << tip << " degrees, " << i;
      for (const Contact& c : found) EXPECT_LT(std::abs(c.normal.z), 0.01);
    }
  }
  EXPECT_GT(colliding, 300u);
}

}  // namespace
}  // namespace ode_ext::test
