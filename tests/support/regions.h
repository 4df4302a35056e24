// SPDX-License-Identifier: BSD-3-Clause
// In how many separate places do two meshes overlap, and where: in double precision, from triangle
// pairs that somebody else found, and independently of the library.
//
// The surfaces meet along curves. A curve is a chain of crossings, each of an edge of one mesh with
// a triangle of the other; the two ends of the segment that two triangles have in common are on the
// same curve. (That two triangle pairs are neighbours is not enough: both slopes of a roof can dip
// into one triangle without the ridge between them.) A part of the overlap can have several curves:
// a rod through a wall has one where it enters and one where it leaves. Such curves are joined by
// what of either surface is inside the other: the edges of the rod within the wall. An open mesh
// has no inside, so it joins nothing.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "support/mesh_makers.h"

namespace ode_ext::test {

// A triangle of the first mesh and one of the second.
using TrianglePair = std::array<unsigned, 2>;

// Vertices, edges and triangles of a mesh whose triangles share their vertices.
class SurfaceGraph {
 public:
  struct Edge {
    unsigned from, to;  // from < to
  };

  explicit SurfaceGraph(const TestMesh& mesh);

  bool closed() const { return closed_; }
  std::span<const Point> vertices() const { return vertices_; }
  std::span<const Edge> edges() const { return edges_; }
  const std::array<unsigned, 3>& corners(unsigned triangle) const { return corners_[triangle]; }
  // The edge from corner k to the next.
  const std::array<unsigned, 3>& edges_of(unsigned triangle) const { return sides_[triangle]; }
  std::span<const unsigned> edges_at(unsigned vertex) const {
    return std::span(at_vertex_)
        .subspan(first_at_[vertex], first_at_[vertex + 1] - first_at_[vertex]);
  }

 private:
  std::vector<Point> vertices_;
  std::vector<Edge> edges_;
  std::vector<std::array<unsigned, 3>> corners_, sides_;
  std::vector<unsigned> at_vertex_, first_at_;
  bool closed_ = true;  // every edge has two triangles
};

// The box of a region in the frame of the second mesh: of its curves and of the vertices inside.
struct Region {
  Point low, high;

  double size() const { return largest_component(high - low); }
  // Whether the segment from p to q comes within `margin` [m] of the box (measured along the axes).
  bool is_near(const Point& p, const Point& q, double margin) const;
};

// `pairs` must hold all pairs of triangles that meet; others do no harm.
std::vector<Region> find_regions(const SurfaceGraph& a, const TestPose& pa, const SurfaceGraph& b,
                                 const TestPose& pb, std::span<const TrianglePair> pairs);

}  // namespace ode_ext::test
