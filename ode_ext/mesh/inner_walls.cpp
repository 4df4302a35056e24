// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/inner_walls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "mesh/bvh.h"
#include "mesh/edge_pairs.h"
#include "mesh/half_edges.h"
#include "mesh/orientation.h"
#include "mesh/ray_cast.h"

namespace ode_ext {
namespace {

// [1] of its size, how far a quad may be from flat: its corners are floats.
constexpr double kFlatQuad = 0x1p-18;

// Triangles that cover one another from both sides.
using Wall = std::vector<std::uint32_t>;

// Of each triangle whether it is of a wall.
std::vector<bool> marked(const std::vector<Wall>& walls, std::size_t triangle_count) {
  std::vector<bool> is_wall(triangle_count);
  for (const Wall& wall : walls)
    for (const std::uint32_t triangle : wall) is_wall[triangle] = true;
  return is_wall;
}

// Two, and no more, that have the same corners.
void add_triangle_walls(const std::vector<Triangle>& triangles, std::vector<Wall>& walls) {
  for (std::uint32_t first = 0, last = 0; first < triangles.size(); first = last) {
    last = static_cast<std::uint32_t>(end_of_same_corners(triangles, first));
    if (last - first == 2 && triangles[first] != triangles[first + 1])
      walls.push_back({first, first + 1});
  }
}

// Two triangles that are a flat quad.
struct Quad {
  std::array<std::uint32_t, 4> corners;  // in ascending order
  std::array<std::uint32_t, 2> triangles;
  Vec3d normal;
};

// Those whose diagonal has no other triangle.
std::vector<Quad> quads_of(const std::vector<Vec3f>& vertices,
                           const std::vector<Triangle>& triangles,
                           const std::vector<HalfEdge>& half_edges) {
  std::vector<Quad> quads;
  for (std::size_t begin = 0, end = 0; begin < half_edges.size(); begin = end) {
    end = end_of_edge(half_edges, begin);
    if (end - begin != 2 || !are_pairs(half_edges, begin, end)) continue;
    const HalfEdge &one = half_edges[begin], &other = half_edges[begin + 1];
    const std::uint32_t apex = apex_of(triangles, one), across = apex_of(triangles, other);
    const Vec3d from(vertices[one.low]), along = Vec3d(vertices[one.high]) - from;
    const Vec3d to_apex = Vec3d(vertices[apex]) - from, to_across = Vec3d(vertices[across]) - from;
    Vec3d normal = cross(along, to_apex);
    if (!one.upward) normal = -1.0 * normal;
    const double size = std::max({length(along), length(to_apex), length(to_across)});
    // Flat, and not folded back.
    if (!(std::abs(dot(normal, to_across)) <= kFlatQuad * size * length(normal)) ||
        !(dot(cross(along, to_apex), cross(along, to_across)) < 0))
      continue;
    Quad quad{{one.low, one.high, apex, across}, {one.side / 3, other.side / 3}, normal};
    std::sort(quad.corners.begin(), quad.corners.end());
    quads.push_back(quad);
  }
  return quads;
}

// Two quads with the same corners, each with another diagonal, of triangles of no other wall.
void add_quad_walls(const std::vector<Vec3f>& vertices, const std::vector<Triangle>& triangles,
                    const std::vector<HalfEdge>& half_edges, std::vector<Wall>& walls) {
  std::vector<bool> is_taken = marked(walls, triangles.size());
  std::vector<Quad> quads = quads_of(vertices, triangles, half_edges);
  std::sort(quads.begin(), quads.end(), [](const Quad& a, const Quad& b) {
    return std::tie(a.corners, a.triangles) < std::tie(b.corners, b.triangles);
  });
  for (std::size_t i = 0; i + 1 < quads.size(); ++i) {
    const Quad &a = quads[i], &b = quads[i + 1];
    const Wall wall{a.triangles[0], a.triangles[1], b.triangles[0], b.triangles[1]};
    const bool is_free = std::none_of(wall.begin(), wall.end(),
                                      [&](std::uint32_t triangle) { return is_taken[triangle]; });
    if (a.corners != b.corners || !(dot(a.normal, b.normal) < 0) || !is_free) continue;
    for (const std::uint32_t triangle : wall) is_taken[triangle] = true;
    walls.push_back(wall);
  }
}

// The solid that closed triangles bound, asked from its inside or outside: by what three rays meet
// first, since one may graze an edge.
class Solid {
 public:
  Solid(const std::vector<Vec3f>& vertices, std::vector<Triangle> triangles)
      : vertices_(vertices),
        triangles_(std::move(triangles)),
        bvh_(build_bvh(vertices_, triangles_)),
        inverted_(signed_volume(vertices_, triangles_) < 0) {}

  bool holds(Vec3d point) const {
    int inside = 0;
    for (const Vec3d& direction : kDirections) {
      const RayHit hit = cast_ray({point, direction}, bvh_, vertices_, triangles_);
      if (hit.triangle != kNone && hit.back != inverted_) ++inside;
    }
    return inside >= 2;
  }

 private:
  // Along no face or edge of what is cut along axes, nor at 45 or 60 degrees.
  static constexpr Vec3d kDirections[] = {
      {0.5481, 0.3027, 0.7797}, {-0.2379, 0.8711, -0.4297}, {0.3319, -0.6203, -0.7107}};

  const std::vector<Vec3f>& vertices_;
  std::vector<Triangle> triangles_;
  Bvh bvh_;
  bool inverted_;
};

Vec3d middle_of(const std::vector<Vec3f>& vertices, const Triangle& triangle) {
  Vec3d sum{};
  for (const std::uint32_t corner : triangle) sum = sum + Vec3d(vertices[corner]);
  return (1.0 / 3) * sum;
}

}  // namespace

bool leave_out_inner_walls(WeldedMesh& mesh, const std::vector<HalfEdge>& half_edges) {
  if (!has_shared(half_edges)) return false;
  std::vector<Wall> walls;
  add_triangle_walls(mesh.triangles, walls);
  add_quad_walls(mesh.vertices, mesh.triangles, half_edges, walls);
  if (walls.empty()) return false;
  std::vector<Triangle> others;
  const std::vector<bool> may_be_wall = marked(walls, mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (!may_be_wall[i]) others.push_back(mesh.triangles[i]);
  if (others.empty() || !is_boundary(half_edges_of(others))) return false;
  const Solid solid(mesh.vertices, std::move(others));
  std::erase_if(walls, [&](const Wall& wall) {
    return !solid.holds(middle_of(mesh.vertices, mesh.triangles[wall[0]]));
  });
  if (walls.empty()) return false;
  leave_out(marked(walls, mesh.triangles.size()), mesh);
  return true;
}

}  // namespace ode_ext
