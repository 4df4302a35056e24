// SPDX-License-Identifier: BSD-3-Clause
// In how many separate places do two meshes overlap, and where: in double precision, from triangle
// pairs that somebody else found, and independently of the library.
//
// The surfaces meet along curves. A curve is a chain of crossings, each of an edge of one mesh with
// a triangle of the other; the two ends of the segment that two triangles have in common are on the
// same curve. (That two triangle pairs are neighbours is not enough: both slopes of a roof can dip
// into one triangle without the ridge between them.) A part of the overlap can have several curves:
// a rod through a wall has one where it enters and one where it leaves. Such curves are joined by
// what of either surface is inside the other: the edges of the rod within the wall, and within a
// triangle the way from a closed curve to what is around it. An open mesh has no inside, so it
// joins nothing.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "support/mesh_makers.h"
#include "support/surface_graph.h"

namespace ode_ext::test {

// A triangle of the first mesh and one of the second.
using TrianglePair = std::array<unsigned, 2>;

// The box of a region in the frame of the second mesh: of its curves and of the vertices inside.
struct Region {
  Point low, high;

  double size() const { return largest_component(high - low); }
  // Whether the segment from p to q comes within `margin` [m] of the box (measured along the axes).
  bool is_near(const Point& p, const Point& q, double margin) const;
};

// Closed meshes are wound outwards. `pairs` must hold all pairs of triangles that meet; others do
// no harm.
std::vector<Region> find_regions(const SurfaceGraph& a, const TestPose& pa, const SurfaceGraph& b,
                                 const TestPose& pb, std::span<const TrianglePair> pairs);

}  // namespace ode_ext::test
