// SPDX-License-Identifier: BSD-3-Clause
// The least separation of each other of two convex polyhedra, exactly: it is along the normal of a
// face of their Minkowski difference, and each of these belongs to a face of one of the two or to
// an edge of either. All are tried.
#pragma once

#include <vector>

#include "support/mesh_makers.h"

namespace ode_ext::test {

// Of a convex closed outward mesh whose triangles share their vertices.
class ConvexSolid {
 public:
  explicit ConvexSolid(const TestMesh& mesh);

  struct Edge {
    Point from, to;
    Point left, right;  // the outward normals of its two faces
  };
  const std::vector<Point>& vertices() const { return vertices_; }
  const std::vector<Point>& normals() const { return normals_; }
  const std::vector<Edge>& edges() const { return edges_; }  // none within flat faces

  // Everything placed, relative to `origin`.
  ConvexSolid placed(const TestPose& pose, const Point& origin) const;

 private:
  ConvexSolid() = default;

  std::vector<Point> vertices_;
  std::vector<Point> normals_;
  std::vector<Edge> edges_;
};

struct WayOut {
  double depth = 0;   // [m] negative: apart
  Point direction{};  // unit, world: moving a by depth * direction brings the two to touch
};

// To about 1e-5 of the sizes: edges that bend by less than that [rad] count as flat.
WayOut shortest_way_out(const ConvexSolid& a, const TestPose& pa, const ConvexSolid& b,
                        const TestPose& pb);

// How far a has to go along a unit direction until it touches b from there [m].
double way_out_along(const Point& direction, const ConvexSolid& a, const TestPose& pa,
                     const ConvexSolid& b, const TestPose& pb);

}  // namespace ode_ext::test
