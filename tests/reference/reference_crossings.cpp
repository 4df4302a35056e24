// SPDX-License-Identifier: BSD-3-Clause
#include "reference/reference_crossings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "reference/reference_hits.h"

namespace ode_ext::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kSurelyBent = 0.2 * kDegree;
// A float normal is known to 2^-24, so what is less bent than this is meant to be flat.
constexpr double kSurelyFlat = 1e-4 * kDegree;

double angle_between(const Point& a, const Point& b) {
  return std::atan2(length(cross(a, b)), dot(a, b));
}

// From one frame to another without passing through world coordinates, which may be huge.
Point between(const TestPose& from, const TestPose& to, const Point& p) {
  return rotate_back(to, rotate(from, p) + (from.position - to.position));
}

struct Segment {
  Point from, direction;  // in the target's frame; direction: unit
  double length;
};

struct Target {
  const ReferenceMesh& mesh;
  std::vector<Point> vertices;  // where they are taken to be
};

// `epsilon` [m]: what rounding can do to a coordinate; a point within it of a plane may be on
// either side.
void cross_triangle(const Segment& segment, const Target& target, std::size_t triangle,
                    double epsilon, const ReferenceCrossing& edge,
                    std::vector<ReferenceCrossing>& found) {
  if (length(target.mesh.face_normals[triangle]) == 0) return;
  std::array<Point, 3> corners;
  for (std::size_t k = 0; k < 3; ++k)
    corners[k] = target.vertices[target.mesh.triangles[triangle][k]] - segment.from;
  const Point normal = unit(cross(corners[1] - corners[0], corners[2] - corners[0]));
  // An end of the edge and a side of the triangle may each be off, in any direction.
  const double beyond = 4 * epsilon;
  const double facing = dot(segment.direction, normal);
  const double height = dot(normal, corners[0]);
  ReferenceCrossing crossing = edge;
  crossing.triangle = target.mesh.source_triangle[triangle];
  crossing.leaves = facing > 0;

  // The longest side over the height: by so much more a thin triangle's plane is known less well.
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k)
    longest = std::max(longest, distance(corners[k], corners[(k + 1) % 3]));
  const double area = length(cross(corners[1] - corners[0], corners[2] - corners[0]));
  const double thinness = longest * longest / area;
  const double off = epsilon * thinness;

  if (std::fabs(facing) * segment.length < 4 * off) {
    // It runs along the plane: no place where it crosses is known, only that it may, unless all of
    // it is off one side.
    const double near = beyond + 8 * off;
    if (std::fabs(height) > near) return;
    const Point end = segment.length * segment.direction;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point inwards = cross(normal, unit(corners[(k + 1) % 3] - corners[k]));
      const double of_from = -dot(inwards, corners[k]);
      if (std::max(of_from, of_from + dot(inwards, end)) < -near) return;
    }
    crossing.t = 0;
    crossing.blur = segment.length + 2 * beyond;
    crossing.ambiguous = true;
    found.push_back(crossing);
    return;
  }
  crossing.t = height / facing;
  crossing.blur = 2 * off / std::fabs(facing);
  if (crossing.t < -beyond - crossing.blur || crossing.t > segment.length + beyond + crossing.blur)
    return;
  const Point at = crossing.t * segment.direction;
  double margin = longest;
  for (std::size_t k = 0; k < 3; ++k) {
    const Point inwards = cross(normal, unit(corners[(k + 1) % 3] - corners[k]));
    margin = std::min(margin, dot(inwards, at - corners[k]));
  }
  if (margin < -beyond - crossing.blur) return;
  const auto near = [&](double t) { return std::fabs(t) < beyond + crossing.blur; };
  crossing.ambiguous = edge.ambiguous || margin < beyond + crossing.blur || near(crossing.t) ||
                       near(crossing.t - segment.length);
  found.push_back(crossing);
}

struct Bounds {
  Point lo{infinity, infinity, infinity}, hi{-infinity, -infinity, -infinity};

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  void add(const Point& p) {
    for (std::size_t k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], p[k]);
      hi[k] = std::max(hi[k], p[k]);
    }
  }
  bool is_within(const Bounds& other, double margin) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (lo[k] > other.hi[k] + margin || hi[k] < other.lo[k] - margin) return false;
    return true;
  }
};

