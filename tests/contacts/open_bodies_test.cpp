// SPDX-License-Identifier: BSD-3-Clause
// Open bodies on open ground: of the two that is the ground which is larger and nearly flat.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "contacts/bowl.h"
#include "contacts/lowered.h"
#include "contacts/placed.h"
#include "contacts/upright.h"

namespace ode_ext::test {
namespace {

// Neither has an inside, and what of the bowl is beyond where they cross had rays as long as its
// edges, along which it may meet nothing of the ground: contacts of no depth in 376 of these 720
// poses.
TEST(OpenBodies, AreHeldByOpenGroundAsDeepAsTheyAre) {
  Random random(37);
  for (const bool is_inverted : {false, true})
    for (const int rows : {3, 6, 12})
      for (const int cells : {2, 40})
        for (const double depth : {0.003, 0.01, 0.03}) {
          const TestMesh outward = make_bowl(rows, 3 * rows + 2);
          const TestMesh bowl = is_inverted ? inverted(outward) : outward;
          for (int i = 0; i < 20; ++i) {
            TestPose pose = tilted(random, std::numbers::pi, TestPose{});
            pose.position = {0.01, 0.02, -lowest_of(bowl, pose)[2] - depth};
            const Placed placed{bowl, make_sheet(4, cells), pose, TestPose{}};
            const TestPose frame = i % 2 == 0 ? TestPose{} : random.pose(2);
            const std::vector<Contact> found = placed.contacts(frame);
            EXPECT_NEAR(deepest(found), depth, 1e-3 * depth + placed.tolerance(frame))
                << is_inverted << ", " << rows << " rows, " << cells << " cells";
            for (const Contact& c : found) EXPECT_GT(c.normal.z, 0.99);
          }
        }
}

TestMesh make_hills(double size, int cells) {
  TestMesh hills = make_sheet(size, cells);
  for (std::size_t i = 0; i < hills.vertices.size(); i += 3)
    hills.vertices[i + 2] = static_cast<float>(0.1 * std::sin(3 * hills.vertices[i]) *
                                               std::cos(4 * hills.vertices[i + 1]));
  return hills;
}

// The contacts of a body that was lowered onto hills, tilted by up to `most`, by so much from where
// it touches them.
std::vector<Contact> contacts_on_hills(Random& random, const TestMesh& body, double most,
                                       double by) {
  static const TestMesh hills = make_hills(4, 40);
  static const FclSurface surface(hills);
  TestPose pose = tilted(random, most, TestPose{});
  pose.position = {random.uniform(-1, 1), random.uniform(-1, 1), 0};
  pose = lowered_onto(surface, body, pose, 0.8, -0.3, by);
  return Placed{body, hills, pose, TestPose{}}.contacts(TestPose{});
}

TEST(OpenBodies, AreOutOfOpenHillsByAsMuchAsTheyWereLowered) {
  Random random(38);
  for (const bool is_inverted : {false, true}) {
    const TestMesh outward = make_bowl(6, 20);
    const TestMesh bowl = is_inverted ? inverted(outward) : outward;
    for (const double by : {0.003, 0.01, 0.03})
      for (int i = 0; i < 60; ++i) {
        const std::vector<Contact> found = contacts_on_hills(random, bowl, std::numbers::pi, by);
        EXPECT_GT(deepest(found), 0.2 * by) << is_inverted << ", " << by << ", " << i;
        EXPECT_LT(deepest(found), 2 * by) << is_inverted << ", " << by << ", " << i;
      }
  }
}

// Half of the wall of a cylinder along x, about 0, in one layer.
TestMesh make_half_pipe(double radius, double length, int sides) {
  TestMesh mesh;
  for (const double x : {-0.5 * length, 0.5 * length})
    for (int i = 0; i <= sides; ++i) {
      const double angle = std::numbers::pi * i / sides;
      for (const double v : {x, radius * std::cos(angle), radius * std::sin(angle)})
        mesh.vertices.push_back(static_cast<float>(v));
    }
  const auto n = static_cast<unsigned>(sides) + 1;
  for (unsigned i = 0; i + 1 < n; ++i)
    mesh.indices.insert(mesh.indices.end(), {i, n + i, n + i + 1, i, n + i + 1, i + 1});
  return mesh;
}

// Where the border of the pipe goes through a crest no vertex of it is below that, and the crest
// would go past the faces of the pipe by 0. Of these 600 poses 326 had contacts of less than a
// fifth of the depth, now 8.
TEST(OpenBodies, AreHeldByACrestThatTheirBorderLiesAcross) {
  Random random(39);
  int shallow = 0;
  for (const bool is_inverted : {false, true}) {
    const TestMesh outward = make_half_pipe(0.24, 0.56, 10);
    const TestMesh pipe = is_inverted ? inverted(outward) : outward;
    for (const double by : {0.003, 0.01, 0.03})
      for (int i = 0; i < 100; ++i) {
        const std::vector<Contact> found = contacts_on_hills(random, pipe, std::numbers::pi, by);
        EXPECT_LT(deepest(found), 2 * by) << is_inverted << ", " << by << ", " << i;
        shallow += deepest(found) < 0.2 * by;
      }
  }
  EXPECT_LE(shallow, 8);
}

// A card is flatter than the hills, and smaller. Of these 240 poses 139 had contacts of less than a
// fifth of the depth, now 6.
TEST(OpenBodies, OfOneFaceAreHeldByOpenHills) {
  Random random(40);
  int shallow = 0;
  for (const bool is_inverted : {false, true}) {
    const TestMesh card = is_inverted ? inverted(make_sheet(0.5, 6)) : make_sheet(0.5, 6);
    for (const double by : {0.003, 0.03})
      for (int i = 0; i < 60; ++i) {
        const std::vector<Contact> found = contacts_on_hills(random, card, 1.5, by);
        EXPECT_LT(deepest(found), 2 * by) << is_inverted << ", " << by << ", " << i;
        shallow += deepest(found) < 0.2 * by;
      }
  }
  EXPECT_LE(shallow, 6);
}

// A card in a pose in which all of it is below z = 0, by up to `most`, and how far the lowest of it
// is.
struct Sunk {
  Sunk(Random& random, const TestMesh& card, double most) {
    depth = most * std::pow(10, random.uniform(-1.8, 0));
    pose = tilted(random, depth / 2, TestPose{});
    pose.position = {random.uniform(-1, 1), random.uniform(-1, 1), 0};
    pose.position[2] = -depth - lowest_of(card, pose)[2];
  }
  TestPose pose;
  double depth;
};

// Where it is through it crosses nothing any more, and no part of it is left above: it fell.
TEST(OpenBodies, OfOneFaceAreHeldByGroundThatTheyAreBehindAllOver) {
  Random random(43);
  for (const bool is_inverted : {false, true})
    for (const int card_cells : {1, 6})
      for (const int cells : {2, 40}) {
        const TestMesh upright = make_sheet(0.5, card_cells);
        const TestMesh card = is_inverted ? inverted(upright) : upright;
        for (int i = 0; i < 20; ++i) {
          const Sunk sunk(random, card, 0.007);
          const Placed placed{card, make_sheet(4, cells), sunk.pose, TestPose{}};
          const TestPose frame = i % 2 == 0 ? TestPose{} : random.pose(2);
          const std::vector<Contact> found = placed.contacts(frame);
          EXPECT_GE(found.size(), 3) << card_cells << " in " << cells << " cells, " << i;
          EXPECT_NEAR(deepest(found), sunk.depth, 1e-3 * sunk.depth + placed.tolerance(frame))
              << card_cells << " in " << cells << " cells, " << i;
          for (const Contact& c : found) EXPECT_GT(c.normal.z, 0.99);
        }
      }
}

// Of a card that juts out over the border of the ground the first vertex may be beyond that.
TEST(OpenBodies, OfOneFaceAreHeldUpToTheBorderOfTheGround) {
  Random random(44);
  for (int i = 0; i < 40; ++i) {
    Sunk sunk(random, make_sheet(0.5, 1), 0.007);
    sunk.pose.position[0] = 2;
    const Placed placed{make_sheet(0.5, 1), make_sheet(4, 20), sunk.pose, TestPose{}};
    const std::vector<Contact> found = placed.contacts(TestPose{});
    EXPECT_FALSE(found.empty()) << i;
    for (const Contact& c : found) {
      EXPECT_LT(c.position.x, 2 + placed.tolerance(TestPose{})) << i;
      EXPECT_GT(c.normal.z, 0.99) << i;
    }
  }
}

bool is_apart_from_ground(const TestMesh& body, const TestPose& pose) {
  return Placed{body, make_sheet(4, 20), pose, TestPose{}}.contacts(TestPose{}).empty();
}

// What is on the shelf below, or hangs from there, is not lifted through that above it.
TEST(OpenBodies, AreNotHeldByGroundThatIsNotJustAboveAllOfThem) {
  Random random(45);
  const TestMesh card = make_sheet(0.5, 6), bowl = make_bowl(6, 20);
  for (int i = 0; i < 20; ++i) {
    Sunk sunk(random, card, 0.007);
    sunk.pose.position[2] -= 0.01;
    EXPECT_TRUE(is_apart_from_ground(card, sunk.pose)) << i;
    TestPose leaning = turned({1, 0, 0}, random.uniform(0.05, 1.5), {0, 0, 0});
    leaning.position[2] = lowest_of(card, leaning)[2] - random.uniform(1e-4, 0.004);
    EXPECT_TRUE(is_apart_from_ground(card, leaning)) << i;
    TestPose hanging = tilted(random, std::numbers::pi, TestPose{});
    const TestPose upside_down = composed(turned({1, 0, 0}, std::numbers::pi), hanging);
    hanging.position[2] = lowest_of(bowl, upside_down)[2] - random.uniform(1e-4, 0.004);
    EXPECT_TRUE(is_apart_from_ground(bowl, hanging)) << i;
  }
}

// A curved card would leave by one plane, and be as deep as it is curved, 0.22 m, and thrown.
TEST(OpenBodies, AreNotAsDeepAsTheyAreCurvedWithTheGround) {
  Random random(47);
  const TestMesh hills = make_hills(4, 40), card = make_hills(1, 10);
  for (int i = 0; i < 20; ++i) {
    const double below = random.uniform(5e-4, 0.005);
    const Placed placed{card, hills, at(0, 0, -below), TestPose{}};
    EXPECT_LT(deepest(placed.contacts(TestPose{})), 0.03) << i;
  }
}

// Tiles side by side, also where they meet at the border, or a card beside one. Were it enough that
// some vertex is straight below, 21 of these 40 would be below the ground.
TEST(OpenBodies, AreApartFromGroundBesideThem) {
  Random random(46);
  for (int i = 0; i < 20; ++i) {
    const double gap = i % 2 == 0 ? 0 : random.uniform(1e-4, 0.004);
    const double below = random.uniform(1e-4, 0.004);
    for (const double size : {0.5, 3.0}) {
      const TestPose pose = at(2 + size / 2 + gap, random.uniform(-1, 1), -below);
      EXPECT_TRUE(is_apart_from_ground(make_sheet(size, 6), pose)) << size << ", " << i;
    }
  }
}

// Of two bowls of one layer, one in the other, no point is farther from the other's wall than they
// are out of place. In 93 of the 182 of these poses in which they meet they were sent out past all
// of the other, by up to 0.29 m: a stack of them burst.
TEST(OpenBodies, InTheirLikeAreSentNoFartherThanTheyAreOutOfPlace) {
  Random random(42);
  int crossing = 0;
  for (const bool is_inverted : {false, true})
    for (const int rows : {3, 8}) {
      const TestMesh outward = make_bowl(rows, 3 * rows + 2);
      const TestMesh bowl = is_inverted ? inverted(outward) : outward;
      for (int i = 0; i < 60; ++i) {
        const double up = random.uniform(0.005, 0.06), aside = random.uniform(0, 0.02);
        const double tilt = random.uniform(0, 0.1);
        const TestPose pose = turned({1, 0.3, 0}, tilt, {aside, 0.0007, up});
        if (!surfaces_intersect(bowl, pose, bowl, TestPose{})) continue;
        ++crossing;
        const std::vector<Contact> found =
            Placed{bowl, bowl, pose, TestPose{}}.contacts(TestPose{});
        EXPECT_FALSE(found.empty()) << rows << " rows, " << i;
        EXPECT_LT(deepest(found), std::hypot(aside, up) + 0.3 * tilt) << rows << " rows, " << i;
      }
    }
  EXPECT_GT(crossing, 150);
}

// A tile that is smaller than the bowl on it is no body behind the bowl.
TEST(OpenBodies, AreNotSentAsideByTilesThatAreSmaller) {
  Random random(41);
  for (const bool is_inverted : {false, true})
    for (const double size : {0.1, 0.2, 0.4})
      for (const double depth : {0.003, 0.02})
        for (int i = 0; i < 20; ++i) {
          const TestMesh bowl = is_inverted ? inverted(make_bowl(6, 20)) : make_bowl(6, 20);
          TestPose pose = tilted(random, std::numbers::pi, TestPose{});
          pose.position = {0, 0, -lowest_of(bowl, pose)[2] - depth};
          for (double x = -0.4; x < 0.41; x += size)
            for (double y = -0.4; y < 0.41; y += size) {
              const Placed placed{bowl, make_sheet(size, 2), pose, at(x, y, 0)};
              for (const Contact& c : placed.contacts(TestPose{})) {
                EXPECT_LT(c.depth, 1.5 * depth) << size << ", " << x << ", " << y;
                EXPECT_TRUE(c.normal.z > 0.2 || c.depth < 0.3 * depth) << size << ", " << depth;
              }
            }
        }
}

}  // namespace
}  // namespace ode_ext::test
