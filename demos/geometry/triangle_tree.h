// SPDX-License-Identifier: BSD-3-Clause
// A tree of boxes over triangles for the penetration oracle: closest point and first ray hit.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/vector.h"

namespace ode_ext::oracle {

using Triangle = std::array<Vector, 3>;

// Where on a triangle a point lies. Corner i is opposite to the edge from corner i+1 to i+2.
enum class Feature : std::uint8_t {
  kFace,
  kCorner0,
  kCorner1,
  kCorner2,
  kEdge01,
  kEdge12,
  kEdge20
};

struct ClosestPoint {
  Vector point;
  double squared_distance;  // [m^2]
  std::uint32_t triangle;
  Feature feature;
};

ClosestPoint closest_on_triangle(const Triangle& triangle, Vector p);

class TriangleTree {
 public:
  TriangleTree() = default;
  explicit TriangleTree(std::vector<Triangle> triangles);

  // There must be a triangle. The search is the quicker the closer `first_guess` is, and ends at
  // any triangle not farther than the root of `near_enough` [m^2].
  ClosestPoint closest(Vector p, std::uint32_t first_guess = 0, double near_enough = 0) const;
  // Distance along the unit `direction` to the first triangle crossed beyond `nearest` [m], or
  // infinity.
  double first_hit(Vector origin, Vector direction, double nearest) const;

  Vector low() const { return nodes_[0].low; }
  Vector high() const { return nodes_[0].high; }

 private:
  struct Node {
    Vector low, high;
    std::uint32_t first = 0;  // leaf: first entry of order_; else the left child, right = left + 1
    std::uint32_t count = 0;  // 0: not a leaf
  };
  void build(std::uint32_t node, std::uint32_t first, std::uint32_t count);

  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace ode_ext::oracle
