// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/self_contact.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/box.h"
#include "geometry/triangle_distance.h"

namespace ode_ext {
namespace {

// In an even mesh few boxes but those of the dozen triangles around it overlap a triangle's own. A
// vertex of thousands of triangles would have all pairs of them compared.
constexpr std::size_t kMostPairs = 256;  // per triangle

bool overlap(const Box& a, Vec3f lo, Vec3f hi) {
  return a.lo.x <= hi.x && a.lo.y <= hi.y && a.lo.z <= hi.z && a.hi.x >= lo.x && a.hi.y >= lo.y &&
         a.hi.z >= lo.z;
}

Vec3d unit(Vec3d a) { return (1 / length(a)) * a; }

bool has_corner(const Triangle& triangle, std::uint32_t corner) {
  return triangle[0] == corner || triangle[1] == corner || triangle[2] == corner;
}

std::array<bool, 3> corners_in(const Triangle& own, const Triangle& other) {
  return {has_corner(other, own[0]), has_corner(other, own[1]), has_corner(other, own[2])};
}

// Begins with the first corner that is shared.
Corners turned_to(const std::array<bool, 3>& shared, const Corners& triangle) {
  const std::size_t first = shared[0] ? 0 : shared[1] ? 1 : 2;
  return {triangle[first], triangle[(first + 1) % 3], triangle[(first + 2) % 3]};
}

// Whether all of `other` lies beyond one side of the prism over a triangle, or to one side of its
// plane. The normal is a unit vector; without one, the answer is no.
bool are_apart(Vec3d normal, const Corners& own, const Corners& other, double distance) {
  const auto least = [&](Vec3d axis, Vec3d from) {
    return std::min(
        {dot(axis, other[0] - from), dot(axis, other[1] - from), dot(axis, other[2] - from)});
  };
  if (least(normal, own[0]) > distance || least(-normal, own[0]) > distance) return true;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d edge = own[(k + 1) % 3] - own[k];
    if (least(cross(edge, normal), own[k]) > distance * length(edge)) return true;
  }
  return false;
}

// Whether a plane through the first corner, which both share, has the others well to either side.
// The one halfway between the triangles has, unless they lie askew.
bool part_at_corner(const Corners& a, const Corners& b, double distance) {
  const Vec3d a1 = a[1] - a[0], a2 = a[2] - a[0], b1 = b[1] - b[0], b2 = b[2] - b[0];
  const Vec3d axis = unit(a1 + a2) - unit(b1 + b2);
  const double beyond = distance * length(axis);
  return std::min(dot(axis, a1), dot(axis, a2)) > beyond &&
         std::max(dot(axis, b1), dot(axis, b2)) < -beyond;
}

class Comparison {
 public:
  Comparison(const std::vector<Vec3f>& vertices, const std::vector<Triangle>& triangles,
             const std::vector<Vec3f>& normals, const Bvh& bvh, double distance)
      : vertices_(vertices),
        triangles_(triangles),
        normals_(normals),
        bvh_(bvh),
        distance_(distance) {
    boxes_.reserve(triangles.size());
    for (const Triangle& t : triangles) {
      const Box corner{vertices[t[0]], vertices[t[0]]};
      boxes_.push_back(grown(grown(corner, vertices[t[1]]), vertices[t[2]]));
    }
  }

  bool finds_contact() {
    pairs_left_ = kMostPairs * triangles_.size();
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
      if (finds_contact_with_later(i)) return true;
    }
    return false;
  }

 private:
  Corners corners(const Triangle& t) const {
    return {Vec3d(vertices_[t[0]]), Vec3d(vertices_[t[1]]), Vec3d(vertices_[t[2]])};
  }

  bool finds_contact_with_later(std::uint32_t triangle) {
    const Box box = widened(boxes_[triangle]);
    for (std::uint32_t i = 0; i < bvh_.nodes.size();) {
      const BvhNode& node = bvh_.nodes[i];
      if (!overlap(box, node.lo, node.hi)) {
        i = node.skip;
        continue;
      }
      const std::uint32_t first = node.leaf >> 3;
      for (std::uint32_t k = first; k < first + (node.leaf & 7); ++k) {
        const std::uint32_t other = bvh_.order[k];
        if (other <= triangle || !overlap(box, boxes_[other].lo, boxes_[other].hi)) continue;
        if (pairs_left_-- == 0 || touch(triangle, other)) return true;
      }
      ++i;
    }
    return false;
  }

  // By twice the distance, so that rounding to floats (2^-24) takes nothing of it away.
  Box widened(const Box& box) const {
    const auto margin = static_cast<float>(2 * distance_);
    const Vec3f around{margin, margin, margin};
    return {box.lo - around, box.hi + around};
  }

  bool near(double squared) const { return !(squared > distance_ * distance_); }

  // Whether two corners, edges or insides touch that have no corner in common. Two triangles that
  // meet where they should not do so at such a pair: what they have in common is convex, holds the
  // corner or edge that they share, and so goes on to a side that faces it.
  bool touch(std::uint32_t one, std::uint32_t two) const {
    const Triangle &a = triangles_[one], &b = triangles_[two];
    const std::array<bool, 3> a_shared = corners_in(a, b), b_shared = corners_in(b, a);
    const int shared = a_shared[0] + a_shared[1] + a_shared[2];
    if (shared == 3) return true;

    // The quick answers. They ask for twice the distance, as floats hold the normals to 2^-24.
    const Corners at_a = corners(a), at_b = corners(b);
    if (shared == 0 && (are_apart(Vec3d(normals_[one]), at_a, at_b, 2 * distance_) ||
                        are_apart(Vec3d(normals_[two]), at_b, at_a, 2 * distance_))) {
      return false;
    }
    if (shared == 1 &&
        part_at_corner(turned_to(a_shared, at_a), turned_to(b_shared, at_b), 2 * distance_)) {
      return false;
    }

    for (std::size_t k = 0; k < 3; ++k) {
      if (!a_shared[k] && near(squared_distance(at_a[k], at_b))) return true;
      if (!b_shared[k] && near(squared_distance(at_b[k], at_a))) return true;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      const Segment edge_a{at_a[k], at_a[next]}, edge_b{at_b[k], at_b[next]};
      if (!a_shared[k] && !a_shared[next] && crosses(edge_a, at_b)) return true;
      if (!b_shared[k] && !b_shared[next] && crosses(edge_b, at_a)) return true;
      const auto on_edge_a = [&](std::uint32_t corner) {
        return corner == a[k] || corner == a[next];
      };
      for (std::size_t m = 0; m < 3; ++m) {
        const std::size_t last = (m + 1) % 3;
        if (on_edge_a(b[m]) || on_edge_a(b[last])) continue;
        if (near(squared_distance(edge_a, Segment{at_b[m], at_b[last]}))) return true;
      }
    }
    return false;
  }

  const std::vector<Vec3f>& vertices_;
  const std::vector<Triangle>& triangles_;
  const std::vector<Vec3f>& normals_;
  const Bvh& bvh_;
  double distance_;
  std::vector<Box> boxes_;  // of the triangles
  std::size_t pairs_left_ = 0;
};

}  // namespace

bool touches_itself(const std::vector<Vec3f>& vertices, const std::vector<Triangle>& triangles,
                    const std::vector<Vec3f>& face_normals, const Bvh& bvh, double distance) {
  return Comparison(vertices, triangles, face_normals, bvh, distance).finds_contact();
}

}  // namespace ode_ext
