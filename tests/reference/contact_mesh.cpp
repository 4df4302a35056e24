// SPDX-License-Identifier: BSD-3-Clause
#include "reference/contact_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "reference/contact_constants.h"

namespace ode_ext::test {
namespace {

using Corners = std::array<std::size_t, 3>;
using Ends = std::array<std::size_t, 2>;

// Below this the area is made of rounding: eight roundings of the sides' lengths.
constexpr double kNoArea = 8 * 0x1p-53;
// A sum of normals this much shorter than its weights is made of rounding of float coordinates.
constexpr double kVanishing = 0x1p-20;

Ends ends_of(const Corners& corners, std::size_t k) {
  const std::size_t a = corners[k], b = corners[(k + 1) % 3];
  return {std::min(a, b), std::max(a, b)};
}

bool runs_up(const Corners& corners, std::size_t k) { return corners[k] < corners[(k + 1) % 3]; }

// The triangles at each edge.
std::map<Ends, std::vector<std::size_t>> triangles_at_edges(const std::vector<Corners>& triangles) {
  std::map<Ends, std::vector<std::size_t>> at;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) at[ends_of(triangles[t], k)].push_back(t);
  return at;
}

bool runs_up(const Corners& corners, const Ends& ends) {
  for (std::size_t k = 0; k < 3; ++k)
    if (ends_of(corners, k) == ends) return runs_up(corners, k);
  return false;
}

void turn(Corners& corners) { std::swap(corners[1], corners[2]); }

double angle_at(const Point& a, const Point& b) {
  return std::atan2(length(cross(a, b)), dot(a, b));
}

// The shortest way that is 1 out of every face: of three walls at a corner the sum of their
// normals, whether the corner is one of the body or of a hole in it. By Hildreth's method: the
// multiplier of each wall in turn, until none changes the way. Where there is no such way, or only
// a long one, as at a needle's point or between the two sides of a sheet, along the vertex' normal.
Point offset_of(const std::vector<Point>& walls, const Point& normal) {
  constexpr int kSweeps = 200;
  constexpr double kSettled = 1e-6;
  Point way{};
  std::vector<double> pushes(walls.size(), 0);
  for (int sweep = 0; sweep < kSweeps && length(way) * kLeastLift <= 1; ++sweep) {
    double change = 0;
    for (std::size_t f = 0; f < walls.size(); ++f) {
      const double push = std::max(0.0, pushes[f] + 1 - dot(walls[f], way));
      way = way + (push - pushes[f]) * walls[f];
      change = std::max(change, std::fabs(push - pushes[f]));
      pushes[f] = push;
    }
    if (change < kSettled) break;
  }
  double least = 1;
  for (const Point& wall : walls) least = std::min(least, dot(wall, way));
  if (least > 0.5 && length(way) * kLeastLift <= 1) return (1 / least) * way;
  double steepest = 1;
  for (const Point& wall : walls) steepest = std::min(steepest, dot(wall, normal));
  return (1 / std::max(steepest, kLeastLift)) * normal;
}

}  // namespace

ContactMesh::ContactMesh(const TestMesh& mesh, double thickness) {
  weld(mesh);
  turn_outwards();
  sort_triangles();
  find_normals();
  find_edges();
  find_facets();
  describe_facets();
  describe_vertices();
  std::vector<ContactTriangle> corners;
  double sides_length = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    corners.push_back({corner(t, 0), corner(t, 1), corner(t, 2)});
    for (std::size_t k = 0; k < 3; ++k)
      sides_length += distance(corner(t, k), corner(t, (k + 1) % 3));
  }
  tree = ContactTree(std::move(corners));
  open_thickness = thickness > 0 || triangles.empty()
                       ? thickness
                       : sides_length / (3 * static_cast<double>(triangles.size()));
  if (triangles.empty()) return;
  middle = 0.5 * (tree.bounds().low + tree.bounds().high);
  for (const Point& v : vertices) radius = std::max(radius, distance(v, middle));
}

// Vertices ascending by place, triangles from their lowest vertex on.
void ContactMesh::weld(const TestMesh& mesh) {
  std::map<Point, std::size_t> numbers;  // -0 and 0 compare equal, as they should
  for (std::size_t t = 0; t < static_cast<std::size_t>(mesh.triangle_count()); ++t)
    for (std::size_t k = 0; k < 3; ++k) numbers.try_emplace(mesh.corner(t, k), 0);
  for (auto& [place, number] : numbers) {
    number = vertices.size();
    vertices.push_back(place);
  }
  for (std::size_t t = 0; t < static_cast<std::size_t>(mesh.triangle_count()); ++t) {
    Corners corners{};
    for (std::size_t k = 0; k < 3; ++k) corners[k] = numbers.at(mesh.corner(t, k));
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    triangles.push_back(corners);
    source_triangle.push_back(static_cast<int>(t));
  }
}

