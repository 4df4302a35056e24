// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/topology.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace ode_ext {
namespace {

constexpr std::size_t kFewestClosedTriangles = 4;  // a tetrahedron

struct HalfEdge {
  std::uint64_t edge;  // lower corner, higher corner
  std::uint32_t half;  // 3 * triangle + first corner
};

bool runs_upward(const std::vector<Triangle>& triangles, std::uint32_t half) {
  const Triangle& triangle = triangles[half / 3];
  return triangle[half % 3] < triangle[(half + 1) % 3];
}

// The two sides of an edge follow one another.
std::vector<HalfEdge> sorted_half_edges(const std::vector<Triangle>& triangles) {
  std::vector<HalfEdge> halves;
  halves.reserve(3 * triangles.size());
  for (const Triangle& triangle : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax({triangle[k], triangle[(k + 1) % 3]});
      halves.push_back(
          {std::uint64_t{low} << 32 | high, static_cast<std::uint32_t>(halves.size())});
    }
  }
  std::sort(halves.begin(), halves.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.half < b.half;
  });
  return halves;
}

bool every_edge_has_two(const std::vector<HalfEdge>& halves) {
  if (halves.size() % 2 != 0) return false;
  for (std::size_t i = 0; i < halves.size(); i += 2) {
    if (halves[i].edge != halves[i + 1].edge) return false;
    if (i > 0 && halves[i - 1].edge == halves[i].edge) return false;
  }
  return true;
}

bool consistent(const std::vector<HalfEdge>& halves, const std::vector<Triangle>& triangles) {
  for (std::size_t i = 0; i < halves.size(); i += 2) {
    if (runs_upward(triangles, halves[i].half) == runs_upward(triangles, halves[i + 1].half)) {
      return false;
    }
  }
  return true;
}

void turn(Triangle& triangle) { std::swap(triangle[1], triangle[2]); }

// Six times the signed volume of the cone from the first vertex, which keeps the numbers small.
double cone_volume(const std::vector<Vec3f>& vertices, const Triangle& triangle) {
  const Vec3d apex(vertices[0]);
  const Vec3d a = Vec3d(vertices[triangle[0]]) - apex;
  const Vec3d b = Vec3d(vertices[triangle[1]]) - apex;
  const Vec3d c = Vec3d(vertices[triangle[2]]) - apex;
  return dot(a, cross(b, c));
}

enum class Winding : std::uint8_t { kUnknown, kKeep, kTurn };

Winding opposite(Winding winding) {
  return winding == Winding::kKeep ? Winding::kTurn : Winding::kKeep;
}

// Breadth first through each connected part. False, with nothing changed, if some part is not
// orientable (a Klein bottle).
bool make_consistent(const std::vector<HalfEdge>& halves, const std::vector<Vec3f>& vertices,
                     std::vector<Triangle>& triangles) {
  std::vector<std::uint32_t> partner(halves.size());
  for (std::size_t i = 0; i < halves.size(); i += 2) {
    partner[halves[i].half] = halves[i + 1].half;
    partner[halves[i + 1].half] = halves[i].half;
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
      for (std::uint32_t half = 3 * triangle; half < 3 * triangle + 3; ++half) {
        const std::uint32_t other = partner[half];
        const bool agree = runs_upward(triangles, half) != runs_upward(triangles, other);
        const Winding wanted = agree ? own : opposite(own);
        Winding& found = windings[other / 3];
        if (found == Winding::kUnknown) {
          found = wanted;
          queue.push_back(other / 3);
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

Orientation orient(const std::vector<Vec3f>& vertices, std::vector<Triangle>& triangles) {
  Orientation result;
  if (triangles.size() < kFewestClosedTriangles) return result;
  const std::vector<HalfEdge> halves = sorted_half_edges(triangles);
  if (!every_edge_has_two(halves)) return result;

  if (!consistent(halves, triangles)) {
    result.closed = result.reoriented = make_consistent(halves, vertices, triangles);
    return result;
  }
  result.closed = true;
  if (signed_volume(vertices, triangles) < 0) {
    result.inverted = true;
    for (Triangle& triangle : triangles) turn(triangle);
  }
  return result;
}

}  // namespace ode_ext
