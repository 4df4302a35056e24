// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace falling_objects {
namespace {

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

}  // namespace

Point TriangleMesh::vertex(std::size_t i) const {
  return {vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2]};
}

Corners TriangleMesh::corners(std::size_t triangle) const {
  const unsigned* t = &indices[3 * triangle];
  return {vertex(t[0]), vertex(t[1]), vertex(t[2])};
}

unsigned TriangleMesh::add_vertex(const Point& p) {
  for (const double x : p) vertices.push_back(static_cast<float>(x));
  return static_cast<unsigned>(vertex_count() - 1);
}

void TriangleMesh::add_triangle(unsigned a, unsigned b, unsigned c) {
  indices.insert(indices.end(), {a, b, c});
}

void TriangleMesh::add_quad(unsigned a, unsigned b, unsigned c, unsigned d) {
  add_triangle(a, b, c);
  add_triangle(a, c, d);
}

bool is_closed(const TriangleMesh& mesh) {
  std::set<std::pair<unsigned, unsigned>> edges;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!edges.emplace(mesh.indices[i + k], mesh.indices[i + (k + 1) % 3]).second) return false;
    }
  }
  return !edges.empty() && std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
    return edges.contains({edge.second, edge.first});
  });
}

double signed_volume(const TriangleMesh& mesh) {
  double volume = 0;
  for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
    const auto [a, b, c] = mesh.corners(i);
    volume += dot(a, cross(b, c)) / 6;
  }
  return volume;
}

double smallest_area(const TriangleMesh& mesh) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
    const auto [a, b, c] = mesh.corners(i);
    const Point n = cross(minus(b, a), minus(c, a));
    smallest = std::min(smallest, std::sqrt(dot(n, n)) / 2);
  }
  return smallest;
}

Point centre(const TriangleMesh& mesh, bool closed) {
  Point sum{};
  double weight = 0;
  const auto add = [&](const Point& p, double w) {
    for (std::size_t k = 0; k < 3; ++k) sum[k] += w * p[k];
    weight += w;
  };
  if (closed) {
    // Tetrahedra between the origin and each triangle; their centroids are (0 + a + b + c) / 4.
    for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
      const auto [a, b, c] = mesh.corners(i);
      add({(a[0] + b[0] + c[0]) / 4, (a[1] + b[1] + c[1]) / 4, (a[2] + b[2] + c[2]) / 4},
          dot(a, cross(b, c)) / 6);
    }
  } else {
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) add(mesh.vertex(i), 1);
  }
  return {sum[0] / weight, sum[1] / weight, sum[2] / weight};
}

double bounding_radius(const TriangleMesh& mesh) {
  double squared = 0;
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    squared = std::max(squared, dot(mesh.vertex(i), mesh.vertex(i)));
  }
  return std::sqrt(squared);
}

void weld(TriangleMesh& mesh) {
  std::map<Point, unsigned> first;
  TriangleMesh welded;
  std::vector<unsigned> renamed(mesh.vertex_count());
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    const auto [at, is_new] = first.try_emplace(mesh.vertex(i), 0u);
    if (is_new) at->second = welded.add_vertex(at->first);
    renamed[i] = at->second;
  }
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const unsigned a = renamed[mesh.indices[i]];
    const unsigned b = renamed[mesh.indices[i + 1]];
    const unsigned c = renamed[mesh.indices[i + 2]];
    if (a != b && b != c && c != a) welded.add_triangle(a, b, c);
  }
  mesh = std::move(welded);
}

void turn_inside_out(TriangleMesh& mesh) {
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
  }
}

void scale_mesh(TriangleMesh& mesh, double factor) {
  for (float& x : mesh.vertices) x = static_cast<float>(x * factor);
}

Point center_on_mass(TriangleMesh& mesh) {
  const Point middle = centre(mesh, is_closed(mesh));
  if (std::sqrt(dot(middle, middle)) < 1e-6 * bounding_radius(mesh)) return {0, 0, 0};
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    mesh.vertices[i] = static_cast<float>(mesh.vertices[i] - middle[i % 3]);
  }
  return middle;
}

void normalise(TriangleMesh& mesh, double radius) {
  const Point middle = centre(mesh, is_closed(mesh));
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    mesh.vertices[i] = static_cast<float>(mesh.vertices[i] - middle[i % 3]);
  }
  scale_mesh(mesh, radius / bounding_radius(mesh));
}

}  // namespace falling_objects
