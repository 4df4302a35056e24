// SPDX-License-Identifier: BSD-3-Clause
// Meshes and poses out of a fuzzer's bytes: the shapes of tests/support, soups, and both spoiled in
// every way that a program can spoil them without leaving the arrays it gives to ODE.
#pragma once

#include "fuzz/byte_source.h"
#include "support/mesh_makers.h"

namespace ode_ext::fuzz {

struct DecodedMesh {
  test::TestMesh mesh;  // at least one triangle
  bool solid = false;   // closed, without self-intersections, in one piece, of whatever winding
};

// At most some 500 triangles.
DecodedMesh decode_mesh(ByteSource& bytes);

// One change: a vertex, a triangle, all of it. It may not stay solid. The number of vertices and
// triangles is kept.
void spoil(ByteSource& bytes, DecodedMesh& mesh);

// A rotation and a place, both sound and within 2 m of the origin; or, if `wild`, any numbers.
test::TestPose decode_pose(ByteSource& bytes, bool wild);

// What an independent oracle can judge: finite, of a size between 1 mm and 1 km, and each triangle
// is at least a thousandth of that high.
bool tame(const test::TestMesh& mesh);
bool finite(const test::TestMesh& mesh);
// A rotation and a place within 10 km.
bool tame(const test::TestPose& pose);
bool finite(const test::TestPose& pose);

// Makes of all that is neither finite nor within `limit` [m] of the origin something that is.
void tame_down(test::TestMesh& mesh, double limit);

}  // namespace ode_ext::fuzz
