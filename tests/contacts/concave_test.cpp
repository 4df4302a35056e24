// SPDX-License-Identifier: BSD-3-Clause
// Contacts where a mesh is not convex, and no edge of it says so.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

#include "contacts/placed.h"

namespace ode_ext::test {
namespace {

// A floor and a wall, of which no edge says that they are not convex: behind it z < 0 and x > 0.
TestMesh two_boxes(double below) {
  return merged(moved(make_box({2 + below, 4, 1}), {below / 2 - 1, 0, -0.5}),
                moved(make_box({1, 4, 3}), {0.5, 0, 0.5}));
}

TestMesh faces_that_meet(bool fills) {
  TestMesh mesh{{-2, -2, 0, 0, -2, 0, 0, 2, 0, -2, 2, 0, 0, 0.3f, 0, 0, -2, 2, 0, 0.3f, 2, 0, 2, 2},
                {0, 1, 2, 0, 2, 3, 1, 5, 6, 1, 6, 4, 4, 6, 7, 4, 7, 2}};
  if (fills) mesh.indices.insert(mesh.indices.end(), {1, 4, 2});
  return mesh;
}

TEST(Concave, ContactsOfABoxInACornerArePushedOutOfTheFloorAndTheWall) {
  const TestMesh corners[] = {two_boxes(0.5), two_boxes(0), faces_that_meet(false),
                              faces_that_meet(true)};
  const double deep = 0.01, far = 0.015;
  for (const int cuts : {1, 6})
    for (std::size_t i = 0; i < std::size(corners); ++i) {
      SCOPED_TRACE(i);
      const Placed placed{make_cube(0.3, cuts), corners[i], at(far - 0.15, 0.1, 0.15 - deep),
                          TestPose{}};
      for (const TestPose& frame : some_frames()) {
        int up = 0, aside = 0;
        for (const Contact& c : placed.contacts(frame)) {
          const bool is_up = c.normal.z > 0.999, is_aside = c.normal.x < -0.999;
          EXPECT_TRUE(is_up || is_aside)
              << c.normal.x << " " << c.normal.y << " " << c.normal.z << " " << c.depth;
          EXPECT_LE(c.depth, (is_up ? deep : far) * 1.01);
          up += is_up && c.depth > 0.99 * deep;
          aside += is_aside && c.depth > 0.99 * far;
        }
        EXPECT_GE(up, 2);
        EXPECT_GE(aside, 2);
      }
    }
}

// A floor and on it a ramp that falls from x = 0, where it is so high, to the right, in one closed
// mesh.
TestMesh floor_and_ramp(double height) {
  const std::vector<std::array<double, 2>> profile{{-3, -1},    {4.5, -1}, {4.5, 0}, {1.5, 0},
                                                   {0, height}, {0, 0},    {-3, 0}};
  const int count = static_cast<int>(profile.size());
  TestMesh mesh;
  for (const double y : {-2.0, 2.0})
    for (const auto& [x, z] : profile)
      for (const double c : {x, y, z}) mesh.vertices.push_back(static_cast<float>(c));
  for (const auto& [a, b, c] : {std::array{0, 1, 5}, {0, 5, 6}, {1, 2, 3}, {1, 3, 5}, {3, 4, 5}})
    for (const int i : {a, b, c, count + a, count + c, count + b})
      mesh.indices.push_back(static_cast<unsigned>(i));
  for (int a = 0; a < count; ++a) {
    const int b = (a + 1) % count;
    for (const int i : {a, count + a, b, b, count + a, count + b})
      mesh.indices.push_back(static_cast<unsigned>(i));
  }
  return mesh;
}

// The vertex at the foot of the wall is behind the floor and the wall, and no plane of one of them
// separates it: the ramp's slope does, which is half a metre away.
TEST(Concave, ContactsAtTheFootOfARampsTallEndAreNoDeeperThanTheCubeIsInItAndInTheFloor) {
  const double tilt = 0.001, floor = 0.003, wall = 0.002;
  TestPose pose = turned({0, 1, 0}, tilt);
  const Point foot = rotate(pose, {0.5, 0, -0.5});
  pose.position = {wall - foot[0], 0.03, -floor - foot[2]};
  const Placed placed{make_cube(1), floor_and_ramp(0.5), pose, TestPose{}};
  for (const TestPose& frame : some_frames()) {
    int up = 0, aside = 0;
    for (const Contact& c : placed.contacts(frame)) {
      EXPECT_LE(c.depth, 1.01 * floor) << c.normal.x << " " << c.normal.y << " " << c.normal.z;
      up += c.normal.z > 0.99 && c.depth > 0.6 * floor;
      aside += c.normal.x < -0.99 && c.depth > 0.9 * wall;
    }
    EXPECT_GE(up, 2);
    EXPECT_GE(aside, 2);
  }
}

TEST(Concave, ContactsAtTheFootOfAWallHoldBothFrontCornersFromTheFloorToo) {
  const double floor = 0.0005, wall = 0.002;
  const Placed placed{make_cube(1), floor_and_ramp(2), at(wall - 0.5, 0.03, 0.5 - floor),
                      TestPose{}};
  for (const TestPose& frame : some_frames()) {
    int left = 0, right = 0;
    for (const Contact& c : placed.contacts(frame)) {
      if (!(c.normal.z > 0.99) || c.position.x < -0.1) continue;
      (c.position.y < 0 ? left : right) += 1;
    }
    EXPECT_GE(left, 1);
    EXPECT_GE(right, 1);
  }
}

// Its lower edges go through both blocks, which overlap: they are inside from the one end to the
// other, and a chord from the second wall to the third would hold it up in the middle alone.
TEST(Concave, ContactsOfARodAcrossTwoPartsThatOverlapHoldBothOfItsEnds) {
  const TestMesh blocks = merged(moved(make_box({0.3, 1, 0.5}), {0.15, 0, -0.25}),
                                 moved(make_box({0.7, 1, 0.4}), {0.55, 0, -0.2}));
  const double deep = 0.01;
  const Placed placed{make_rod(1.2, 0.1), blocks, at(0.45, 0.02, 0.05 - deep), TestPose{}};
  for (const TestPose& frame : some_frames()) {
    int first = 0, last = 0;
    for (const Contact& c : placed.contacts(frame)) {
      EXPECT_GT(c.normal.z, 0.999);
      EXPECT_LE(c.depth, 1.01 * deep);
      first += c.depth > 0.99 * deep && c.position.x < 0.01;
      last += c.depth > 0.99 * deep && c.position.x > 0.89;
    }
    EXPECT_GE(first, 1);
    EXPECT_GE(last, 1);
  }
}

// All of it is one facet, whose largest triangle may be far away and a little steep.
TEST(Concave, ContactsOnAWideFloorThatIsNotQuiteFlatAreAsDeepAsItIsThere) {
  TestMesh floor = make_sheet(60, 60);
  Random random(9);
  for (std::size_t i = 2; i < floor.vertices.size(); i += 3)
    floor.vertices[i] = static_cast<float>(random.uniform(-4e-4, 4e-4));
  for (const double x : {-29.2, -11.3, 0.4, 17.6, 28.9})
    for (const double y : {-28.7, 3.1, 29.1}) {
      const Placed placed{make_cube(0.5), floor, at(x, y, 0.25 - 0.005), TestPose{}};
      const std::vector<Contact> found = placed.contacts(at(0, 0, 0));
      EXPECT_GE(found.size(), 3u) << x << " " << y;
      for (const Contact& c : found) {
        EXPECT_GT(c.normal.z, 0.999);
        EXPECT_LT(c.depth, 0.0065) << x << " " << y;
      }
      EXPECT_TRUE(
          std::any_of(found.begin(), found.end(), [](const Contact& c) { return c.depth > 0.004; }))
          << x << " " << y;
    }
}

// So finely cut that no edge of it rises over the plane of another face by what is known.
TEST(Concave, ContactsOfABallInAFineTroughAreNoDeeperThanItIs) {
  for (const int strips : {500, 1500}) {
    TestMesh trough;
    for (int i = 0; i <= strips; ++i) {
      const double angle = std::numbers::pi * (i / static_cast<double>(strips) - 1);
      for (const double y : {-0.5, 0.5})
        for (const double v : {std::cos(angle), y, std::sin(angle)})
          trough.vertices.push_back(static_cast<float>(v));
    }
    for (unsigned i = 0; i < static_cast<unsigned>(strips); ++i)
      trough.indices.insert(trough.indices.end(),
                            {2 * i, 2 * i + 2, 2 * i + 1, 2 * i + 1, 2 * i + 2, 2 * i + 3});
    const double deep = 0.001;
    const Placed placed{make_icosphere(0.9, 4), trough, at(0, 0.01, -0.1 - deep), TestPose{}};
    const std::vector<Contact> found = placed.contacts(at(0, 0, 0));
    EXPECT_FALSE(found.empty());
    for (const Contact& c : found) {
      EXPECT_LT(c.depth, 1.05 * deep) << strips;
      EXPECT_GT(c.normal.z, 0.9);
    }
  }
}

// Two slopes of a roof, the one with a long side at the crest and the other with `shorts`: one
// triangle of no area less lies between. `is_whole`: the former has as many, and there are none.
TestMesh roof(bool is_whole, unsigned shorts) {
  const float c = std::sqrt(0.75f), s = -0.5f;
  TestMesh mesh{{-1, -1, 0, -1, 1, 0, c, -1, s, c, 1, s}, {}};
  for (unsigned i = 0; i <= shorts; ++i)
    mesh.vertices.insert(mesh.vertices.end(),
                         {0, 2 * static_cast<float>(i) / static_cast<float>(shorts) - 1, 0});
  const auto crest = [](unsigned i) { return 4 + i; };
  const auto add = [&](unsigned a, unsigned b, unsigned k) {
    mesh.indices.insert(mesh.indices.end(), {a, b, k});
  };
  add(0, crest(shorts), 1);
  for (unsigned i = 0; is_whole && i < shorts; ++i) add(0, crest(i), crest(i + 1));
  if (!is_whole) add(0, crest(0), crest(shorts));
  for (unsigned i = 1; !is_whole && i < shorts; ++i) add(crest(0), crest(i), crest(i + 1));
  for (unsigned i = 0; i < shorts; ++i) add(crest(i), 2, crest(i + 1));
  add(crest(shorts), 2, 3);
  return mesh;
}

Contact deepest_of(const std::vector<Contact>& contacts) {
  return *std::max_element(contacts.begin(), contacts.end(),
                           [](const Contact& a, const Contact& b) { return a.depth < b.depth; });
}

// Rods on edge across the crest, level with what is between the slopes and steeper than either, as
// either mesh of the pair.
TEST(Concave, ContactsAtTrianglesOfNoAreaAreThoseOfTheRoofWithoutThem) {
  const TestMesh rod = make_rod(1, 0.1);
  for (const unsigned shorts : {2u, 3u})
    for (const double slope : {-0.26, -0.1, -0.45, -1.05})
      for (const double y : {0.37, -0.52})
        for (const bool rod_is_first : {true, false}) {
          SCOPED_TRACE(std::to_string(shorts) + " " + std::to_string(slope) + ", " +
                       std::to_string(y) + (rod_is_first ? " first" : " second"));
          TestPose pose =
              composed(turned({0, 1, 0}, -slope), turned({1, 0, 0}, std::numbers::pi / 4));
          pose.position = {0, y, 0.1 * std::sqrt(0.5) - 0.005};
          for (const TestPose& frame : some_frames(2)) {
            const auto deepest = [&](const TestMesh& on) {
              const auto found = rod_is_first ? Placed{rod, on, pose, TestPose{}}.contacts(frame)
                                              : Placed{on, rod, TestPose{}, pose}.contacts(frame);
              return found.empty() ? Contact{} : deepest_of(found);
            };
            const Contact ours = deepest(roof(false, shorts));
            const Contact theirs = deepest(roof(true, shorts));
            EXPECT_GT(theirs.depth, 0.001);
            EXPECT_NEAR(ours.depth, theirs.depth, 0.01 * theirs.depth);
            EXPECT_GT(dot(point_of(ours.normal), point_of(theirs.normal)), 0.9999);
          }
        }
}

struct Cuts {
  int around, across;
};

// The inside of one ring against that of another: both surfaces are saddles there. The planes of
// faces beside the place cut through the ring that they are of, so that points of the other have
// less far to go past these, and are still inside.
TEST(Concave, ContactsOfLinksOfAChainAreAsDeepAsTheyOverlapHoweverTheyAreCut) {
  const double deep = 0.02;
  for (const Cuts& cuts : {Cuts{16, 8}, Cuts{48, 24}, Cuts{96, 48}, Cuts{192, 96}}) {
    SCOPED_TRACE(cuts.around);
    const TestMesh link = make_torus(0.4, 0.1, cuts.around, cuts.across);
    const Placed placed{link, link, at(0, 0, 0),
                        turned({1, 0, 0}, std::numbers::pi / 2, {0.6 + deep, 0, 0})};
    for (const TestPose& frame : some_frames()) {
      const std::vector<Contact> found = placed.contacts(frame);
      ASSERT_FALSE(found.empty());
      const Contact deepest = deepest_of(found);
      EXPECT_GT(deepest.depth, 0.88 * deep);
      EXPECT_LT(deepest.depth, 1.01 * deep);
      // A face at the place is turned by half a cut, and one beside it by one and a half, each way;
      // and in no case is it 25 degrees off.
      EXPECT_GT(deepest.normal.x, std::max(std::cos(3.5 * std::numbers::pi / cuts.around),
                                           std::cos(25 * std::numbers::pi / 180)));
    }
  }
}

// Farther in, what is nearest to a point of one is the far side of the other: there units go either
// way (docs/contacts.md, limits).
TEST(Concave, LinksOfAChainThatAreUpToHalfwayThroughOneAnotherGoBack) {
  const double tube = 0.1;
  const TestMesh link = make_torus(0.4, tube, 96, 48);
  Random random(5);
  for (const double share : {0.2, 0.3, 0.4, 0.5}) {  // of how thick they are
    const double deep = 2 * tube * share;
    for (int i = 0; i < 25; ++i) {
      SCOPED_TRACE(std::to_string(share) + ", " + std::to_string(i));
      const TestPose turn =
          turned({1, 0, 0}, std::numbers::pi / 2 + random.uniform(-0.3, 0.3), {0.6 + deep, 0, 0});
      const Placed placed{link, link, at(0, 0, 0), turn};
      const std::vector<Contact> found = placed.contacts(TestPose{});
      ASSERT_FALSE(found.empty());
      const Contact deepest = deepest_of(found);
      EXPECT_GT(deepest.depth, 0.9 * deep);
      EXPECT_LT(deepest.depth, 1.1 * deep);
      for (const Contact& contact : found) EXPECT_GT(contact.normal.x, -0.1) << contact.depth;
    }
  }
}

// Rings that hang in each other, as a link on a hook does, meet over several faces of each; where
// edges of theirs part them, one point where these pass would let a ring turn about it.
TEST(Concave, ARingThatHangsInARingIsHeldAtMoreThanTwoPoints) {
  const TestMesh upper = make_torus(0.12, 0.04, 24, 12), lower = make_torus(0.12, 0.03, 24, 12);
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const double angle = random.uniform(0, 0.5);
    const TestPose tilted = turned(random.direction(), angle);
    TestPose crossed = composed(tilted, turned({1, 0, 0}, std::numbers::pi / 2));
    double apart = 0.15, together = 0.25;
    while (together - apart > 1e-5) {
      const double middle = 0.5 * (apart + together);
      crossed.position = {middle, 0, 0};
      (surfaces_intersect(lower, at(0, 0, 0), upper, crossed) ? together : apart) = middle;
    }
    crossed.position = {together + 0.004, 0, 0};
    const Placed placed{lower, upper, at(0, 0, 0), crossed};
    EXPECT_GT(placed.contacts(TestPose{}).size(), 2u) << "pose " << i;
  }
}

// Closed, about z from -1 to 1; its waist is at 0.
TestMesh make_spool(int sides, int rings) {
  TestMesh mesh;
  for (int r = 0; r <= rings; ++r) {
    const double z = 2.0 * r / rings - 1, radius = 0.3 + 0.7 * z * z;
    for (int k = 0; k < sides; ++k) {
      const double angle = 2 * std::numbers::pi * k / sides;
      for (const double v : {radius * std::cos(angle), radius * std::sin(angle), z})
        mesh.vertices.push_back(static_cast<float>(v));
    }
  }
  const auto at = [&](int r, int k) { return static_cast<unsigned>(r * sides + k % sides); };
  for (int r = 0; r < rings; ++r)
    for (int k = 0; k < sides; ++k)
      mesh.indices.insert(mesh.indices.end(), {at(r, k), at(r, k + 1), at(r + 1, k + 1), at(r, k),
                                               at(r + 1, k + 1), at(r + 1, k)});
  for (int k = 1; k + 1 < sides; ++k) {
    mesh.indices.insert(mesh.indices.end(), {at(0, 0), at(0, k + 1), at(0, k)});
    mesh.indices.insert(mesh.indices.end(), {at(rings, 0), at(rings, k), at(rings, k + 1)});
  }
  return mesh;
}

// Its waist is saddles all round: no vertex in the plate is the outermost in any direction.
TEST(Concave, ContactsOfASpoolInAPlateSendItOutHoweverItIsCut) {
  for (const Cuts& cuts : {Cuts{6, 2}, Cuts{12, 8}, Cuts{24, 16}, Cuts{48, 32}}) {
    SCOPED_TRACE(cuts.around);
    const Placed placed{make_spool(cuts.around, cuts.across), make_plate(4, 1, 2), at(0, 0, 0.1),
                        at(0, 0, 0)};
    for (const TestPose& frame : some_frames()) {
      const std::vector<Contact> found = placed.contacts(frame);
      ASSERT_FALSE(found.empty());
      const Contact deepest = deepest_of(found);
      EXPECT_GT(deepest.depth, 0.4 - 1e-5);
      EXPECT_LT(deepest.depth, 1.0);
      EXPECT_GT(std::fabs(deepest.normal.z), 0.999);
    }
  }
}

// A seat, its lower side at z = 0, on two legs at opposite corners, which lean outwards below.
TestMesh seat_on_legs(double height) {
  const std::array<double, 4> lines{-0.15, -0.12, 0.12, 0.15};
  const std::array<double, 3> levels{-height, 0, 0.02};
  const auto is_solid = [](int i, int j, int k) {
    if (i < 0 || i > 2 || j < 0 || j > 2 || k < 0 || k > 1) return false;
    return k == 1 || (i == j && i != 1);
  };
  TestMesh mesh;
  for (const double z : levels)
    for (const double y : lines)
      for (const double x : lines)
        for (const double v : {x * (1 - 4 * (z - 0.02) / 3), y * (1 - 4 * (z - 0.02) / 3), z})
          mesh.vertices.push_back(static_cast<float>(v));
  const auto at = [](int i, int j, int k) { return static_cast<unsigned>(16 * k + 4 * j + i); };
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 2; ++k) {
        if (!is_solid(i, j, k)) continue;
        for (int axis = 0; axis < 3; ++axis)
          for (const int step : {0, 1}) {
            const std::array<int, 3> one{axis == 0, axis == 1, axis == 2};
            const int to = 2 * step - 1;
            if (is_solid(i + to * one[0], j + to * one[1], k + to * one[2])) continue;
            const std::array<int, 3> u{one[2], one[0], one[1]}, v{one[1], one[2], one[0]};
            const std::array<int, 3> o{i + step * one[0], j + step * one[1], k + step * one[2]};
            const unsigned a = at(o[0], o[1], o[2]);
            const unsigned b = at(o[0] + u[0], o[1] + u[1], o[2] + u[2]);
            const unsigned c = at(o[0] + u[0] + v[0], o[1] + u[1] + v[1], o[2] + u[2] + v[2]);
            const unsigned d = at(o[0] + v[0], o[1] + v[1], o[2] + v[2]);
            if (step == 1)
              mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
            else
              mesh.indices.insert(mesh.indices.end(), {a, c, b, a, d, c});
          }
      }
  return mesh;
}

