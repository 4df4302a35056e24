// SPDX-License-Identifier: BSD-3-Clause
// The neighbourhoods of a mesh, for the region oracle.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "support/mesh_makers.h"

namespace ode_ext::test {

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

}  // namespace ode_ext::test
