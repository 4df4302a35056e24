// SPDX-License-Identifier: BSD-3-Clause
// Bodies that touch or nearly do, to within what floats know of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "contacts/placed.h"
#include "support/rig.h"

namespace ode_ext::test {
namespace {

// Along y, open upwards: half a tube of 1 m and 1.1 m, of so many flat strips, each cut at `cuts`.
TestMesh half_pipe(unsigned strips, const std::vector<double>& cuts = {}) {
  TestMesh pipe;
  const unsigned corners = 2 * (strips + 1);  // of a cross section
  std::vector<double> sections{-1};
  sections.insert(sections.end(), cuts.begin(), cuts.end());
  sections.push_back(1);
  for (const double y : sections)
    for (unsigned i = 0; i < corners; ++i) {
      const bool inner = i <= strips;
      const double angle = std::numbers::pi * (inner ? i : corners - 1 - i) / strips;
      const double radius = inner ? 1 : 1.1;
      for (const double x : {-radius * std::cos(angle), y, -radius * std::sin(angle)})
        pipe.vertices.push_back(static_cast<float>(x));
    }
  const auto add = [&](unsigned a, unsigned b, unsigned c) {
    pipe.indices.insert(pipe.indices.end(), {a, b, c});
  };
  const unsigned far = corners * static_cast<unsigned>(cuts.size() + 1);  // the other end
  for (unsigned first = 0; first < far; first += corners)
    for (unsigned i = 0; i < corners; ++i) {
      const unsigned j = (i + 1) % corners;
      add(first + i, first + j, first + j + corners);
      add(first + i, first + j + corners, first + i + corners);
    }
  for (unsigned i = 0; i < strips; ++i) {
    const unsigned a = i, b = i + 1, c = corners - 2 - i, d = corners - 1 - i;
    add(a, d, c), add(a, c, b);
    add(a + far, c + far, d + far), add(a + far, b + far, c + far);
  }
  return pipe;
}

// A square tube about z, from 0 to 2 m, that a block of `inner` [m] fits into.
TestMesh shaft(double inner) {
  TestMesh mesh;
  for (const double size : {0.5, inner})
    for (const double z : {0.0, 2.0})
      for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
        for (const double v : {x * size / 2, y * size / 2, z})
          mesh.vertices.push_back(static_cast<float>(v));
  for (unsigned i = 0; i < 4; ++i) {
    const unsigned j = (i + 1) % 4;
    for (const auto& quad : {std::array{i, j, j + 4, i + 4},
                             {8 + j, 8 + i, 12 + i, 12 + j},
                             {j, i, 8 + i, 8 + j},
                             {4 + i, 4 + j, 12 + j, 12 + i}})
      mesh.indices.insert(mesh.indices.end(),
                          {quad[0], quad[1], quad[2], quad[0], quad[2], quad[3]});
  }
  return mesh;
}

// It lies within 8 um of a strip's ends, a corner of it on the next strip. The ray of that corner
// left the strip where it began, and was taken to leave by the far side of the pipe: the box was
// shot off at 40 m/s.
TEST(Touching, CornersOnAFaceDoNotLeaveByWhatIsMetBehindIt) {
  const Placed placed{make_box({0.1, 0.3, 0.1}), half_pipe(24),
                      turned({0, 1, 0}, std::asin(0.19444953546381402),
                             {-0.16927522218480578, 0, -0.9327223511533145}),
                      TestPose{}};
  const std::vector<Contact> found = placed.contacts(TestPose{});
  EXPECT_FALSE(found.empty());
  for (const Contact& c : found) EXPECT_LT(c.depth, 1e-4);
}

// With a micrometre to spare all round. It was sent out along the shaft, by a hand's breadth.
TEST(Touching, BlocksInAShaftAreNotSentOutAlongIt) {
  Random random(3);
  std::size_t contacts = 0;
  for (const double gap : {0.0, 2e-7, 1e-6}) {
    const double size = 0.2 - 2 * gap, play = std::max(gap, 1e-7);
    for (int i = 0; i < 60; ++i) {
      const auto within = [&](double most) { return random.uniform(-most, most); };
      const TestPose pose =
          turned({0, 0, 1}, within(2e-6), {within(play), within(play), random.uniform(1.86, 2.05)});
      const Placed placed{make_box({size, size, 0.15}), shaft(0.2), pose, TestPose{}};
      for (const Contact& c : placed.contacts(TestPose{})) {
        EXPECT_LT(c.depth, 1e-5) << gap << ", pose " << i << ", along " << c.normal.z;
        ++contacts;
      }
    }
  }
  EXPECT_GT(contacts, 500u);
}

// Where the floor begins to rise nothing holds it back: the floor goes on on both sides.
TEST(Touching, BoxesOverABendOfTheFloorAreNotHeldBack) {
  for (const double bend : {1.0, 5.0, 10.0}) {
    const double rise = std::tan(bend * std::numbers::pi / 180);
    TestMesh floor;
    for (const double y : {-2.0, 2.0})
      for (const auto& [x, z] : {std::pair(-4.0, 0.0),
                                 {0.0, 0.0},
                                 {4.0, 4 * rise},
                                 {4.0, -1.0},
                                 {0.0, -1.0},
                                 {-4.0, -1.0}})
        for (const double v : {x, y, z}) floor.vertices.push_back(static_cast<float>(v));
    for (const unsigned i : {0u, 1u, 2u, 3u, 4u, 5u}) {
      const unsigned j = (i + 1) % 6;
      floor.indices.insert(floor.indices.end(), {i, j, j + 6, i, j + 6, i + 6});
    }
    for (const auto& [a, b, c] : {std::tuple(0u, 5u, 4u), {0u, 4u, 1u}, {1u, 4u, 3u}, {1u, 3u, 2u}})
      floor.indices.insert(floor.indices.end(), {a, b, c, c + 6, b + 6, a + 6});
    for (const double deep : {1e-4, 5e-4, 2e-3})
      for (const double past : {0.1, 0.5, 0.9}) {
        const Placed placed{make_box({0.1, 0.3, 0.1}), floor,
                            at(past * deep - 0.05, 0, 0.05 - deep), TestPose{}};
        const std::vector<Contact> found = placed.contacts(TestPose{});
        EXPECT_GE(found.size(), 4u);
        for (const Contact& c : found) EXPECT_GT(c.normal.z, 0.98) << bend << ", " << deep;
      }
  }
}

// On a groove of two walls that is cut where the front of the box is: a vertex of its bottom is at
// the front for a moment, and to either side of it by less than floats know. It was taken out
// through the front, and the box stopped there.
TEST(Touching, BoxesInAGrooveAreNotHeldBackWhereItIsCut) {
  TestMesh box = make_box({0.12, 0.25, 0.12});  // on an edge
  for (std::size_t i = 0; i < box.vertices.size(); i += 3) {
    const float x = box.vertices[i], z = box.vertices[i + 2];
    box.vertices[i] = (x - z) * std::numbers::sqrt2_v<float> / 2;
    box.vertices[i + 2] = (x + z) * std::numbers::sqrt2_v<float> / 2;
  }
  const double lowest = 0.06 * std::numbers::sqrt2;
  const TestMesh groove = half_pipe(2, {0});
  std::size_t contacts = 0;
  for (const double pitch : {0.0, 1e-3, 0.01, 0.05})
    for (const double deep : {1e-4, 1e-3, 5e-3})
      for (const double past : {-1.5e-6, -1e-6, -5e-7, 1e-7, 1e-6, 5e-6, 0.01 * deep}) {
        // In front, where it is lowest, it is so deep; its front passes the vertex at y = 0.
        const double sine = std::sin(-pitch), cosine = std::cos(pitch);
        const double z = -1 - deep - 0.125 * sine + lowest * cosine;
        const double y = (past - 0.125 - sine * (1 + z)) / cosine;
        const Placed placed{box, groove, turned({1, 0, 0}, -pitch, {0, y, z}), TestPose{}};
        const std::vector<Contact> found = placed.contacts(TestPose{});
        EXPECT_GE(found.size(), 2u);
        EXPECT_GT(deepest(found), 0.5 * deep);
        for (const Contact& c : found)
          EXPECT_LT(std::abs(c.normal.y), 0.1) << pitch << ", " << deep << ", " << past;
        contacts += found.size();
      }
  EXPECT_GT(contacts, 300u);
}

// A body of 0.4 to 5 mm on a block of 100 m, of which coordinates are known to 0.2 mm: where all of
// it was near the surface, and rounding took its first vertex for one inside, the block's top was
// no plane for what was farther above it than a plane clears, and an edge of the block many metres
// away was: of the pairs below 36 had a contact that is deeper than 1 mm.
TEST(Touching, BodiesOfMillimetresOnABlockOf100MetresAreNoDeeperThanTheyAreLarge) {
  const TestMesh block = make_cube(100);
  Random random(100);
  for (const double size : {0.4e-3, 0.8e-3, 1.2e-3, 2e-3, 3.2e-3, 4.8e-3})
    for (const TestMesh& body :
         {make_torus(0.36 * size, 0.12 * size, 16, 8), make_box({size, 0.7 * size, 0.4 * size})})
      for (int i = 0; i < 300; ++i) {
        TestPose pose = random.pose(0);
        double lowest = 0;
        for (int k = 0; k < body.vertex_count(); ++k)
          lowest = std::min(lowest, rotate(pose, body.vertex(static_cast<std::size_t>(k)))[2]);
        pose.position = {random.uniform(-40, 40), random.uniform(-40, 40),
                         random.uniform(-0.1e-3, 0.4e-3) - lowest};
        for (const Placed& placed :
             {Placed{body, block, pose, at(0, 0, -50)}, Placed{block, body, at(0, 0, -50), pose}})
          EXPECT_LT(deepest(placed.contacts(TestPose{})), 1e-3) << size << ", pose " << i;
      }
}

}  // namespace
}  // namespace ode_ext::test
