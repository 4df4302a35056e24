// SPDX-License-Identifier: BSD-3-Clause
#include "reference/contact_pair.h"

#include <cmath>

#include "reference/contact_constants.h"

namespace ode_ext::test {

ContactPair::ContactPair(const ContactMesh& a, const TestPose& pa, const ContactMesh& b,
                         const TestPose& pb)
    : meshes_{&a, &b}, poses_{pa, pb} {
  const double extent = 2 * (a.radius + b.radius) + distance(pa.position, pb.position);
  epsilon_ = kContactEpsilon * extent;
  offset_ =
      rotate_back(pb, pa.position - pb.position) + kContactShift * extent * kContactShiftDirection;
  for (std::size_t v = 0; v < a.vertices.size(); ++v)
    points_[0].push_back(turned_from_a(a.vertices[v] + epsilon_ * a.offsets[v]) + offset_);
  points_[1] = b.vertices;
  for (const std::size_t side : {0u, 1u})
    for (const Point& p : points_[side]) boxes_[side].add(p);
}

Point ContactPair::turned_from_a(const Point& direction) const {
  return rotate_back(poses_[1], rotate(poses_[0], direction));
}

Point ContactPair::turned_into(std::size_t side, const Point& direction) const {
  return side == 1 ? direction : rotate_back(poses_[0], rotate(poses_[1], direction));
}

Point ContactPair::into(std::size_t side, const Point& p) const {
  return side == 1 ? p : turned_into(0, p - offset_);
}

Point ContactPair::normal(std::size_t side, std::size_t facet) const {
  const Point& own = meshes_[side]->facets[facet].normal;
  return side == 1 ? own : turned_from_a(own);
}

double ContactPair::top(std::size_t side, std::size_t facet) const {
  const ContactFacet& f = meshes_[side]->facets[facet];
  return side == 1 ? f.top : f.top + epsilon_ * f.lift + dot(normal(0, facet), offset_);
}

Point ContactPair::vertex_normal(std::size_t side, std::size_t v) const {
  const Point& own = meshes_[side]->vertex_normals[v];
  return side == 1 ? own : turned_from_a(own);
}

Point ContactPair::to_world(const Point& p) const { return test::to_world(poses_[1], p); }

Point ContactPair::turned_to_world(const Point& direction) const {
  return rotate(poses_[1], direction);
}

// The sum of the triangles' solid angles (van Oosterom and Strackee 1983).
bool ContactPair::is_inside(std::size_t side, const Point& p) const {
  for (std::size_t k = 0; k < 3; ++k)
    if (!(p[k] >= boxes_[side].low[k] && p[k] <= boxes_[side].high[k])) return false;
  double halves = 0;
  for (std::size_t t = 0; t < meshes_[side]->triangles.size(); ++t) {
    const Point a = corner(side, t, 0) - p, b = corner(side, t, 1) - p, c = corner(side, t, 2) - p;
    const double la = length(a), lb = length(b), lc = length(c);
    halves += std::atan2(dot(a, cross(b, c)),
                         la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return halves > std::numbers::pi;
}

// A direction that meshes seldom have edges along.
bool ContactPair::is_within(std::size_t side, const Point& p) const {
  int winding = 0;
  for (const TriangleHit& hit :
       meshes_[side]->tree.along(into(side, p), turned_into(side, unit({0.31, 0.83, 0.47}))))
    winding += hit.back ? 1 : -1;
  return winding > 0;
}

}  // namespace ode_ext::test
