// SPDX-License-Identifier: BSD-3-Clause
// Do the surfaces of two meshes intersect, does one contain the other: answered by FCL and by
// winding numbers, in double precision and independently of the library.
#pragma once

#include "support/mesh_makers.h"

namespace ode_ext::test {

enum class OracleAnswer {
  Apart,
  Intersect,
  Fragile  // moving one mesh by 1e-5 of the pair's size along some axis changes the answer
};

bool surfaces_intersect(const TestMesh& a, const TestPose& pa, const TestMesh& b,
                        const TestPose& pb);

OracleAnswer surfaces_intersect_robustly(const TestMesh& a, const TestPose& pa, const TestMesh& b,
                                         const TestPose& pb);

// How often the mesh winds around a point of its own frame: 1 inside a closed outward mesh, -1 in
// an inverted one, 0 outside (van Oosterom and Strackee 1983: the sum of the triangles' solid
// angles).
double winding_number(const TestMesh& mesh, const Point& point);

// Whether the first vertex of one mesh is inside the other; both closed.
bool one_contains_the_other(const TestMesh& a, const TestPose& pa, const TestMesh& b,
                            const TestPose& pb);

}  // namespace ode_ext::test