// Two planes that face one way, the second 11 micrometres farther, took the chord along the upper
// edge of the plate out together, and were not thought to: it was sent out through the leg.
TEST(Concave, APlateThatALegJustTouchesIsHeldByTheSeatOnIt) {
  const TestMesh seat = seat_on_legs(0.43), plate = make_box({0.3, 0.3, 0.02});
  const double inner = 0.12 * (1 + 0.08 / 3);  // of the corner of a leg, where it meets the seat
  const double turn = -0.257;
  const Point to_leg{std::sin(turn), -std::cos(turn), 0};  // from the plate's middle
  const double way = inner * (std::cos(turn) - std::sin(turn));
  Random random(12);
  for (int i = 0; i < 2000; ++i) {
    TestPose pose = composed(turned({random.uniform(-1, 1), random.uniform(-1, 1), 0}, 1e-4),
                             turned({0, 0, 1}, turn + random.uniform(-4e-5, 4e-5)));
    pose.position = (way - 0.15 + random.uniform(-2e-5, 2e-5)) * to_leg;
    pose.position[2] = -0.01 + 9e-5;
    const std::vector<Contact> found = Placed{plate, seat, pose, TestPose{}}.contacts(TestPose{});
    ASSERT_FALSE(found.empty()) << i;
    EXPECT_LT(deepest(found), 0.005) << i;
  }
}

