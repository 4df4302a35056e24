// SPDX-License-Identifier: BSD-3-Clause
#include "support/region_cases.h"

#include <cmath>
#include <numbers>

namespace ode_ext::test {
namespace {

using std::numbers::pi;

constexpr double kDip = 0.01;  // [m] how deep parts overlap where they only just do

// Half a degree about an axis of no symmetry: no two faces or edges are parallel by design. Moves a
// corner 1 m away by less than kDip.
TestPose slightly_turned(const TestPose& pose) {
  return composed(pose, turned({0.3, 0.5, 0.8}, 0.5 * pi / 180));
}

// Teeth downwards, dipping into the plane z = 0.
TestPose upside_down(double height) {
  return slightly_turned(turned({1, 0, 0}, pi, {0, 0, 0.5 * height - 2 * kDip}));
}

// The beam's lowest corner is in the block on the left, and its lower ridge lies across the upper
// left edge of the wall on the right.
RegionCase beam_on_block_and_wall() {
  const double left = -0.9, edge = 0.65, edge_height = 0.4, width = 0.2, beam_length = 2.2;
  const double slope = std::atan2(edge_height, edge - left), half_diagonal = width / std::sqrt(2.0);
  const Point along{std::cos(slope), 0, std::sin(slope)}, up{-along[2], 0, along[0]};
  TestPose pose = composed(turned({0, 1, 0}, -slope), turned({1, 0, 0}, pi / 4));
  pose.position = Point{left, 0, -kDip} + 0.5 * beam_length * along + half_diagonal * up;
  const TestMesh block = moved(make_box({0.8, 0.8, 0.4}), {left, 0, -0.2});
  const TestMesh wall = moved(make_box({0.3, 1.2, 1}), {edge + 0.15, 0, edge_height - 0.5});
  return {"BeamOnTheCornerOfItsEndAndAcrossAnEdge",
          make_rod(beam_length, width),
          merged(block, wall),
          pose,
          {},
          2};
}

RegionCase crossed_rods() {
  const double width = 0.5, half_diagonal = width / std::sqrt(2.0);
  const TestPose ridge_up = turned({1, 0, 0}, pi / 4);
  TestPose across = composed(turned({0, 0, 1}, pi / 2), ridge_up);
  across.position = {0.1, 0.2, 2 * half_diagonal - kDip};
  return {"CrossedRods", make_rod(4, width), make_rod(4, width), across, ridge_up, 1};
}

// Its arms, 1 wide and 2 long, point downwards to either side.
RegionCase angle_on_plate() {
  const TestPose arms_down = composed(turned({1, 0, 0}, pi / 2), turned({0, 0, 1}, -3 * pi / 4));
  TestMesh angle = make_l(2);
  double lowest = 0;
  for (int i = 0; i < angle.vertex_count(); ++i) {
    lowest = std::fmin(lowest, rotate(arms_down, angle.vertex(static_cast<std::size_t>(i)))[2]);
  }
  TestPose pose = arms_down;
  pose.position = {0, 0, -lowest - 2 * kDip};
  return {"AngleOnTheEndsOfItsArms", angle, moved(make_plate(6, 0.4, 1), {0, 0, -0.2}),
          slightly_turned(pose),     {},    2};
}

// Two feet of a body, 8 m apart: one stands 3 cm in a floor, the other is 2 cm in a ceiling at the
// same height. What holds the body up must not be left out for what holds it down.
RegionCase lever_between_floor_and_ceiling() {
  const TestMesh foot = make_cube(1);
  const TestMesh block = make_box({3, 3, 1});
  const double dip = 2 * kDip;
  return {"LeverBetweenFloorAndCeiling",
          merged(moved(foot, {-4, 0, 0.5}), moved(foot, {4, 0, kDip - 0.5})),
          merged(moved(block, {-4, 0, dip + kDip - 0.5}), moved(block, {4, 0, kDip - dip + 0.5})),
          {},
          {},
          2};
}

}  // namespace

std::vector<RegionCase> region_cases() {
  const TestMesh plate = moved(make_plate(3, 0.4, 1), {0, 0, -0.2});  // its upper side is z = 0
  const TestMesh bar = moved(make_box({3, 0.1, 0.2}), {0, 0, -0.1});
  const TestMesh wall = moved(make_box({0.1, 3, 0.4}), {0, 0, -0.2});
  const double tube = 0.2;
  const TestPose lying = slightly_turned(at(0.02, 0.03, tube - 2 * kDip));
  return {
      {"CubeOnAPlate", make_cube(1), plate, slightly_turned(at(0.1, 0.2, 0.5 - kDip)), {}, 1},
      {"UOnAPlate", make_comb(2, 0.3, 0.5, 0.4), plate, upside_down(0.8), {}, 2},
      {"UThroughASheet", make_comb(2, 0.3, 0.5, 0.4), make_sheet(3, 1), upside_down(0.6), {}, 2},
      {"CombOfFiveOnABar", make_comb(5, 0.2, 0.4, 0.3), bar, upside_down(0.6), {}, 5},
      {"CombOfTwelveOnABar", make_comb(12, 0.1, 0.3, 0.3), bar, upside_down(0.4), {}, 12},
      {"RingOnAPlate", make_torus(0.8, tube, 24, 12), plate, lying, {}, 1},
      {"RingOnAWall", make_torus(0.8, tube, 24, 12), wall, lying, {}, 2},
      {"RodThroughAWall", make_rod(2, 0.1), wall, slightly_turned(at(0, 0.3, -0.2)), {}, 1},
      {"RodThroughBothSidesOfARing",
       make_rod(3, 0.1),
       make_torus(0.8, tube, 24, 12),
       slightly_turned(at(0.1, 0, 0)),
       {},
       2},
      beam_on_block_and_wall(),
      crossed_rods(),
      angle_on_plate(),
      lever_between_floor_and_ceiling(),
  };
}

}  // namespace ode_ext::test
