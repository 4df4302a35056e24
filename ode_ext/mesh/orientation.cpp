// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/orientation.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "mesh/edge_pairs.h"

namespace ode_ext {
namespace {

constexpr std::size_t kFewestClosedTriangles = 4;  // a tetrahedron

bool every_edge_has_two(const std::vector<HalfEdge>& edges) {
  if (edges.size() % 2 != 0) return false;
  for (std::size_t i = 0; i < edges.size(); i += 2) {
    if (!same_edge(edges[i], edges[i + 1])) return false;
    if (i > 0 && same_edge(edges[i - 1], edges[i])) return false;
  }
  return true;
}

bool consistent(const std::vector<HalfEdge>& edges) {
  for (std::size_t i = 0; i < edges.size(); i += 2)
    if (edges[i].upward == edges[i + 1].upward) return false;
  return true;
}

void turn(Triangle& triangle) { std::swap(triangle[1], triangle[2]); }

// Six times the signed volume of the cone from the first vertex. What rounding adds goes by the
// square of the triangle's size and by how far off it is, so that a part of millimetres is still
// told from itself inside out a kilometre away.
double cone_volume(const std::vector<Vec3f>& vertices, const Triangle& triangle) {
  const Vec3d apex(vertices[0]);
  const Vec3d a = Vec3d(vertices[triangle[0]]) - apex;
  const Vec3d b = Vec3d(vertices[triangle[1]]) - apex;
  const Vec3d c = Vec3d(vertices[triangle[2]]) - apex;
  return dot(a, cross(b - a, c - a));
}

enum class Winding : std::uint8_t { kUnknown, kKeep, kTurn };

Winding opposite(Winding winding) {
  return winding == Winding::kKeep ? Winding::kTurn : Winding::kKeep;
}

// Breadth first through each connected part. False, with nothing changed, if some part is not
// orientable (a Klein bottle).
bool make_consistent(const std::vector<HalfEdge>& edges, const std::vector<Vec3f>& vertices,
                     std::vector<Triangle>& triangles) {
  struct Partner {
    std::uint32_t side;
    bool agrees;  // runs the edge the other way
  };
  std::vector<Partner> partner(edges.size());
  for (std::size_t i = 0; i < edges.size(); i += 2) {
    const bool agree = edges[i].upward != edges[i + 1].upward;
    partner[edges[i].side] = {edges[i + 1].side, agree};
    partner[edges[i + 1].side] = {edges[i].side, agree};
  }

  std::vector<Winding> windings(triangles.size(), Winding::kUnknown);
  std::vector<std::uint32_t> queue;
  for (std::uint32_t seed = 0; seed < triangles.size(); ++seed) {
    if (windings[seed] != Winding::kUnknown) continue;
    windings[seed] = Winding::kKeep;
    queue.assign(1, seed);
    double volume = 0;
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const std::uint32_t triangle = queue[head];
      const Winding own = windings[triangle];
      const double cone = cone_volume(vertices, triangles[triangle]);
      volume += own == Winding::kKeep ? cone : -cone;
      for (std::uint32_t side = 3 * triangle; side < 3 * triangle + 3; ++side) {
        const std::uint32_t other = partner[side].side / 3;
        const Winding wanted = partner[side].agrees ? own : opposite(own);
        Winding& found = windings[other];
        if (found == Winding::kUnknown) {
          found = wanted;
          queue.push_back(other);
        } else if (found != wanted) {
          return false;
        }
      }
    }
    if (volume < 0) {
      for (const std::uint32_t triangle : queue) windings[triangle] = opposite(windings[triangle]);
    }
  }

  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (windings[i] == Winding::kTurn) turn(triangles[i]);
  }
  return true;
}

}  // namespace

double signed_volume(const std::vector<Vec3f>& vertices, const std::vector<Triangle>& triangles) {
  double volume = 0;
  for (const Triangle& triangle : triangles) volume += cone_volume(vertices, triangle);
  return volume;
}

Orientation orient(const std::vector<Vec3f>& vertices, std::vector<Triangle>& triangles,
                   std::vector<HalfEdge>& half_edges) {
  Orientation result;
  if (triangles.size() < kFewestClosedTriangles) return result;
  const bool has_two = every_edge_has_two(half_edges);
  if (!has_two && (!is_boundary(half_edges) || has_coincident(triangles, half_edges)))
    return result;
  if (has_two && !consistent(half_edges)) {
    result.closed = result.reoriented = make_consistent(half_edges, vertices, triangles);
  } else {
    result.closed = true;
    result.inverted = signed_volume(vertices, triangles) < 0;
    if (result.inverted)
      for (Triangle& triangle : triangles) turn(triangle);
  }
  if (result.reoriented || result.inverted) half_edges = half_edges_of(triangles);
  return result;
}

}  // namespace ode_ext
