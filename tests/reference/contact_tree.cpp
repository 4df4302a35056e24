// SPDX-License-Identifier: BSD-3-Clause
#include "reference/contact_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace ode_ext::test {
namespace {

constexpr std::size_t kLeafTriangles = 4;

Point closest_on_segment(const Point& a, const Point& b, const Point& p) {
  const Point along = b - a;
  const double whole = dot(along, along);
  const double t = whole > 0 ? std::clamp(dot(p - a, along) / whole, 0.0, 1.0) : 0;
  return a + t * along;
}

}  // namespace

void ContactBox::add(const Point& p) {
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = std::min(low[k], p[k]);
    high[k] = std::max(high[k], p[k]);
  }
}

bool ContactBox::meets(const ContactBox& other, double margin) const {
  for (std::size_t k = 0; k < 3; ++k)
    if (low[k] > other.high[k] + margin || high[k] < other.low[k] - margin) return false;
  return true;
}

double ContactBox::squared_distance(const Point& p) const {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double outside = std::max({low[k] - p[k], p[k] - high[k], 0.0});
    sum += outside * outside;
  }
  return sum;
}

// If p projects into the triangle it is that point, else it is on one of the sides.
Point closest_point(const ContactTriangle& t, const Point& p) {
  const Point n = cross(t[1] - t[0], t[2] - t[0]);
  const double area = dot(n, n);
  bool within = area > 0;
  for (std::size_t k = 0; k < 3 && within; ++k)
    within = dot(cross(t[(k + 1) % 3] - t[k], p - t[k]), n) > 0;
  if (within) return p - (dot(p - t[0], n) / area) * n;
  Point best = closest_on_segment(t[0], t[1], p);
  for (std::size_t k = 1; k < 3; ++k) {
    const Point other = closest_on_segment(t[k], t[(k + 1) % 3], p);
    if (distance(other, p) < distance(best, p)) best = other;
  }
  return best;
}

ContactTree::ContactTree(std::vector<ContactTriangle> triangles)
    : triangles_(std::move(triangles)), order_(triangles_.size()), nodes_(1) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  for (const ContactTriangle& triangle : triangles_) {
    ContactBox box;
    for (const Point& corner : triangle) box.add(corner);
    boxes_.push_back(box);
  }
  if (!triangles_.empty()) build(0, 0, triangles_.size());
}

// Halves by the boxes' middles along the longest axis.
void ContactTree::build(std::size_t node, std::size_t first, std::size_t count) {
  ContactBox box;
  for (std::size_t i = first; i < first + count; ++i) {
    box.add(boxes_[order_[i]].low);
    box.add(boxes_[order_[i]].high);
  }
  nodes_[node].box = box;
  if (count <= kLeafTriangles) {
    nodes_[node].first = first;
    nodes_[node].count = count;
    return;
  }
  const Point size = box.high - box.low;
  const std::size_t axis = size[1] > size[0]   ? (size[2] > size[1] ? 2 : 1)
                           : size[2] > size[0] ? 2
                                               : 0;
  const auto middle = [&](std::size_t i) { return boxes_[i].low[axis] + boxes_[i].high[axis]; };
  const std::size_t half = count / 2;
  const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(first);
  std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(half),
                   begin + static_cast<std::ptrdiff_t>(count), [&](std::size_t a, std::size_t b) {
                     return std::pair(middle(a), a) < std::pair(middle(b), b);
                   });
  const std::size_t left = nodes_.size();
  nodes_.resize(left + 2);
  nodes_[node].first = left;
  build(left, first, half);
  build(left + 1, first + half, count - half);
}

template <class Enter, class Visit>
void ContactTree::traverse(const Enter& enter, const Visit& visit) const {
  if (triangles_.empty()) return;
  // Halving makes the tree no deeper than a count has bits, and one sibling waits at each level.
  std::array<std::size_t, 128> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Node& node = nodes_[stack[--size]];
    if (!enter(node.box)) continue;
    for (std::size_t i = node.first; i < node.first + node.count; ++i) visit(order_[i]);
    if (node.count > 0) continue;
    stack[size++] = node.first;
    stack[size++] = node.first + 1;
  }
}

void ContactTree::near(const ContactBox& box, double margin,
                       const std::function<void(std::size_t)>& visit) const {
  traverse([&](const ContactBox& node) { return node.meets(box, margin); },
           [&](std::size_t triangle) {
             if (boxes_[triangle].meets(box, margin)) visit(triangle);
           });
}

std::vector<std::size_t> ContactTree::nearest(const Point& p, double tie) const {
  double best = ContactBox::infinity;
  const auto of = [&](std::size_t i) { return distance(closest_point(triangles_[i], p), p); };
  const auto within = [&](double reach) {
    return [&p, reach](const ContactBox& box) {
      return box.squared_distance(p) <= reach * reach * (1 + 1e-12);
    };
  };
  traverse([&](const ContactBox& box) { return within(best)(box); },
           [&](std::size_t i) { best = std::min(best, of(i)); });
  std::vector<std::size_t> found;
  traverse(within(best + tie), [&](std::size_t i) {
    if (of(i) <= best + tie) found.push_back(i);
  });
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<TriangleHit> ContactTree::along(const Point& origin, const Point& direction) const {
  std::vector<TriangleHit> hits;
  const auto enters = [&](const ContactBox& box) {
    double from = 0, to = ContactBox::infinity;
    for (std::size_t k = 0; k < 3; ++k) {
      if (direction[k] == 0) {
        if (origin[k] < box.low[k] || origin[k] > box.high[k]) return false;
        continue;
      }
      const double a = (box.low[k] - origin[k]) / direction[k];
      const double b = (box.high[k] - origin[k]) / direction[k];
      from = std::max(from, std::min(a, b));
      to = std::min(to, std::max(a, b));
    }
    // The slabs are rounded: that must not lose a hit on a box's own face.
    return from <= to + 1e-12 * (std::fabs(from) + std::fabs(to));
  };
  traverse(enters, [&](std::size_t i) {
    const ContactTriangle& t = triangles_[i];
    const Point n = cross(t[1] - t[0], t[2] - t[0]);
    const double slope = dot(direction, n);
    if (slope == 0) return;
    const double at = dot(t[0] - origin, n) / slope;
    if (!(at > 0)) return;
    const Point p = origin + at * direction;
    for (std::size_t k = 0; k < 3; ++k)
      if (dot(cross(t[(k + 1) % 3] - t[k], p - t[k]), n) < 0) return;
    hits.push_back({at, i, slope > 0});
  });
  std::sort(hits.begin(), hits.end(), [](const TriangleHit& a, const TriangleHit& b) {
    return std::tie(a.t, a.triangle) < std::tie(b.t, b.triangle);
  });
  return hits;
}

}  // namespace ode_ext::test
