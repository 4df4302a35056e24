// SPDX-License-Identifier: BSD-3-Clause
// From triangles as a program gives them to vertices that are each there once.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/source_triangles.h"
#include "mesh/triangle.h"
#include "mesh/vec.h"

namespace ode_ext {

struct WeldedMesh {
  std::vector<Vec3f> vertices;      // each place once; -0 is stored as +0
  std::vector<Triangle> triangles;  // in the program's order, without those that collapsed
  std::vector<std::uint32_t> source_triangle;
  // For each corner of the source its vertex; kNone for those of triangles that collapsed.
  std::vector<std::uint32_t> corner_vertex;
};

enum class VertexOrder {
  kRuns,    // compact ones (runs.h); does not depend on the order of the triangles
  kListing  // as the program first lists them; does not depend on where they are
};

// Corners at exactly the same place become one vertex; a triangle with two equal corners collapses
// and is dropped (a sliver with three different ones is kept: its edges hold its neighbours
// together). All corners must be finite.
WeldedMesh weld(const SourceTriangles& source, VertexOrder order = VertexOrder::kRuns);

// Whether no two are at the same place. All must be finite, and none -0.
bool are_apart(const std::vector<Vec3f>& vertices);

// Numbers the triangles by their vertices, and begins each with its lowest, so that nothing depends
// on the order in which the program lists triangles, or the corners of one.
void order_by_vertices(WeldedMesh& mesh);

// In that order triangles with the same corners follow one another, those of one winding first: the
// first after them.
std::size_t end_of_same_corners(const std::vector<Triangle>& triangles, std::size_t first);

// Leaves triangles out, and vertices that none has then.
void leave_out(const std::vector<bool>& is_left_out, WeldedMesh& mesh);

}  // namespace ode_ext
