// SPDX-License-Identifier: BSD-3-Clause
#include "support/convex_solid.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace ode_ext::test {
namespace {

constexpr double kFlat = 1e-5;  // [rad]
// [rad] Edges this parallel span no face but a sliver next to another's; rounding would decide
// where it lies, and of an edge and its copy whether there is any.
constexpr double kParallel = 1e-7;

double farthest(const std::vector<Point>& points, const Point& direction) {
  double best = -std::numeric_limits<double>::infinity();
  for (const Point& p : points) best = std::max(best, dot(p, direction));
  return best;
}

// How far a has to go along d until it touches b from there; both in one frame.
double way_along(const Point& d, const ConvexSolid& a, const ConvexSolid& b) {
  return farthest(b.vertices(), d) + farthest(a.vertices(), -1 * d);
}

// An edge of b and one of a span a face of the Minkowski difference exactly if the arc between the
// normals of the first and the mirrored arc between those of the second cross on the unit sphere.
bool arcs_cross(const ConvexSolid::Edge& b, const ConvexSolid::Edge& a) {
  const Point along_b = cross(b.left, b.right), along_a = cross(a.left, a.right);
  const double left = -dot(a.left, along_b), right = -dot(a.right, along_b);
  if (left * right >= 0) return false;  // a's arc is on one side of b's great circle
  const double b_left = dot(b.left, along_a), b_right = dot(b.right, along_a);
  if (b_left * b_right >= 0) return false;
  // The great circles cross twice, opposite to each other; the arcs have to be at the same place.
  return left * b_right > 0;
}

void keep_shorter(WayOut& best, double depth, const Point& direction) {
  if (depth < best.depth) best = {depth, direction};
}

}  // namespace

ConvexSolid::ConvexSolid(const TestMesh& mesh) {
  for (std::size_t i = 0; i < mesh.vertices.size() / 3; ++i) vertices_.push_back(mesh.vertex(i));
  std::map<std::pair<unsigned, unsigned>, std::size_t> faces;  // by directed edge
  for (std::size_t t = 0; t < mesh.indices.size() / 3; ++t) {
    const Point a = mesh.corner(t, 0);
    normals_.push_back(unit(cross(mesh.corner(t, 1) - a, mesh.corner(t, 2) - a)));
    for (std::size_t k = 0; k < 3; ++k)
      faces[{mesh.indices[3 * t + k], mesh.indices[3 * t + (k + 1) % 3]}] = t;
  }
  for (const auto& [ends, face] : faces) {
    if (ends.first > ends.second) continue;
    const Point &left = normals_[face], &right = normals_[faces.at({ends.second, ends.first})];
    if (length(cross(left, right)) < kFlat) continue;
    edges_.push_back({vertices_[ends.first], vertices_[ends.second], left, right});
  }
}

ConvexSolid ConvexSolid::placed(const TestPose& pose, const Point& origin) const {
  const Point offset = pose.position - origin;
  ConvexSolid solid;
  for (const Point& p : vertices_) solid.vertices_.push_back(rotate(pose, p) + offset);
  for (const Point& n : normals_) solid.normals_.push_back(rotate(pose, n));
  for (const Edge& e : edges_) {
    solid.edges_.push_back({rotate(pose, e.from) + offset, rotate(pose, e.to) + offset,
                            rotate(pose, e.left), rotate(pose, e.right)});
  }
  return solid;
}

WayOut shortest_way_out(const ConvexSolid& local_a, const TestPose& pa, const ConvexSolid& local_b,
                        const TestPose& pb) {
  const ConvexSolid a = local_a.placed(pa, pb.position), b = local_b.placed(pb, pb.position);
  WayOut best{std::numeric_limits<double>::infinity(), {}};
  for (const Point& n : b.normals()) keep_shorter(best, way_along(n, a, b), n);
  for (const Point& n : a.normals()) keep_shorter(best, way_along(-1 * n, a, b), -1 * n);
  for (const ConvexSolid::Edge& eb : b.edges()) {
    for (const ConvexSolid::Edge& ea : a.edges()) {
      if (!arcs_cross(eb, ea)) continue;
      const Point across = cross(unit(eb.to - eb.from), unit(ea.to - ea.from));
      if (length(across) < kParallel) continue;
      const Point along = unit(across);
      const Point d = dot(along, eb.left + eb.right) > 0 ? along : -1 * along;
      keep_shorter(best, dot(d, eb.from - ea.from), d);
    }
  }
  return best;
}

double way_out_along(const Point& direction, const ConvexSolid& a, const TestPose& pa,
                     const ConvexSolid& b, const TestPose& pb) {
  return way_along(direction, a.placed(pa, pb.position), b.placed(pb, pb.position));
}

}  // namespace ode_ext::test
