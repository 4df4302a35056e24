// SPDX-License-Identifier: BSD-3-Clause
// Convex meshes for tests, closed and wound counter-clockwise seen from outside.
#pragma once

#include <vector>

#include "support/mesh_makers.h"

namespace ode_ext::test {

TestMesh make_octahedron(double radius);
TestMesh make_cone(double radius, double height, int sides);    // about z, its apex at +z
TestMesh make_ellipsoid(const Point& radii, int subdivisions);  // 20 * 4^subdivisions triangles
// Of points in general position, no four in a plane; those inside are left out.
TestMesh make_hull(const std::vector<Point>& points);
// Of `count` points between 0.6 and 1 times `radius` from 0.
TestMesh make_random_hull(Random& random, int count, double radius);

}  // namespace ode_ext::test
