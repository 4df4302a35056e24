// SPDX-License-Identifier: BSD-3-Clause
// Small meshes and poses for tests. Closed ones are wound counter-clockwise seen from outside.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "support/points.h"

namespace ode_ext::test {

struct TestMesh {
  std::vector<float> vertices;    // xyz, xyz, ... [m]
  std::vector<unsigned> indices;  // three a triangle

  int vertex_count() const { return static_cast<int>(vertices.size() / 3); }
  int triangle_count() const { return static_cast<int>(indices.size() / 3); }
  Point vertex(std::size_t i) const {
    return {vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2]};
  }
  // Corner 0..2 of a triangle.
  Point corner(std::size_t triangle, std::size_t i) const {
    return vertex(indices[3 * triangle + i]);
  }
};

// Rigid placement: world = rotation * local + position, rotation row-major.
struct TestPose {
  Point position{};
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
};

Point rotate(const TestPose& pose, const Point& v);
Point rotate_back(const TestPose& pose, const Point& v);
Point to_world(const TestPose& pose, const Point& local);
Point to_local(const TestPose& pose, const Point& world);
TestPose at(double x, double y, double z);
// `angle` [rad] about `axis` (any length), then moved to `position`.
TestPose turned(const Point& axis, double angle, const Point& position = {});
// `inner` placed in the frame of `outer`.
TestPose composed(const TestPose& outer, const TestPose& inner);

// Full extents [m] and subdivisions along each axis; vertices on edges are shared.
TestMesh make_box(const Point& extents, int nx = 1, int ny = 1, int nz = 1);
TestMesh make_cube(double size, int n = 1);                 // n x n quads a face
TestMesh make_plate(double size, double thickness, int n);  // flat in z, n x n quads
TestMesh make_rod(double length, double width);             // along x, square section
TestMesh make_icosphere(double radius, int subdivisions);   // 20 * 4^subdivisions triangles
TestMesh make_torus(double ring, double tube, int around, int across);  // about z
TestMesh make_tetrahedron(double edge);                                 // regular, centred
TestMesh make_cylinder(double radius, double height, int sides);        // a prism about z
TestMesh make_l(double size);  // a concave prism: a 2 x 2 square less one quarter, about 0
// A bar along x with `teeth` >= 1 teeth up +z, as wide as the gaps and the bar is thick; about 0.
TestMesh make_comb(int teeth, double width, double height, double depth);
TestMesh make_sheet(double size, int n);  // open, in z = 0, facing +z
TestMesh make_waves(double size, int n);  // such a sheet with hills, 0.2 high and deep
TestMesh make_triangle(double size);      // one triangle in z = 0, facing +z
// Triangles as large as all of it, in a cube of 2 m about 0, each of corners of its own.
TestMesh make_soup(int triangles, std::uint64_t seed);

TestMesh opened(TestMesh mesh, double z);  // its faces at that height left out
TestMesh inverted(TestMesh mesh);          // every triangle wound the other way
TestMesh scaled(TestMesh mesh, double factor);
TestMesh moved(TestMesh mesh, const Point& offset);     // in its own frame, rounded to float
TestMesh merged(const TestMesh& a, const TestMesh& b);  // b's triangles follow a's
// The same, far out in a mesh that a tetrahedron on the other side of its origin makes as large.
TestMesh far_out(const TestMesh& mesh, const Point& far);
TestMesh unshared(const TestMesh& mesh);  // every triangle with corners of its own

// Largest extent of the bounding box [m].
double mesh_size(const TestMesh& mesh);

// splitmix64 (Steele, Lea, Flood 2014): the same numbers with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next();
  double uniform(double lo, double hi);  // in [lo, hi)
  int below(int n);                      // in [0, n)
  Point direction();                     // unit, uniform on the sphere
  // Uniform over all rotations; the position in a cube of the given half extent about 0.
  TestPose pose(double half_extent);

 private:
  std::uint64_t state_;
};

}  // namespace ode_ext::test
