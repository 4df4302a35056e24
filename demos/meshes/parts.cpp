// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

namespace falling_objects {
namespace {

struct Part {
  std::vector<std::size_t> triangles;
  Point low, high;
  double volume = 0;  // [m^3], signed
};

double determinant(const Point& a, const Point& b, const Point& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

Corners seen_from(const Point& p, Corners corners) {
  for (Point& corner : corners)
    for (std::size_t k = 0; k < 3; ++k) corner[k] -= p[k];
  return corners;
}

// The number of each vertex's part, named by one of its vertices.
std::vector<unsigned> part_of_vertices(const TriangleMesh& mesh) {
  std::vector<unsigned> parent(mesh.vertex_count());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](unsigned v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (std::size_t i = 0; i < mesh.indices.size(); ++i)
    parent[root(mesh.indices[i])] = root(mesh.indices[i - i % 3]);
  for (unsigned v = 0; v < parent.size(); ++v) parent[v] = root(v);
  return parent;
}

std::vector<Part> parts_of(const TriangleMesh& mesh) {
  const std::vector<unsigned> part_of = part_of_vertices(mesh);
  std::map<unsigned, std::size_t> numbers;
  std::vector<Part> parts;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Corners corners = mesh.corners(t);
    const auto [at, is_new] = numbers.try_emplace(part_of[mesh.indices[3 * t]], parts.size());
    if (is_new) parts.push_back({{}, corners[0], corners[0]});
    Part& part = parts[at->second];
    // From a corner of its own: far from the origin it would be a difference of large numbers.
    const Point from = mesh.vertex(mesh.indices[3 * (is_new ? t : part.triangles.front())]);
    const auto [a, b, c] = seen_from(from, corners);
    part.volume += determinant(a, b, c) / 6;
    part.triangles.push_back(t);
    for (const Point& corner : corners)
      for (std::size_t k = 0; k < 3; ++k) {
        part.low[k] = std::min(part.low[k], corner[k]);
        part.high[k] = std::max(part.high[k], corner[k]);
      }
  }
  return parts;
}

double length(const Point& a) { return std::hypot(a[0], a[1], a[2]); }
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// By the solid angles of its triangles (van Oosterom and Strackee 1983): inside they make up 4 pi.
bool is_inside(const Point& p, const Part& part, const TriangleMesh& mesh) {
  for (std::size_t k = 0; k < 3; ++k)
    if (p[k] < part.low[k] || p[k] > part.high[k]) return false;
  double angle = 0;
  for (const std::size_t t : part.triangles) {
    const auto [a, b, c] = seen_from(p, mesh.corners(t));
    const double x = length(a), y = length(b), z = length(c);
    angle += 2 * std::atan2(determinant(a, b, c),
                            x * y * z + dot(a, b) * z + dot(a, c) * y + dot(b, c) * x);
  }
  return std::abs(angle) > 2 * std::numbers::pi;
}

}  // namespace

void turn_parts_outwards(TriangleMesh& mesh) {
  const std::vector<Part> parts = parts_of(mesh);
  const auto is_turned = [](const Part& part) { return part.volume < 0; };
  if (std::none_of(parts.begin(), parts.end(), is_turned)) return;
  const auto contains = [&](const Part& outer, const Part& inner) {
    const Point p = mesh.vertex(mesh.indices[3 * inner.triangles.front()]);
    return &outer != &inner && is_inside(p, outer, mesh);
  };
  const auto outermost_around = [&](const Part& part) {
    const Part* outermost = &part;
    for (const Part& outer : parts)
      if (contains(outer, part) && (outermost == &part || contains(outer, *outermost)))
        outermost = &outer;
    return outermost;
  };
  std::vector<const Part*> turned;
  for (const Part& part : parts)
    if (is_turned(*outermost_around(part))) turned.push_back(&part);
  for (const Part* part : turned)
    for (const std::size_t t : part->triangles)
      std::swap(mesh.indices[3 * t + 1], mesh.indices[3 * t + 2]);
}

}  // namespace falling_objects
