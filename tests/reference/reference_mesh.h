// SPDX-License-Identifier: BSD-3-Clause
// What a ray caster needs to know of a mesh, worked out slowly in double precision.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "support/mesh_makers.h"

namespace ode_ext::test {

struct ReferenceMesh {
  std::vector<Point> vertices;                        // welded by exact equality, as first met
  std::vector<Point> normals;                         // unit, outward, weighted by angle
  std::vector<double> exits;                          // [m] where the ray along -normal leaves
  std::vector<bool> doubtful;                         // normal or exit depends on rounding
  std::vector<std::array<std::size_t, 3>> triangles;  // turned outwards; without collapsed ones
  std::vector<int> source_triangle;                   // of each triangle, its index in TestMesh
  std::vector<Point> face_normals;                    // unit; zero where the area is zero
  bool closed = false;    // every edge has exactly two triangles, of opposite direction
  bool inverted = false;  // closed, and its volume was negative
  double mean_edge = 0;   // [m]
  double reach = 0;       // [m] largest coordinate
};

// `open_thickness` [m] bounds the exits of an open mesh; 0: its mean edge.
ReferenceMesh reference_mesh(const TestMesh& mesh, double open_thickness = 0);

// Where a line origin + t * direction meets a triangle's plane, and how safely within the triangle.
struct Crossing {
  double t;              // [m]; may be negative
  double facing;         // direction . face normal; > 0: a back face
  double margin;         // [m] from the crossing to the nearest edge; < 0: outside
  std::size_t triangle;  // of the ReferenceMesh
};

// All triangles that the whole line meets or passes within `slack` [m] of, ordered by t, then by
// index. Planes (nearly) parallel to the line are not met.
std::vector<Crossing> crossings(const ReferenceMesh& mesh, const Point& origin,
                                const Point& direction, double slack);

// A bound [m] on where single precision may put a point whose coordinates are up to `reach`: a
// rotation and translation are some eight roundings of 2^-24 relative each, doubled for the ray.
constexpr double rounding_bound(double reach) { return 16 * reach / (1 << 24); }

}  // namespace ode_ext::test
