// SPDX-License-Identifier: BSD-3-Clause
// A tree of boxes over the triangles of a mesh: what is near a box, near a point, along a ray.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "support/points.h"

namespace ode_ext::test {

struct ContactBox {
  Point low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  void add(const Point& p);
  bool meets(const ContactBox& other, double margin) const;
  double squared_distance(const Point& p) const;
};

using ContactTriangle = std::array<Point, 3>;

Point closest_point(const ContactTriangle& triangle, const Point& p);

// Where a ray meets a triangle, from behind or not.
struct TriangleHit {
  double t;
  std::size_t triangle;
  bool back;
};

class ContactTree {
 public:
  ContactTree() = default;
  explicit ContactTree(std::vector<ContactTriangle> triangles);

  const ContactBox& bounds() const { return nodes_[0].box; }
  // Calls `visit` for every triangle whose box comes within `margin` [m] of the box.
  void near(const ContactBox& box, double margin,
            const std::function<void(std::size_t)>& visit) const;
  // The triangles that are at most `tie` [m] farther from p than the nearest, ascending.
  std::vector<std::size_t> nearest(const Point& p, double tie) const;
  // Every triangle the ray meets at t > 0, by t, then by triangle. `direction`: unit.
  std::vector<TriangleHit> along(const Point& origin, const Point& direction) const;

 private:
  struct Node {
    ContactBox box;
    std::size_t first = 0;  // leaf: of order_; else the left child, and the right one follows it
    std::size_t count = 0;  // 0: not a leaf
  };
  void build(std::size_t node, std::size_t first, std::size_t count);
  template <class Enter, class Visit>
  void traverse(const Enter& enter, const Visit& visit) const;

  std::vector<ContactTriangle> triangles_;
  std::vector<ContactBox> boxes_;
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace ode_ext::test
