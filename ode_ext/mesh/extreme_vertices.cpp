// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/extreme_vertices.h"

#include <array>
#include <cstddef>

namespace ode_ext {
namespace {

// Of triangles at a vertex. All pairs of its neighbours are looked at, so time goes by the third
// power of it.
constexpr std::size_t kMany = 32;

// Of the cosine of two unit vectors, one of them a cross product divided by its length, which is
// kParallel at least: rounding of a few 1e-16, over that.
constexpr double kRounding = 1e-9;
constexpr double kParallel = 1e-6;

// The ways from a vertex to its neighbours, unit, in order round about it.
struct Ring {
  std::array<Vec3d, kMany> ways;
  std::size_t size = 0;
};

// False: the `count` triangles at the vertex, of which one is `first`, do not go round it once, or
// are many.
bool find_ring(const std::vector<Vec3f>& vertices, const std::vector<Triangle>& triangles,
               const std::vector<Neighbours>& neighbours, std::uint32_t vertex, std::uint32_t first,
               std::uint32_t count, Ring* ring) {
  ring->size = 0;
  if (count > kMany) return false;
  std::uint32_t t = first;
  do {
    if (t == kNone || ring->size == count) return false;
    const Triangle& corners = triangles[t];
    const std::size_t k = corners[0] == vertex ? 0 : corners[1] == vertex ? 1 : 2;
    const Vec3d way = Vec3d(vertices[corners[(k + 1) % 3]]) - Vec3d(vertices[vertex]);
    ring->ways[ring->size++] = (1 / length(way)) * way;
    t = neighbours[t][(k + 2) % 3];
  } while (t != first);
  return ring->size == count;
}

// Whether none of the neighbours reaches farther along a direction.
bool is_farthest(const Ring& ring, Vec3d direction) {
  for (std::size_t i = 0; i < ring.size; ++i)
    if (dot(direction, ring.ways[i]) > kRounding) return false;
  return true;
}

// A direction in which none reaches farther is one of a cone, the polar of their ways. If there is
// any, two of the ways are at right angles to one of the cone's edges; where they are as good as
// parallel it is not known which that is, and the vertex may be extreme. The direction has to lead
// out of the solid, which the angle-weighted normal tells (Baerentzen and Aanaes 2005): the vertex
// is what of the surface about it is nearest to where it leads.
bool is_extreme(const Ring& ring, Vec3d normal) {
  if (is_farthest(ring, normal)) return true;
  bool any_parallel = false;
  for (std::size_t i = 0; i < ring.size; ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const Vec3d across = cross(ring.ways[i], ring.ways[k]);
      const double sine = length(across);
      if (sine < kParallel) {
        any_parallel = true;
        continue;
      }
      const Vec3d direction = (1 / sine) * across;
      const double outward = dot(direction, normal);
      if (outward > -kRounding && is_farthest(ring, direction)) return true;
      if (outward < kRounding && is_farthest(ring, -direction)) return true;
    }
  return any_parallel;
}

}  // namespace

std::vector<std::uint8_t> extreme_vertices(const std::vector<Vec3f>& vertices,
                                           const std::vector<Triangle>& triangles,
                                           const std::vector<Neighbours>& neighbours,
                                           const std::vector<Edge>& edges,
                                           const std::vector<Vec3f>& normals) {
  std::vector<std::uint8_t> result(vertices.size());
  for (const Edge& edge : edges)
    for (const std::uint32_t v : edge.vertices) result[v] = 1;
  std::vector<std::uint32_t> first(vertices.size(), kNone), count(vertices.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (const std::uint32_t v : triangles[t]) {
      first[v] = t;
      ++count[v];
    }
  Ring ring;
  for (std::uint32_t v = 0; v < vertices.size(); ++v)
    if (result[v] != 0 && find_ring(vertices, triangles, neighbours, v, first[v], count[v], &ring))
      result[v] = is_extreme(ring, Vec3d(normals[v])) ? 1 : 0;
  return result;
}

}  // namespace ode_ext
