// SPDX-License-Identifier: BSD-3-Clause
// Where edges cross triangles, as an oracle: brute force, double precision, no shared code.
#pragma once

#include <vector>

#include "reference/reference_mesh.h"

namespace ode_ext::test {

struct ReferenceEdge {
  std::array<std::size_t, 2> vertices;  // of the ReferenceMesh; the first is less, coordinate-wise
  bool doubtful;                        // whether it is worth casting is for rounding to decide
};

// The edges that surfaces bend or end at: those whose triangles surely are of different facets.
// Two of one facet differ by less than 0.1 degrees each from a third.
std::vector<ReferenceEdge> reference_edges(const ReferenceMesh& mesh);

struct ReferenceCrossing {
  int side;        // 0: an edge of a across b; 1: an edge of b across a
  Point from, to;  // the edge, in its own frame; from is less than to
  int triangle;    // of the other mesh, as in its TestMesh
  double t;        // [m] from `from` along the edge
  double blur;     // [m] by how much single precision may move it along the edge
  bool leaves;     // through a back face
  bool ambiguous;  // single precision may decide otherwise
};

// A mesh that is put to many pairs.
struct ReferenceSurface {
  explicit ReferenceSurface(const TestMesh& mesh);

  ReferenceMesh mesh;
  std::vector<ReferenceEdge> edges;
  double size;  // [m] the largest side of its box
};

// Of all edges worth casting with all triangles of the other mesh. `epsilon` [m]: by how much
// single precision may move a coordinate. `growth` [m]: how far the vertices of `a` are taken out
// along their normals. What is farther apart than a hundredth of both meshes' sizes is passed over.
std::vector<ReferenceCrossing> reference_crossings(const ReferenceSurface& a, const TestPose& pa,
                                                   const ReferenceSurface& b, const TestPose& pb,
                                                   double epsilon, double growth = 0);
// With the comparison_tolerance (reference_hits.h) of the pair.
std::vector<ReferenceCrossing> reference_crossings(const TestMesh& a, const TestPose& pa,
                                                   const TestMesh& b, const TestPose& pb);

}  // namespace ode_ext::test