// By their vertices, once they are turned: so a mesh that was wound wrongly is the same.
void ContactMesh::sort_triangles() {
  std::vector<std::pair<Corners, int>> sorted;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    sorted.emplace_back(triangles[t], source_triangle[t]);
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    std::tie(triangles[t], source_triangle[t]) = sorted[t];
}

// A consistent winding is trusted and only the sign of the whole volume counts, since a part within
// another may be a cavity. An inconsistent one says nothing: each part is turned by itself.
void ContactMesh::turn_outwards() {
  const auto at = triangles_at_edges(triangles);
  closed = !at.empty();
  bool consistent = true;
  for (const auto& [ends, both] : at) {
    closed = closed && both.size() == 2;
    if (closed)
      consistent =
          consistent && runs_up(triangles[both[0]], ends) != runs_up(triangles[both[1]], ends);
  }
  if (!closed) return;
  const auto volume = [&](std::size_t t) {
    return dot(corner(t, 0) - vertices[0],
               cross(corner(t, 1) - vertices[0], corner(t, 2) - vertices[0]));
  };
  std::vector<bool> seen(triangles.size(), false);
  std::vector<Corners> turned = triangles;
  if (consistent) {
    double sum = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t) sum += volume(t);
    if (sum < 0) std::for_each(triangles.begin(), triangles.end(), turn);
    return;
  }
  for (std::size_t first = 0; first < triangles.size(); ++first) {
    if (seen[first]) continue;
    std::vector<std::size_t> part{first};
    seen[first] = true;
    double sum = 0;
    for (std::size_t head = 0; head < part.size(); ++head) {
      const std::size_t t = part[head];
      sum += turned[t] == triangles[t] ? volume(t) : -volume(t);
      for (std::size_t k = 0; k < 3; ++k) {
        const Ends ends = ends_of(turned[t], k);
        const auto& both = at.at(ends);
        const std::size_t other = both[0] == t ? both[1] : both[0];
        if (seen[other]) {
          // Not orientable: left as it is, and open.
          if (runs_up(turned[other], ends) == runs_up(turned[t], k)) {
            closed = false;
            return;
          }
          continue;
        }
        if (runs_up(turned[other], ends) == runs_up(turned[t], k)) turn(turned[other]);
        seen[other] = true;
        part.push_back(other);
      }
    }
    if (sum < 0)
      for (const std::size_t t : part) turn(turned[t]);
  }
  triangles = turned;
}

void ContactMesh::find_normals() {
  std::vector<Point> sum(vertices.size()), largest(vertices.size());
  std::vector<double> weights(vertices.size()), areas(vertices.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Point u = corner(t, 1) - corner(t, 0), v = corner(t, 2) - corner(t, 0);
    const Point doubled = cross(u, v);
    const double area = length(doubled);
    normals.push_back(area <= kNoArea * length(u) * length(v) ? Point{} : unit(doubled));
    if (length(normals.back()) == 0) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t at = triangles[t][k];
      const double angle =
          angle_at(corner(t, (k + 1) % 3) - vertices[at], corner(t, (k + 2) % 3) - vertices[at]);
      sum[at] = sum[at] + angle * normals.back();
      weights[at] += angle;
      if (area > areas[at]) areas[at] = area, largest[at] = normals.back();
    }
  }
  for (std::size_t v = 0; v < vertices.size(); ++v)
    vertex_normals.push_back(length(sum[v]) > kVanishing * weights[v] ? unit(sum[v]) : largest[v]);
  std::vector<std::vector<Point>> around(vertices.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (length(normals[t]) == 0) continue;
    for (const std::size_t v : triangles[t]) around[v].push_back(normals[t]);
  }
  for (std::size_t v = 0; v < vertices.size(); ++v)
    offsets.push_back(offset_of(around[v], vertex_normals[v]));
}

// Where more than two triangles meet they are taken two by two.
void ContactMesh::find_edges() {
  sides.resize(triangles.size());
  for (const auto& [ends, at] : triangles_at_edges(triangles)) {
    for (std::size_t i = 0; i < at.size(); i += 2) {
      ContactEdge edge{ends, {at[i], i + 1 < at.size() ? at[i + 1] : kNowhere}, false, 0};
      if (edge.triangles[1] != kNowhere) {
        double rise = -ContactBox::infinity;
        for (const std::size_t k : {0u, 1u}) {
          const std::size_t face = edge.triangles[k], other = edge.triangles[1 - k];
          for (std::size_t j = 0; j < 3; ++j)
            if (triangles[other][j] != ends[0] && triangles[other][j] != ends[1])
              rise = std::max(rise, dot(normals[face], corner(other, j) - vertices[ends[0]]));
        }
        edge.rise = rise;
      }
      for (const std::size_t t : edge.triangles) {
        if (t == kNowhere) continue;
        for (std::size_t k = 0; k < 3; ++k)
          if (ends_of(triangles[t], k) == ends) sides[t][k] = edges.size();
      }
      edges.push_back(edge);
    }
  }
}

