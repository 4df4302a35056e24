// SPDX-License-Identifier: BSD-3-Clause
#include "reference/reference_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace ode_ext::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void weld(const TestMesh& mesh, ReferenceMesh& result) {
  std::map<Point, std::size_t> known;  // -0 and 0 compare equal, as they should
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    std::array<std::size_t, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Point p = mesh.corner(static_cast<std::size_t>(t), k);
      const auto [found, is_new] = known.try_emplace(p, result.vertices.size());
      if (is_new) result.vertices.push_back(p);
      triangle[k] = found->second;
      result.reach = std::max(result.reach, largest_component(p));
    }
    const auto [a, b, c] = triangle;
    if (a == b || b == c || c == a) continue;
    result.triangles.push_back(triangle);
    result.source_triangle.push_back(t);
  }
}

bool is_closed(const ReferenceMesh& mesh) {
  std::map<std::pair<std::size_t, std::size_t>, int> edges;
  for (const auto& [a, b, c] : mesh.triangles) ++edges[{a, b}], ++edges[{b, c}], ++edges[{c, a}];
  return !edges.empty() && std::all_of(edges.begin(), edges.end(), [&](const auto& entry) {
    const auto opposite = edges.find({entry.first.second, entry.first.first});
    return entry.second == 1 && opposite != edges.end() && opposite->second == 1;
  });
}

double volume(const ReferenceMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    sum += dot(mesh.vertices[a], cross(mesh.vertices[b], mesh.vertices[c])) / 6;
  }
  return sum;
}

double angle(const Point& a, const Point& b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

void compute_normals(ReferenceMesh& mesh) {
  const std::size_t count = mesh.vertices.size();
  std::vector<Point> sum(count), largest(count);
  std::vector<double> total(count), area(count);
  double edges = 0;
  for (const auto& triangle : mesh.triangles) {
    const Point& a = mesh.vertices[triangle[0]];
    const Point doubled = cross(mesh.vertices[triangle[1]] - a, mesh.vertices[triangle[2]] - a);
    const Point normal = unit(doubled);
    mesh.face_normals.push_back(normal);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t v = triangle[k];
      const Point to_next = mesh.vertices[triangle[(k + 1) % 3]] - mesh.vertices[v];
      const double weight = angle(to_next, mesh.vertices[triangle[(k + 2) % 3]] - mesh.vertices[v]);
      edges += length(to_next);
      if (length(normal) == 0) continue;
      sum[v] = sum[v] + weight * normal;
      total[v] += weight;
      if (length(doubled) > area[v]) area[v] = length(doubled), largest[v] = normal;
    }
  }
  if (!mesh.triangles.empty()) mesh.mean_edge = edges / (3 * double(mesh.triangles.size()));
  mesh.doubtful.assign(count, false);
  for (std::size_t v = 0; v < count; ++v) {
    // A sum this short has lost all of its single-precision digits to cancellation ...
    const double lost = 1e-6 * total[v];
    mesh.normals.push_back(length(sum[v]) > lost ? unit(sum[v]) : largest[v]);
    // ... and one a thousand times as long still has only three left.
    mesh.doubtful[v] = length(sum[v]) > 0 && length(sum[v]) < 1000 * lost;
  }
}

// Whether rounding may take crossing `c` for a miss or for one of the other facing. Harmless where
// a surface that bends little is hit on a border: one neighbour or the other is met at the same t.
bool depends_on_rounding(const Crossing& c, const std::vector<Crossing>& all, double slack) {
  const double blur = slack / std::fabs(c.facing);
  if (std::fabs(c.t) < blur) return true;
  if (std::fabs(c.margin) >= blur) return false;
  int met = 0;
  for (const Crossing& other : all) {
    if (std::fabs(other.t - c.t) > blur) continue;
    if (other.facing * c.facing < 0) return true;
    met += other.margin >= 0;
  }
  return met == 0;
}

void compute_exits(ReferenceMesh& mesh, double open_thickness) {
  const double bound = mesh.closed          ? kInfinity
                       : open_thickness > 0 ? open_thickness
                                            : mesh.mean_edge;
  const double slack = rounding_bound(mesh.reach);
  mesh.exits.assign(mesh.vertices.size(), bound);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    auto others = crossings(mesh, mesh.vertices[v], -1 * mesh.normals[v], slack);
    std::erase_if(others, [&](const Crossing& c) {
      const auto& triangle = mesh.triangles[c.triangle];
      return c.t < -slack || std::count(triangle.begin(), triangle.end(), v) > 0;
    });
    // It leaves where it has left as often as it had entered; at an edge it does so once.
    int inside = 1;
    double wall = -kInfinity;
    for (const Crossing& c : others) {
      if (depends_on_rounding(c, others, slack)) mesh.doubtful[v] = true;
      if (c.t < 0 || c.margin < 0 || c.t <= wall) continue;
      wall = c.t + slack;
      const auto is_met_too = [&](const Crossing& other) {
        return other.margin >= 0 && other.t >= c.t && other.t <= wall &&
               (other.facing > 0) != (c.facing > 0);
      };
      if (!std::any_of(others.begin(), others.end(), is_met_too)) inside += c.facing > 0 ? -1 : 1;
      if (inside > 0) continue;
      mesh.exits[v] = std::min(c.t, bound);
      break;
    }
  }
}

}  // namespace

std::vector<Crossing> crossings(const ReferenceMesh& mesh, const Point& origin,
                                const Point& direction, double slack) {
  std::vector<Crossing> result;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Point& n = mesh.face_normals[i];
    const double facing = dot(direction, n);
    // Below this the plane is parallel to the ray as far as doubles of unit vectors can tell.
    if (std::fabs(facing) < 1e-13) continue;
    const auto& triangle = mesh.triangles[i];
    const double t = dot(n, mesh.vertices[triangle[0]] - origin) / facing;
    const Point p = origin + t * direction;
    double margin = kInfinity;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point& a = mesh.vertices[triangle[k]];
      const Point inwards = cross(n, unit(mesh.vertices[triangle[(k + 1) % 3]] - a));
      margin = std::min(margin, dot(inwards, p - a));
    }
    // On a border both neighbours count: no ray slips through between them.
    const double border = 1e-12 * (mesh.reach + largest_component(origin));
    if (margin > -border)
      result.push_back({t, facing, std::max(margin, 0.0), i});
    else if (margin > -slack / std::fabs(facing))
      result.push_back({t, facing, margin, i});
  }
  std::sort(result.begin(), result.end(), [](const Crossing& a, const Crossing& b) {
    return std::tie(a.t, a.triangle) < std::tie(b.t, b.triangle);
  });
  return result;
}

ReferenceMesh reference_mesh(const TestMesh& mesh, double open_thickness) {
  ReferenceMesh result;
  weld(mesh, result);
  result.closed = is_closed(result);
  result.inverted = result.closed && volume(result) < 0;
  if (result.inverted) {
    for (auto& triangle : result.triangles) std::swap(triangle[1], triangle[2]);
  }
  compute_normals(result);
  compute_exits(result, open_thickness);
  return result;
}

}  // namespace ode_ext::test