double ring_top(const TestMesh& ring) {
  double top = 0;
  for (int k = 0; k < ring.vertex_count(); ++k)
    top = std::max(top, ring.vertex(static_cast<std::size_t>(k))[2]);
  return top;
}

// A box that is lowered by d on a ring that lies is clear again after d. At the box's side what is
// on top of the ring is nearer to that than to the lower side, and what is beside it goes up.
TEST(Concave, ABoxWithItsSideOverARingGoesUpByAsMuchAsItIsInIt) {
  const TestMesh ring = make_torus(0.03, 0.0122, 24, 12);
  const double top = ring_top(ring);
  const TestPose turned_a_little = turned({0, 0, 1}, 0.05);
  for (const double d : {0.004, 0.006, 0.008})
    for (const double side : {-0.026, -0.022}) {
      const Placed placed{make_box({0.3, 0.6, 0.3}), ring, at(side + 0.15, 0, top - d + 0.15),
                          turned_a_little};
      const std::vector<Contact> found = placed.contacts(TestPose{});
      ASSERT_FALSE(found.empty());
      EXPECT_LT(deepest(found), 1.1 * d) << d << " with its side at " << side;
    }
}

// The same, deeper: what is on top of the ring may leave by the box's side where that is nearer.
// What follows it goes no farther than twice the way up: a move lends what its own unit proposed,
// and what is left is less than what the follower proposes; neither proposes more than the way up.
TEST(Concave, ABoxWithItsSideOverARingSendsNoneOfItFarPastTheSide) {
  const TestMesh ring = make_torus(0.03, 0.0122, 24, 12);
  const double top = ring_top(ring);
  for (const double d : {0.009, 0.01, 0.011, 0.012})
    for (const double side : {-0.03, -0.028, -0.026}) {
      const Placed placed{make_box({0.3, 0.6, 0.3}), ring, at(side + 0.15, 0, top - d + 0.15),
                          TestPose{}};
      const std::vector<Contact> found = placed.contacts(TestPose{});
      ASSERT_FALSE(found.empty());
      EXPECT_LT(deepest(found), 2 * d) << d << " with its side at " << side;
    }
}

}  // namespace
}  // namespace ode_ext::test