std::vector<Point> grown(const ReferenceMesh& mesh, double growth) {
  std::vector<Point> vertices = mesh.vertices;
  for (std::size_t v = 0; v < vertices.size(); ++v)
    vertices[v] = vertices[v] + growth * mesh.normals[v];
  return vertices;
}

void cross_side(int side, const ReferenceSurface& source, const TestPose& ps,
                const ReferenceSurface& target, const TestPose& pt, double epsilon, double growth,
                std::vector<ReferenceCrossing>& found) {
  const Target taken{target.mesh, grown(target.mesh, side == 0 ? 0 : growth)};
  const double margin = 0.01 * (source.size + target.size) + 64 * epsilon;
  Bounds all;
  std::vector<Point> there;  // the source's vertices in the target's frame
  for (const Point& vertex : grown(source.mesh, side == 0 ? growth : 0)) {
    there.push_back(between(ps, pt, vertex));
    all.add(there.back());
  }
  std::vector<std::pair<std::size_t, Bounds>> near;  // triangles
  for (std::size_t t = 0; t < target.mesh.triangles.size(); ++t) {
    Bounds bounds;
    for (const std::size_t vertex : target.mesh.triangles[t])
      bounds.add(target.mesh.vertices[vertex]);
    if (bounds.is_within(all, margin)) near.emplace_back(t, bounds);
  }
  for (const ReferenceEdge& edge : source.edges) {
    ReferenceCrossing crossing{};
    crossing.side = side;
    crossing.from = source.mesh.vertices[edge.vertices[0]];
    crossing.to = source.mesh.vertices[edge.vertices[1]];
    crossing.ambiguous = edge.doubtful;
    const Point from = there[edge.vertices[0]];
    const Point along = there[edge.vertices[1]] - from;
    const Segment segment{from, unit(along), length(along)};
    Bounds bounds;
    bounds.add(from);
    bounds.add(from + along);
    for (const auto& [triangle, its_bounds] : near)
      if (its_bounds.is_within(bounds, margin))
        cross_triangle(segment, taken, triangle, epsilon, crossing, found);
  }
}

}  // namespace

std::vector<ReferenceEdge> reference_edges(const ReferenceMesh& mesh) {
  std::map<std::array<std::size_t, 2>, std::vector<std::size_t>> triangles_at;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<std::size_t, 2> ends{mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]};
      if (mesh.vertices[ends[1]] < mesh.vertices[ends[0]]) std::swap(ends[0], ends[1]);
      triangles_at[ends].push_back(t);
    }
  // How much the surface bends there; infinitely where it ends or branches.
  const auto bend = [&](const std::vector<std::size_t>& at) {
    if (at.size() != 2) return std::numeric_limits<double>::infinity();
    const Point &a = mesh.face_normals[at[0]], &b = mesh.face_normals[at[1]];
    if (length(a) == 0 || length(b) == 0) return std::numeric_limits<double>::infinity();
    return angle_between(a, b);
  };
  bool gentle = false;  // somewhere a facet may end between two triangles in one plane
  for (const auto& [ends, at] : triangles_at)
    gentle = gentle || (bend(at) > kSurelyFlat && bend(at) < kSurelyBent);
  std::vector<ReferenceEdge> edges;
  for (const auto& [ends, at] : triangles_at) {
    const bool bent = bend(at) >= kSurelyBent;
    if (bent || gentle) edges.push_back({ends, !bent});
  }
  return edges;
}

ReferenceSurface::ReferenceSurface(const TestMesh& test_mesh)
    : mesh(reference_mesh(test_mesh)), edges(reference_edges(mesh)), size(mesh_size(test_mesh)) {}

std::vector<ReferenceCrossing> reference_crossings(const ReferenceSurface& a, const TestPose& pa,
                                                   const ReferenceSurface& b, const TestPose& pb,
                                                   double epsilon, double growth) {
  std::vector<ReferenceCrossing> found;
  cross_side(0, a, pa, b, pb, epsilon, growth, found);
  cross_side(1, b, pb, a, pa, epsilon, growth, found);
  return found;
}

std::vector<ReferenceCrossing> reference_crossings(const TestMesh& a, const TestPose& pa,
                                                   const TestMesh& b, const TestPose& pb) {
  return reference_crossings(ReferenceSurface(a), pa, ReferenceSurface(b), pb,
                             comparison_tolerance(a, pa, b, pb));
}

}  // namespace ode_ext::test
