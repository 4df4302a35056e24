// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/triangle_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace ode_ext::oracle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kLeafTriangles = 4;
// The tree is balanced, so its depth is at most the number of bits in a count; a traversal holds
// one sibling for each level.
constexpr std::size_t kStack = 64;

Vector lower(Vector a, Vector b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vector upper(Vector a, Vector b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

double squared_distance(Vector low, Vector high, Vector p) {
  const Vector outside = upper(upper(low - p, p - high), {});
  return dot(outside, outside);
}

ClosestPoint found(Vector point, Vector p, Feature feature) {
  return {point, dot(p - point, p - point), 0, feature};
}

// The closest point of the segment from a to b, its ends included.
ClosestPoint closest_on_edge(Vector a, Vector b, Vector p, Feature at_a, Feature inside,
                             Feature at_b) {
  const Vector along = b - a;
  const double t = dot(p - a, along);
  const double whole = dot(along, along);
  if (!(t > 0)) return found(a, p, at_a);
  if (t >= whole) return found(b, p, at_b);
  return found(a + (t / whole) * along, p, inside);
}

}  // namespace

// If p projects into the triangle that is the closest point, else it is on one of the three edges.
ClosestPoint closest_on_triangle(const Triangle& t, Vector p) {
  const Vector n = cross(t[1] - t[0], t[2] - t[0]);
  const double area = dot(n, n);
  if (area > 0 && dot(cross(t[1] - t[0], p - t[0]), n) > 0 &&
      dot(cross(t[2] - t[1], p - t[1]), n) > 0 && dot(cross(t[0] - t[2], p - t[2]), n) > 0) {
    return found(p - (dot(p - t[0], n) / area) * n, p, Feature::kFace);
  }
  ClosestPoint best =
      closest_on_edge(t[0], t[1], p, Feature::kCorner0, Feature::kEdge01, Feature::kCorner1);
  for (const ClosestPoint& other :
       {closest_on_edge(t[1], t[2], p, Feature::kCorner1, Feature::kEdge12, Feature::kCorner2),
        closest_on_edge(t[2], t[0], p, Feature::kCorner2, Feature::kEdge20, Feature::kCorner0)}) {
    if (other.squared_distance < best.squared_distance) best = other;
  }
  return best;
}

TriangleTree::TriangleTree(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  order_.resize(triangles_.size());
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.resize(1);
  if (!triangles_.empty()) build(0, 0, static_cast<std::uint32_t>(triangles_.size()));
}

// Splits at the median of the middles along the longest axis.
void TriangleTree::build(std::uint32_t node, std::uint32_t first, std::uint32_t count) {
  Vector low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
  for (std::uint32_t i = first; i < first + count; ++i) {
    for (const Vector& corner : triangles_[order_[i]]) {
      low = lower(low, corner);
      high = upper(high, corner);
    }
  }
  nodes_[node].low = low;
  nodes_[node].high = high;
  if (count <= kLeafTriangles) {
    nodes_[node].first = first;
    nodes_[node].count = count;
    return;
  }
  const Vector size = high - low;
  double Vector::*axis = &Vector::x;
  if (size.y > size.*axis) axis = &Vector::y;
  if (size.z > size.*axis) axis = &Vector::z;
  const auto middle = [&](std::uint32_t i) {
    const Triangle& t = triangles_[i];
    return t[0].*axis + t[1].*axis + t[2].*axis;
  };
  const std::uint32_t half = count / 2;
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + half, begin + count,
                   [&](std::uint32_t a, std::uint32_t b) { return middle(a) < middle(b); });
  const auto left = static_cast<std::uint32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node].first = left;
  build(left, first, half);
  build(left + 1, first + half, count - half);
}

ClosestPoint TriangleTree::closest(Vector p, std::uint32_t first_guess, double near_enough) const {
  ClosestPoint best = closest_on_triangle(triangles_[first_guess], p);
  best.triangle = first_guess;
  struct Pending {
    std::uint32_t node;
    double squared;
  };
  std::array<Pending, kStack> stack;
  std::size_t size = 0;
  stack[size++] = {0, squared_distance(nodes_[0].low, nodes_[0].high, p)};
  while (size > 0 && best.squared_distance > near_enough) {
    const Pending next = stack[--size];
    if (!(next.squared < best.squared_distance)) continue;
    const Node& node = nodes_[next.node];
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      ClosestPoint candidate = closest_on_triangle(triangles_[order_[i]], p);
      if (candidate.squared_distance < best.squared_distance) {
        candidate.triangle = order_[i];
        best = candidate;
      }
    }
    if (node.count > 0) continue;
    Pending near{node.first, squared_distance(nodes_[node.first].low, nodes_[node.first].high, p)};
    Pending far{node.first + 1,
                squared_distance(nodes_[node.first + 1].low, nodes_[node.first + 1].high, p)};
    if (far.squared < near.squared) std::swap(near, far);
    stack[size++] = far;
    stack[size++] = near;
  }
  return best;
}

double TriangleTree::first_hit(Vector origin, Vector direction, double nearest) const {
  double best = kInfinity;
  const auto enters = [&](const Node& node) {
    double from = nearest, to = best;
    for (double Vector::*axis : {&Vector::x, &Vector::y, &Vector::z}) {
      const double o = origin.*axis, d = direction.*axis;
      if (d == 0) {
        if (o < node.low.*axis || o > node.high.*axis) return false;
        continue;
      }
      const double a = (node.low.*axis - o) / d, b = (node.high.*axis - o) / d;
      from = std::max(from, std::min(a, b));
      to = std::min(to, std::max(a, b));
    }
    // The slabs are rounded: a few units in the last place must not lose a hit on a box's face.
    return from <= to + 1e-12 * (std::abs(from) + std::abs(to));
  };
  std::array<std::uint32_t, kStack> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Node& node = nodes_[stack[--size]];
    if (!enters(node)) continue;
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Triangle& t = triangles_[order_[i]];
      const Vector n = cross(t[1] - t[0], t[2] - t[0]);
      const double slope = dot(direction, n);
      if (slope == 0) continue;
      const double at = dot(t[0] - origin, n) / slope;
      if (!(at > nearest) || at >= best) continue;
      const Vector p = origin + at * direction;
      if (dot(cross(t[1] - t[0], p - t[0]), n) >= 0 && dot(cross(t[2] - t[1], p - t[1]), n) >= 0 &&
          dot(cross(t[0] - t[2], p - t[2]), n) >= 0) {
        best = at;
      }
    }
    if (node.count > 0) continue;
    stack[size++] = node.first;
    stack[size++] = node.first + 1;
  }
  return best;
}

}  // namespace ode_ext::oracle
