// SPDX-License-Identifier: BSD-3-Clause
// Every number of the contact formulation, and where it comes from.
#pragma once

#include <numbers>

#include "support/points.h"

namespace ode_ext::test {

// Of the extent of a pair, L = 2 (radius of A + radius of B) + the distance of their origins: what
// a float cannot tell of coordinates up to L. Sixteen units in the last place of L: a rotation and
// a translation are some eight roundings, and twice that is for what is worked out from them.
inline constexpr double kContactEpsilon = 0x1p-20;

// Of L: A is moved by that, so that what coincides even after it was made eps larger (edges that
// run along one another) crosses cleanly. Far above what doubles round (2^-52 L), far below eps, so
// no depth shows it. The direction is unit and has no two components of one size.
inline constexpr double kContactShift = 0x1p-32;
inline constexpr Point kContactShiftDirection{0.36, 0.48, 0.8};

// A vertex moves out by eps / cos to its steepest face, at most by five eps: a needle's point would
// go to infinity.
inline constexpr double kLeastLift = 0.2;

// Depths are reduced by that many eps: by one since A was made larger, and by a quarter so that a
// body at rest keeps touching. Without it, it is pushed until the boxes of the broad phase part,
// and falls for a step.
inline constexpr double kContactSlop = 1.25;

// Triangles that turn away by less from the largest of them are one facet [rad]. A ridge of that
// angle rises less than 1/2300 of the triangles' width above the plane through the far corners.
inline constexpr double kFacetAngle = 0.1 * std::numbers::pi / 180;

// A face looks back along a direction where the cosine between them is less. Chosen: 0 to -0.25
// measure the same, at -0.5 sharp ridges count as ends.
inline constexpr double kLooksBack = -0.1;

// What lies beyond has this many eps more to go than the same depth without: it loses ties.
inline constexpr double kBeyondTie = 4;

// Planes oppose each other beyond 120 degrees, and one that opposes another has to be twice as
// shallow to be chosen. Chosen; it decides ties of legs through one plate.
inline constexpr double kOpposes = -0.5;
inline constexpr double kDetour = 2;

// Depths that differ by no more eps are the same: of units that are as deep the first is cleared
// first. A pair of edges has to be shallower than a face by as much: a face holds at more than one
// place, and of two boxes at rest an edge's axis is shallower by rounding alone. Without it towers
// stand up to 4 of 10 cubes. A factor in its place (ODE's dBoxBox has 1.05) holds them as well, but
// is wrong by as much: angles off by 16 to 18 degrees at the 99th percentile for 1 to 2.
inline constexpr double kDepthTie = 4;

// Contacts of which the normals agree within acos 0.9 = 26 degrees are compared across them.
inline constexpr double kSamePatch = 0.9;

// Of the smaller radius: closer contacts hold a body no better than one.
inline constexpr double kMergeDistance = 0.02;

}  // namespace ode_ext::test
