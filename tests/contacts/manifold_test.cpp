// SPDX-License-Identifier: BSD-3-Clause
// Contacts of bodies that overlap in known ways: by which plane each region parts, how deep it is,
// and where it is held.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contacts/placed.h"
#include "support/deform_rig.h"

namespace ode_ext::test {
namespace {

using Bits = std::vector<std::vector<ContactBits>>;

constexpr double kRight = std::numbers::pi / 2;

bool has(const std::vector<Contact>& contacts, const Point& position, const Point& normal,
         double depth, double tolerance) {
  return std::any_of(contacts.begin(), contacts.end(), [&](const Contact& c) {
    return distance(point_of(c.position), position) < tolerance &&
           distance(point_of(c.normal), normal) < 1e-5 && std::fabs(c.depth - depth) < tolerance;
  });
}

// A rod on edge along the direction at `angle` from x, its lower (`up` > 0) or upper edge at z = 0.
TestPose on_edge(double angle, double up, double width) {
  const TestPose rolled = turned({1, 0, 0}, kRight / 2);
  TestPose pose = composed(turned({0, 0, 1}, angle), rolled);
  pose.position = {0, 0, up * width / std::numbers::sqrt2};
  return pose;
}

TEST(Manifolds, OfCrossedRodsAreOneWhereTheirEdgesPass) {
  const double depth = 0.01;
  for (const double angle : {kRight, 1.0, 0.5}) {
    Placed rods{make_rod(2, 0.2), make_rod(2, 0.2), on_edge(angle, 1, 0.2), on_edge(0, -1, 0.2)};
    rods.pa.position[2] -= depth;
    for (const TestPose& frame : some_frames()) {
      const auto found = rods.contacts(frame);
      ASSERT_EQ(found.size(), 1u) << angle;
      EXPECT_TRUE(has(found, {0, 0, -depth / 2}, {0, 0, 1}, depth, rods.tolerance(frame))) << angle;
      EXPECT_FALSE(rods.intersect_after(found[0], depth + rods.tolerance(frame)));
    }
  }
}

TEST(Manifolds, OfRodsThatAreApartAreNone) {
  Placed rods{make_rod(2, 0.2), make_rod(2, 0.2), on_edge(1, 1, 0.2), on_edge(0, -1, 0.2)};
  rods.pa.position[2] += 1e-4;
  for (const TestPose& frame : some_frames()) EXPECT_TRUE(rods.contacts(frame).empty());
}

TEST(Manifolds, OfRodsThatLieAcrossOneAnotherAreTheCornersOfTheSquare) {
  Placed rods{make_rod(2, 0.2), make_rod(2, 0.2), turned({0, 0, 1}, kRight), at(0, 0, 0)};
  rods.pa.position = {0.3, -0.2, 0.19};
  for (const TestPose& frame : some_frames()) {
    const auto found = rods.contacts(frame);
    const double depth = found.empty() ? 0 : found[0].depth;
    EXPECT_NEAR(depth, 0.01, rods.tolerance(frame));
    for (const double x : {0.2, 0.4})
      for (const double y : {-0.1, 0.1})
        EXPECT_TRUE(std::any_of(found.begin(), found.end(),
                                [&](const Contact& c) {
                                  return std::hypot(c.position.x - x, c.position.y - y) <
                                             rods.tolerance(frame) &&
                                         c.normal.z > 1 - 1e-9 &&
                                         std::fabs(c.depth - 0.01) < rods.tolerance(frame);
                                }))
            << x << " " << y;
  }
}

// One corner of the rectangle is the upper cube's, the opposite one the lower's, two are where
// edges cross.
TEST(Manifolds, OfACubeOnACubeAreAllFourCorners) {
  for (const int n : {1, 3}) {
    const Placed cubes{make_cube(1, n), make_cube(1, n), at(0.3, 0.2, 0.99), at(0, 0, 0)};
    for (const TestPose& frame : some_frames()) {
      const auto found = cubes.contacts(frame);
      for (const double x : {-0.2, 0.5})
        for (const double y : {-0.3, 0.5})
          EXPECT_TRUE(std::any_of(found.begin(), found.end(),
                                  [&](const Contact& c) {
                                    return std::hypot(c.position.x - x, c.position.y - y) <
                                           cubes.tolerance(frame);
                                  }))
              << x << " " << y;
      for (const Contact& c : found) {
        EXPECT_NEAR(c.normal.z, 1, 1e-9);
        EXPECT_NEAR(c.depth, 0.01, cubes.tolerance(frame));
      }
    }
  }
}

TEST(Manifolds, MoveACubeInsideACubeOutThroughItsNearestSide) {
  for (const int n : {1, 4}) {
    const Placed cubes{make_cube(0.3, n), make_cube(2), at(0.5, 0.1, -0.05), at(0, 0, 0)};
    for (const TestPose& frame : some_frames()) {
      const auto found = cubes.contacts(frame);
      ASSERT_FALSE(found.empty());
      for (const Contact& c : found) EXPECT_NEAR(c.normal.x, 1, 1e-6);
      EXPECT_NEAR(found[0].depth, 0.65, cubes.tolerance(frame));
    }
  }
}

// Where rounding takes one to be inside the other, no edge of the outer one is crossed. What leads
// out along the axis are pairs of edges of rings, of which each triangle of a facet has one; by the
// faces of the tube the way out is 0.64 m.
TEST(Manifolds, MoveATorusInItsOwnPlaceOutAlongItsAxis) {
  const TestMesh torus = make_torus(0.5, 0.2, 24, 12);
  const Placed tori{torus, torus, at(0, 0, 0), at(0, 0, 0)};
  for (const TestPose& frame : some_frames(60)) {
    const auto found = tori.contacts(frame);
    ASSERT_FALSE(found.empty());
    EXPECT_LT(found[0].depth, 0.4 + tori.tolerance(frame));
  }
}

// Its near side, which is 0.4 m deep, would add nothing to the far one behind it.
TEST(Manifolds, MoveABodyOutByItsDeepestSide) {
  const Placed cubes{make_cube(0.6), make_cube(2), at(0.3, 0.1, -0.05), at(0, 0, 0)};
  for (const TestPose& frame : some_frames()) {
    const auto found = cubes.contacts(frame);
    EXPECT_EQ(found.size(), 4u);
    for (const Contact& c : found) {
      EXPECT_NEAR(c.normal.x, 1, 1e-6);
      EXPECT_NEAR(c.depth, 1, cubes.tolerance(frame));
    }
  }
}

TEST(Manifolds, AreThereAtBothPlacesWhereABeamLies) {
  // Two rods on edge, as one mesh, and a beam on edge across them.
  const double depth = 0.01, width = 0.2;
  TestMesh rods = make_rod(1, width);
  const TestPose roll = turned({1, 0, 0}, kRight / 2);
  for (std::size_t i = 0; i < rods.vertices.size(); i += 3) {
    const Point p = rotate(roll, rods.vertex(i / 3));
    for (std::size_t k = 0; k < 3; ++k) rods.vertices[i + k] = static_cast<float>(p[k]);
  }
  rods = merged(moved(rods, {0, 0.7, 0}), moved(rods, {0, -0.7, 0}));
  Placed beam{make_rod(3, width), rods, on_edge(kRight, 1, width), at(0, 0, 0)};
  beam.pa.position[2] = std::numbers::sqrt2 * width - depth;
  for (const TestPose& frame : some_frames()) {
    const auto found = beam.contacts(frame);
    EXPECT_EQ(found.size(), 2u);
    const double middle = width / std::numbers::sqrt2 - depth / 2;
    for (const double y : {-0.7, 0.7})
      EXPECT_TRUE(has(found, {0, y, middle}, {0, 0, 1}, depth, beam.tolerance(frame))) << y;
  }
}

TEST(Manifolds, MoveAPlateUprightDeepInABlockBackUp) {
  const Placed plate{make_box({1, 0.1, 1}), make_cube(2), at(0.05, 0.03, 1.2), at(0, 0, 0)};
  for (const TestPose& frame : some_frames()) {
    const auto found = plate.contacts(frame);
    ASSERT_FALSE(found.empty());
    EXPECT_NEAR(found[0].depth, 0.3, plate.tolerance(frame));
    for (const Contact& c : found) EXPECT_NEAR(c.normal.z, 1, 1e-6);
    EXPECT_FALSE(plate.intersect_after(found[0], found[0].depth + plate.tolerance(frame)));
  }
}

// A level plate, 5 mm thick, 10 mm below the top of a block, whose end reaches askew across the rim
// from a corner just inside one side to beyond the next side. The corner, and where it is finely
// cut its neighbours, leave by the side; the rest of the end is moved out by none but the top.
Placed plate_in_rim(const Point& middle, double angle, int cells) {
  return {make_box({0.3, 0.15, 0.005}, 2 * cells, cells), make_cube(0.2, cells),
          turned({0, 0, 1}, angle, middle), at(0, 0, 0)};
}

void expect_moved_up(const Placed& plate) {
  for (const TestPose& frame : some_frames()) {
    const auto found = plate.contacts(frame);
    ASSERT_FALSE(found.empty());
    EXPECT_NEAR(found[0].depth, 0.01, plate.tolerance(frame));
    EXPECT_NEAR(found[0].normal.z, 1, 1e-6);
  }
}

TEST(Manifolds, MoveALongEdgeOutThatRunsDeepFromAVertexThatIsNot) {
  expect_moved_up(plate_in_rim({0.2265, 0.08538, 0.0925}, 0.219, 1));
}

TEST(Manifolds, MoveVerticesOutThatAreDeepWhereNoEdgeCrosses) {
  expect_moved_up(plate_in_rim({0.23309, -0.00541, 0.0925}, -0.2368, 5));
}

TEST(Manifolds, OfCubesThatCoincideDoNotOpposeOneAnother) {
  Random random(82);
  for (const double slip : {0.0, 1e-9, 1e-6, 1e-3}) {
    for (const int n : {1, 2}) {
      const Point away = slip * random.direction();
      const Placed cubes{make_cube(1, n), make_cube(1, n), at(away[0], away[1], away[2]),
                         at(0, 0, 0)};
      for (const TestPose& frame : some_frames()) {
        const auto found = cubes.contacts(frame);
        ASSERT_FALSE(found.empty()) << slip;
        for (const Contact& c : found)
          for (const Contact& d : found) EXPECT_GT(dot(c.normal, d.normal), -0.5) << slip;
      }
    }
  }
}

void expect_none_opposed(const Placed& bodies, const std::vector<TestPose>& frames) {
  for (const TestPose& frame : frames) {
    const auto found = bodies.contacts(frame);
    ASSERT_FALSE(found.empty());
    for (const Contact& c : found)
      for (const Contact& d : found) EXPECT_GT(dot(c.normal, d.normal), -0.5);
  }
}

// Not turned: where rounding decides which vertices are inside, regions are moved out one by one.
TEST(Manifolds, ThatAreAsFarApartAsTheyAreDeepDoNotOpposeOneAnother) {
  const TestMesh cylinder = make_cylinder(0.4, 1, 16);
  expect_none_opposed({cylinder, cylinder, at(0, 0, 0), at(0, 0, 0)}, {at(0, 0, 0), at(3, -4, 5)});
}

// Rounding makes regions of overlap where surfaces coincide. That they touch at both ends is no
// reason to hold the bricks there.
TEST(Manifolds, OfEqualBricksInOnePlaceAreNoTouchesAtOppositeEnds) {
  const TestMesh brick = make_box({1, 0.5, 0.25});
  expect_none_opposed({brick, brick, at(0, 0, 0), at(0, 0, 0)}, some_frames(60));
}

// Two contacts of one region that push against one another jam the body between them. Of planes
// that are nearly as deep the one is taken that takes less of the moves before it back.
TEST(Manifolds, OfARegionTakeLittleOfOneAnotherBack) {
  Random random(83);
  const TestMesh torus = make_torus(0.4, 0.15, 24, 12);
  double taken_back = 0;
  int pairs = 0;
  for (int i = 0; i < 300; ++i) {
    const TestPose other = random.pose(0.4);
    const auto found = Placed{torus, torus, other, at(0, 0, 0)}.contacts(at(0, 0, 0));
    pairs += found.empty() ? 0 : 1;
    double most = 0;
    for (const Contact& c : found)
      for (const Contact& d : found)
        if (c.region == d.region)
          most = std::max(most, -dot(c.normal, d.normal) * std::min(c.depth, d.depth));
    taken_back += most;
  }
  ASSERT_GT(pairs, 250);
  EXPECT_LT(taken_back / pairs, 0.04);  // 0.037; were planes compared by depth alone, 0.050
}

// The rays from two corners of the small box leave both boxes at the edge they share. Through one
// of the large one's faces there they are 0.18 deep, through the other 0.68; two corners are deeper
// below the former, and out they all go that way.
TEST(Manifolds, OfBoxesThatShareAnEdgeAreNotDeeperThanTheShorterWayThroughIt) {
  const double angle = -5 * std::numbers::pi / 6;
  TestPose pose = composed(turned({0, 1, 0}, angle), at(0.25, 0, 0.25));
  pose.position = pose.position + Point{0.5, 0, 0.5};
  const Placed boxes{make_cube(0.5), make_cube(1), pose, at(0, 0, 0)};
  const double depth = 0.5 * std::sin(kRight / 1.5);
  for (const TestPose& frame : some_frames()) {
    const auto found = boxes.contacts(frame);
    ASSERT_FALSE(found.empty());
    EXPECT_NEAR(found[0].depth, depth, boxes.tolerance(frame));
  }
}

void expect_same_bytes(const ColliderOptions& baseline,
                       const std::vector<ColliderOptions>& others) {
  std::vector<TestMesh> meshes = small_meshes();
  meshes.push_back(make_plate(1.2, 0.02, 2));
  for (std::size_t k = 0; k < others.size(); ++k) {
    Collider expected(baseline), other(others[k]);
    PassMemory memory, other_memory;
    MovingScene moving(meshes, 64, 0.003, 83);
    constexpr auto kCrossings = static_cast<std::size_t>(List::kCrossings);
    std::uint64_t crossings = 0;
    for (int i = 0; i < 6; ++i, moving.advance()) {
      const Bits bits = bits_of(expected.collide(moving.scene(), &memory));
      ASSERT_EQ(bits_of(other.collide(moving.scene(), &other_memory)), bits) << k << ", " << i;
      EXPECT_EQ(other.report().actual[kCrossings], expected.report().actual[kCrossings]);
      crossings += expected.report().actual[kCrossings];
    }
    EXPECT_GT(crossings, 3000u);
  }
}

// What decides how long a step takes must not decide what it gives.
TEST(Manifolds, AreTheSameBytesHoweverTheStepIsCutAndLaunched) {
  ColliderOptions exact, tiles;
  exact.launches = LaunchRule::kExact;
  tiles.tile_vertices = 200;
  tiles.initial_capacity = 1;
  expect_same_bytes({}, {exact, tiles});
}

// Where nothing crosses, there are features all the same.
TEST(Manifolds, OfAPairThatDoesNotCrossAreTheSameBytesHoweverItIsLaunched) {
  const TestScene scene = one_pair(make_cube(0.3), at(0.5, 0.1, -0.05), make_cube(2), at(0, 0, 0));
  ColliderOptions exact;
  exact.launches = LaunchRule::kExact;
  exact.whole_steps = false;
  const Bits expected = bits_of(collider().collide(scene.scene, nullptr));
  EXPECT_FALSE(expected[0].empty());
  Collider exactly(exact);
  EXPECT_EQ(bits_of(exactly.collide(scene.scene, nullptr)), expected);
}

// These list the vertices inside by rays of their own.
TEST(Manifolds, AreTheSameBytesInEveryModeOfThePaper) {
  ColliderOptions in_full, iterative, monolithic, both;
  in_full.count_work = true;
  iterative.rays = both.rays = Rays::kIterative;
  monolithic.organization = both.organization = Organization::kMonolithic;
  expect_same_bytes(in_full, {iterative, monolithic, both});
}

TEST(Manifolds, OfDeformableMeshesAreTheSameBytesHoweverTheyCameToTheirShape) {
  const TriangleSoup sheet = soup_of(make_sheet(1.5, 8)), ball = soup_of(make_icosphere(0.6, 1));
  const auto open = deformable(sheet, 0.05f), closed = deformable(ball);
  Scene scene;
  scene.meshes = {std::make_shared<const Mesh>(build_mesh(soup_of(make_cube(1, 2)))),
                  std::make_shared<const Mesh>(build_mesh(soup_of(make_rod(3, 0.1)))), open,
                  closed};
  for (std::uint32_t i = 0; i < 4; ++i)
    scene.objects.push_back({collider_pose(turned({1, 2, 3}, 0.4 * i, {0.1, 0.05 * i, 0.1})), i});
  scene.pairs = {{0, 2}, {1, 2}, {0, 3}, {1, 3}, {2, 3}};
  const auto shaped = [&](float phase) {
    scene.meshes[2] = deformed(open, bent(sheet, phase));
    scene.meshes[3] = deformed(closed, bent(ball, phase));
  };
  Collider at_once({}), by_and_by({});
  shaped(2);
  const Bits expected = bits_of(at_once.collide(scene, nullptr));
  std::size_t contacts = 0;
  for (const auto& pair : expected) contacts += pair.size();
  EXPECT_GT(contacts, 50u);
  EXPECT_GT(at_once.report().actual[static_cast<std::size_t>(List::kCrossings)], 50u);
  PassMemory memory;
  for (const float phase : {0.0f, 1.0f, 1.9f, 2.0f}) {
    shaped(phase);
    const Bits bits = bits_of(by_and_by.collide(scene, &memory));
    EXPECT_EQ(bits == expected, phase == 2.0f) << phase;
  }
  EXPECT_EQ(bits_of(by_and_by.collide(scene, &memory)), expected) << "at rest";
}

// As a collider that predicts all lists to the last entry.
ColliderOptions tight_options(Misprediction misprediction) {
  ColliderOptions options;
  options.misprediction = misprediction;
  options.rays = Rays::kFull;
  options.prediction = PredictionRule::kPlain;
  options.confidence = 1.0;
  options.initial_capacity = 1;
  options.whole_steps = false;
  return options;
}

// The same but that nothing is predicted.
ColliderOptions whole_options(Misprediction misprediction) {
  ColliderOptions options;
  // What may be lost is never flooded; nor where rays are iterative.
  if (misprediction == Misprediction::kIgnore) options.rays = Rays::kIterative;
  return options;
}

// All lists but this one, which is predicted at 10.
class EdgeLists : public testing::TestWithParam<List> {
 protected:
  std::uint64_t count(const BatchReport& report) const {
    return report.actual[static_cast<std::size_t>(GetParam())];
  }
};

TEST_P(EdgeLists, ThatOverflowAreMendedByRedoing) {
  const TestScene scene = random_scene(100, 84);
  Collider whole({});
  const Bits expected = bits_of(whole.collide(scene.scene, nullptr));
  const BatchReport report = whole.report();
  ASSERT_GT(count(report), 100u);
  Collider redoing(tight_options(Misprediction::kRedo));
  PassMemory memory;
  memory.history = {100, report.actual};
  memory.history.counts[static_cast<std::size_t>(GetParam())] = 10;
  EXPECT_EQ(bits_of(redoing.collide(scene.scene, &memory)), expected);
  EXPECT_EQ(redoing.report().redone, 1);
  EXPECT_EQ(count(redoing.report()), count(report));
  EXPECT_EQ(redoing.report().missed, 0u);
}

TEST_P(EdgeLists, ThatOverflowAreCountedWhereThatIsIgnored) {
  const TestScene scene = random_scene(100, 84);
  Collider whole(whole_options(Misprediction::kIgnore));
  const std::size_t contacts = whole.collide(scene.scene, nullptr).contacts.size();
  const BatchReport report = whole.report();
  Collider ignoring(tight_options(Misprediction::kIgnore));
  PassMemory memory;
  memory.history = {100, report.actual};
  memory.history.counts[static_cast<std::size_t>(GetParam())] = 10;
  const PairContacts& found = ignoring.collide(scene.scene, &memory);
  EXPECT_EQ(found.ranges.size(), 100u);
  EXPECT_LT(found.contacts.size(), contacts);
  EXPECT_GT(found.contacts.size(), contacts / 4) << "those of vertices are all there";
  EXPECT_EQ(ignoring.report().redone, 0);
  EXPECT_EQ(count(ignoring.report()), count(report));
  EXPECT_EQ(ignoring.report().missed, count(report) - 10);
}

// Boxes may overlap by the million where next to nothing crosses.
TEST(MeshletPairs, ThatTheirListHasNoRoomForAreCrossedAtOnce) {
  const TestScene scene = random_scene(100, 84);
  for (const Misprediction misprediction : {Misprediction::kRedo, Misprediction::kIgnore}) {
    Collider whole(whole_options(misprediction));
    const Bits expected = bits_of(whole.collide(scene.scene, nullptr));
    const BatchReport report = whole.report();
    constexpr auto kPairs = static_cast<std::size_t>(List::kMeshletPairs);
    ASSERT_GT(report.actual[kPairs], 100u);
    Collider short_of_room(tight_options(misprediction));
    PassMemory memory;
    memory.history = {100, report.actual};
    memory.history.counts[kPairs] = 10;
    EXPECT_EQ(bits_of(short_of_room.collide(scene.scene, &memory)), expected);
    EXPECT_LT(short_of_room.report().capacity[kPairs], report.actual[kPairs]);
    EXPECT_EQ(short_of_room.report().redone, 0);
    EXPECT_EQ(short_of_room.report().missed, 0u);
    EXPECT_EQ(short_of_room.report().actual, report.actual) << "it is predicted all the same";
  }
}

std::string name_of(const testing::TestParamInfo<List>& info) {
  return info.param == List::kMeshlets ? "Meshlets" : "Crossings";
}

INSTANTIATE_TEST_SUITE_P(Lists, EdgeLists, testing::Values(List::kMeshlets, List::kCrossings),
                         name_of);

}  // namespace
}  // namespace ode_ext::test
