// SPDX-License-Identifier: BSD-3-Clause
// Normals of faces and vertices.
#pragma once

#include <vector>

#include "mesh/bvh.h"
#include "mesh/vec.h"

namespace ode_ext {

// Unit normal of a triangle, zero where its area is zero.
Vec3d face_normal(Vec3f a, Vec3f b, Vec3f c);
// The same whichever corner is its first, bit for bit.
Vec3f face_normal(const std::vector<Vec3f>& vertices, const Triangle& triangle);

struct Normals {
  std::vector<Vec3f> faces;     // as face_normal
  std::vector<Vec3f> vertices;  // unit; zero where all incident faces have zero area
};

// A vertex gets the sum of its faces' normals weighted by their angles there, which does not depend
// on how a flat face is cut into triangles (Thuermer and Wuethrich 1998); where they cancel out, as
// on a two-sided sheet, the normal of the largest face. Independent of the order of the triangles
// and of their first corners, bit for bit.
Normals compute_normals(const std::vector<Vec3f>& vertices, const std::vector<Triangle>& triangles);

}  // namespace ode_ext
