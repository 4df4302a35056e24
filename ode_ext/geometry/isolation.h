// SPDX-License-Identifier: BSD-3-Clause
// How far around each triangle the surface stays one sheet that faces one way, so that a line which
// meets the triangle there can meet nothing else.
#pragma once

#include <vector>

#include "geometry/bvh.h"
#include "geometry/neighbours.h"
#include "geometry/vec.h"

namespace ode_ext {

// Radii [m] of balls about the middle (a + b + c) / 3 of a triangle; 0: none is known.
//
// Every triangle nearer to the middle than the radius has a normal within the angle of this one's
// and is reached from this one over edges, through triangles that are themselves nearer. A line at
// less than 90 degrees minus the angle to this normal therefore meets triangles of one orientation
// only inside the ball. On a closed mesh that is_embedded (embedded.h) a line leaves and enters in
// turn, so it meets one triangle there at most: whoever found that need not look for an earlier.
//
// The middle may be computed in floats: the radii are smaller by what that can move it.
struct Isolation {
  float within_10 = 0;
  float within_30 = 0;
  float within_60 = 0;
};

// Triangles without area, which no ray hits, neither limit a ball nor get one, but connect. A ball
// is limited, too, to 4 times the distance of its triangle's farthest corner, and to what the
// nearest 40 triangles reach.
std::vector<Isolation> isolation(const std::vector<Vec3f>& vertices,
                                 const std::vector<Triangle>& triangles,
                                 const std::vector<Vec3f>& face_normals, const Bvh& bvh,
                                 const std::vector<Neighbours>& neighbours);

}  // namespace ode_ext
