// SPDX-License-Identifier: BSD-3-Clause
// An indexed triangle mesh as ODE takes it, and what one asks of it before a body is made from it.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace falling_objects {

using Point = std::array<double, 3>;
using Corners = std::array<Point, 3>;

struct TriangleMesh {
  std::vector<float> vertices;    // x, y, z of each vertex [m]
  std::vector<unsigned> indices;  // three per triangle, counter-clockwise seen from outside

  std::size_t vertex_count() const { return vertices.size() / 3; }
  std::size_t triangle_count() const { return indices.size() / 3; }
  Point vertex(std::size_t i) const;
  Corners corners(std::size_t triangle) const;

  unsigned add_vertex(const Point& p);
  void add_triangle(unsigned a, unsigned b, unsigned c);
  // The quad a, b, c, d (counter-clockwise from outside) as two triangles.
  void add_quad(unsigned a, unsigned b, unsigned c, unsigned d);
};

// Every directed edge occurs once, and so does its reverse.
bool is_closed(const TriangleMesh& mesh);

// [m^3], positive if the mesh is closed and wound outwards.
double signed_volume(const TriangleMesh& mesh);

// [m^2] of the smallest triangle.
double smallest_area(const TriangleMesh& mesh);

// Centre of mass of the enclosed volume, or the mean of the vertices if that is not `closed`.
Point centre(const TriangleMesh& mesh, bool closed);

// Largest distance of a vertex from the origin [m].
double bounding_radius(const TriangleMesh& mesh);

// Merges vertices that are exactly equal and drops the triangles that collapse by it.
void weld(TriangleMesh& mesh);

void turn_inside_out(TriangleMesh& mesh);

void scale_mesh(TriangleMesh& mesh, double factor);

// Moves the centre to the origin and returns where it was [m]. What is centred but for rounding
// stays as it is.
Point center_on_mass(TriangleMesh& mesh);

// Moves the centre to the origin, then scales the bounding radius about it to `radius` [m].
void normalise(TriangleMesh& mesh, double radius);

}  // namespace falling_objects
