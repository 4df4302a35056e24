// SPDX-License-Identifier: BSD-3-Clause
// What bodies are made of: a closed mesh and, where it is one, the box with the same faces.
#pragma once

#include <optional>

#include "support/mesh_makers.h"

namespace ode_ext::stability {

using namespace test;  // points, poses and mesh makers: the words in which the trials are written

struct Shape {
  TestMesh mesh;
  std::optional<Point> box;  // its extents [m], about the origin
};

// Its faces cut into n x n quads in x and y.
Shape box_shape(const Point& extents, int n = 1);

// A mesh moved so that its centre of mass is at the origin.
Shape solid_shape(const TestMesh& mesh);

// Of the enclosed solid.
Point centre_of_mass(const TestMesh& mesh);

}  // namespace ode_ext::stability
