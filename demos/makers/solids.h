// SPDX-License-Identifier: BSD-3-Clause
// Boxes and solids of revolution. All are closed, wound outwards, and have their middle at the
// origin; lengths are in meters, `sides` are those of a circle.
#pragma once

#include <cstdint>

#include "meshes/triangle_mesh.h"

namespace falling_objects {

// `cells` x `cells` quads a face.
TriangleMesh make_box(double x, double y, double z, unsigned cells);

// About z, as are all that follow.
TriangleMesh make_cylinder(double radius, double height, unsigned sides);
TriangleMesh make_sphere(double radius, unsigned sides);
TriangleMesh make_torus(double ring, double tube, unsigned sides, unsigned tube_sides);
TriangleMesh make_pipe(double outer, double inner, double height, unsigned sides);

// A ball with a cavity: two surfaces, the inner of which nothing outside can reach.
TriangleMesh make_shell(double outer, double inner, unsigned sides);

// An open cup with a flat floor, `wall` thick.
TriangleMesh make_cup(double radius, double height, double wall, unsigned sides);

// A ball with bumps: another for every seed.
TriangleMesh make_rock(double radius, double roughness, unsigned sides, std::uint64_t seed);

}  // namespace falling_objects