// Whether rounding may have turned a triangle out of the plane of another.
bool ContactMesh::lies_in(std::size_t triangle, std::size_t seed) const {
  const auto longest = [&](std::size_t t) {
    return std::max({distance(corner(t, 0), corner(t, 1)), distance(corner(t, 1), corner(t, 2)),
                     distance(corner(t, 2), corner(t, 0))});
  };
  const auto height = [&](std::size_t t) {
    return length(cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0))) / longest(t);
  };
  const double rounding = 0x1p-22 * longest(seed);
  if (!(dot(normals[triangle], normals[seed]) > 0) ||
      !(distance(normals[triangle], normals[seed]) <= kFacetAngle + rounding / height(triangle)))
    return false;
  const double turned = std::min(rounding / height(seed), kFacetAngle);
  for (std::size_t k = 0; k < 3; ++k) {
    const Point p = corner(triangle, k);
    double nearest = distance(p, corner(seed, 0));
    for (std::size_t of = 1; of < 3; ++of)
      nearest = std::min(nearest, distance(p, corner(seed, of)));
    if (!(std::fabs(dot(normals[seed], p - corner(seed, 0))) <= rounding + turned * nearest))
      return false;
  }
  return true;
}

// Largest first, ties by place: each takes the connected triangles that turn away from it by less
// than kFacetAngle, or face as it does and lie in its plane as far as is known. Compared with the
// first and not with the next, or a fine sphere would be flat.
void ContactMesh::find_facets() {
  std::vector<std::size_t> order(triangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<double> areas;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    areas.push_back(length(cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0))));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return areas[a] > areas[b]; });
  facet_of.assign(triangles.size(), kNowhere);
  for (const std::size_t seed : order) {
    if (facet_of[seed] != kNowhere) continue;
    facets.push_back({normals[seed], -ContactBox::infinity, 0, seed, {}});
    facet_of[seed] = facets.size() - 1;
    if (length(normals[seed]) == 0) continue;
    std::vector<std::size_t> open{seed};
    while (!open.empty()) {
      const std::size_t t = open.back();
      open.pop_back();
      for (const std::size_t side : sides[t]) {
        for (const std::size_t next : edges[side].triangles) {
          if (next == kNowhere || facet_of[next] != kNowhere || length(normals[next]) == 0)
            continue;
          if (!(distance(normals[next], normals[seed]) < kFacetAngle) && !lies_in(next, seed))
            continue;
          facet_of[next] = facet_of[seed];
          open.push_back(next);
        }
      }
    }
  }
}

void ContactMesh::describe_facets() {
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const std::size_t first = facet_at(e, 0), second = facet_at(e, 1);
    edges[e].flat = first == second;
    if (edges[e].flat) continue;
    facets[first].edges.push_back(e);
    if (second != kNowhere) facets[second].edges.push_back(e);
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    ContactFacet& facet = facets[facet_of[t]];
    for (const std::size_t v : triangles[t]) {
      facet.top = std::max(facet.top, dot(facet.normal, vertices[v]));
      facet.lift = std::max(facet.lift, dot(facet.normal, offsets[v]));
    }
  }
}

void ContactMesh::describe_vertices() {
  edges_at.resize(vertices.size());
  flat_vertices.assign(vertices.size(), true);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    for (const std::size_t v : edges[e].vertices) {
      edges_at[v].push_back(e);
      if (!edges[e].flat) flat_vertices[v] = false;
    }
  }
  components.assign(vertices.size(), kNowhere);
  for (std::size_t first = 0; first < vertices.size(); ++first) {
    if (components[first] != kNowhere) continue;
    components[first] = component_count;
    std::vector<std::size_t> open{first};
    while (!open.empty()) {
      const std::size_t v = open.back();
      open.pop_back();
      for (const std::size_t e : edges_at[v]) {
        for (const std::size_t next : edges[e].vertices) {
          if (components[next] != kNowhere) continue;
          components[next] = component_count;
          open.push_back(next);
        }
      }
    }
    ++component_count;
  }
}

double ContactMesh::thickness_at(std::size_t vertex) const {
  const double most = closed ? ContactBox::infinity : open_thickness;
  for (const TriangleHit& hit : tree.along(vertices[vertex], -1 * vertex_normals[vertex])) {
    const auto& corners = triangles[hit.triangle];
    if (std::count(corners.begin(), corners.end(), vertex) > 0) continue;
    return hit.back ? std::min(hit.t, most) : most;
  }
  return most;
}

}  // namespace ode_ext::test
