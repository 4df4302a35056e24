// SPDX-License-Identifier: BSD-3-Clause
// Convex meshes pressed into each other by a share of their size, turned anyhow, from any side.
#pragma once

#include "bench/accuracy/known_pair.h"

namespace ode_ext::accuracy {

struct PressedPair {
  test::TestPose pa, pb;
  test::WayOut out;  // a's
  double size;       // [m] of the smaller
};

// A random direction is drawn, and `a` comes along it until its least separation is `share` of the
// smaller one's size, within a thousandth.
PressedPair press_together(const Body& a, const Body& b, double share, test::Random& random);

// Whether libccd, asked for the same, says another depth (by more than a hundredth): once in
// hundreds it stops too early, which is why the truth is not taken from it alone.
bool libccd_differs(const Body& a, const Body& b, const PressedPair& pair);

}  // namespace ode_ext::accuracy
