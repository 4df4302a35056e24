// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/embedded.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "geometry/box.h"
#include "geometry/ray_cast.h"
#include "geometry/self_contact.h"
#include "geometry/triangle_distance.h"

namespace ode_ext {
namespace {

// A kernel places a hit to within 2^-20 of the mesh's extent. Two sheets may each be off by that,
// and so may what tells whether a hit is at the ray's origin; 2^-18 keeps their order beyond doubt.
// Distances here are off by 2^-20 at most (triangle_distance.h), and that only between parallels.
constexpr double kTouching = 0x1p-18;  // of the size

// Whether a point lies above or below a triangle that leans by more than kSteep from the vertical.
// Nothing touches, so no height of a triangle is less than 2^-18 of the size nor its normal off by
// more than 2^-53 * 8 * 2^18 (normals.cpp), which moves the place above the point by 2^-22.
constexpr double kSteep = 0x1p-10;
constexpr double kSamePlace = 0x1p-20;  // of the size

// What roundings are proportional to: the diagonal, or the distance from the origin.
double size_of(const std::vector<Vec3f>& vertices) {
  const Box box = box_of(vertices);
  const Vec3d farthest = max(Vec3d(box.hi), -Vec3d(box.lo));
  return std::max(length(extent(box)), length(farthest));
}

enum class Side : std::uint8_t { kAbove, kBelow, kUnknown };

class Sheets {
 public:
  Sheets(const std::vector<Vec3f>& vertices, const std::vector<Triangle>& triangles,
         const std::vector<Vec3f>& normals, const Bvh& bvh, double same_place)
      : vertices_(vertices),
        triangles_(triangles),
        normals_(normals),
        bvh_(bvh),
        same_place_(same_place) {}

  // Whether the space before the triangle is outside and that behind it inside: whether as many
  // triangles face up as down above it, along the axis it faces most, or one more if that axis
  // runs into the solid.
  bool face_outward_at(std::uint32_t triangle) const {
    const Vec3f normal = normals_[triangle];
    std::size_t up = std::fabs(normal.x) > std::fabs(normal.y) ? 0 : 1;
    if (std::fabs(normal.z) > std::fabs(normal[up])) up = 2;
    const Corners own = corners(triangle);
    const Vec3d middle = (1.0 / 3) * (own[0] + own[1] + own[2]);

    int facing_up = 0;  // less those facing down
    for (std::uint32_t i = 0; i < bvh_.nodes.size();) {
      const BvhNode& node = bvh_.nodes[i];
      if (!is_below(middle, node, up)) {
        i = node.skip;
        continue;
      }
      const std::uint32_t first = node.leaf >> 3;
      for (std::uint32_t k = first; k < first + (node.leaf & 7); ++k) {
        if (bvh_.order[k] == triangle) continue;
        const Corners above = corners(bvh_.order[k]);
        const int turns = turns_about(middle, above, up);
        if (turns == 0) continue;
        const Side side = side_of(middle, above, up);
        if (side == Side::kUnknown) return false;
        if (side == Side::kAbove) facing_up += turns;
      }
      ++i;
    }
    return facing_up == (normal[up] > 0 ? 0 : 1);
  }

 private:
  Corners corners(std::uint32_t triangle) const {
    const Triangle& t = triangles_[triangle];
    return {Vec3d(vertices_[t[0]]), Vec3d(vertices_[t[1]]), Vec3d(vertices_[t[2]])};
  }

  // Whether something in the box may lie above the point.
  static bool is_below(Vec3d point, const BvhNode& box, std::size_t up) {
    const std::size_t x = (up + 1) % 3, y = (up + 2) % 3;
    return point[x] >= box.lo[x] && point[x] <= box.hi[x] && point[y] >= box.lo[y] &&
           point[y] <= box.hi[y] && point[up] <= box.hi[up];
  }

  // How often the rim of the triangle runs around the point, seen from above: 1 if it faces up, -1
  // if down, 0 if it does not lie above or below. The two sides of an edge always cancel out, so
  // that of two neighbours exactly one counts, or none of two that face differently.
  static int turns_about(Vec3d point, const Corners& triangle, std::size_t up) {
    const std::size_t x = (up + 1) % 3, y = (up + 2) % 3;
    int turns = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3d from = triangle[k] - point, to = triangle[(k + 1) % 3] - point;
      int sign = 1;
      if (from[y] > to[y]) {
        std::swap(from, to);
        sign = -1;
      }
      const bool passes = from[y] <= 0 && to[y] > 0;
      if (passes && from[x] * to[y] - from[y] * to[x] > 0) turns += sign;
    }
    return turns;
  }

  // Where the triangle is seen from the point.
  Side side_of(Vec3d point, const Corners& triangle, std::size_t up) const {
    const double a = triangle[0][up], b = triangle[1][up], c = triangle[2][up];
    if (std::min({a, b, c}) > point[up]) return Side::kAbove;
    if (std::max({a, b, c}) < point[up]) return Side::kBelow;
    const Vec3d normal = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    if (!(std::fabs(normal[up]) > kSteep * length(normal))) return Side::kUnknown;
    const double height = dot(normal, triangle[0] - point) / normal[up];
    if (!(std::fabs(height) > same_place_)) return Side::kUnknown;
    return height > 0 ? Side::kAbove : Side::kBelow;
  }

  const std::vector<Vec3f>& vertices_;
  const std::vector<Triangle>& triangles_;
  const std::vector<Vec3f>& normals_;
  const Bvh& bvh_;
  double same_place_;  // [m]
};

// Of each connected part the largest triangle, on which a point is well away from other triangles.
std::vector<std::uint32_t> one_of_each_part(const std::vector<Vec3f>& vertices,
                                            const std::vector<Triangle>& triangles,
                                            const std::vector<Neighbours>& neighbours) {
  const auto area = [&](std::uint32_t i) {
    const Vec3d a(vertices[triangles[i][0]]);
    return length(
        cross(Vec3d(vertices[triangles[i][1]]) - a, Vec3d(vertices[triangles[i][2]]) - a));
  };
  std::vector<std::uint32_t> largest, queue;
  std::vector<bool> seen(triangles.size(), false);
  for (std::uint32_t seed = 0; seed < triangles.size(); ++seed) {
    if (seen[seed]) continue;
    seen[seed] = true;
    queue.assign(1, seed);
    for (std::size_t head = 0; head < queue.size(); ++head) {
      for (const std::uint32_t next : neighbours[queue[head]]) {
        if (seen[next]) continue;
        seen[next] = true;
        queue.push_back(next);
      }
    }
    largest.push_back(
        *std::max_element(queue.begin(), queue.end(),
                          [&](std::uint32_t a, std::uint32_t b) { return area(a) < area(b); }));
  }
  return largest;
}

bool is_closed(const std::vector<Neighbours>& neighbours) {
  return std::all_of(neighbours.begin(), neighbours.end(), [](const Neighbours& across) {
    return std::find(across.begin(), across.end(), kNone) == across.end();
  });
}

}  // namespace

// Parts that do not touch themselves or one another cut space into regions, before and behind each.
// A line crosses in turn if all regions before one are outside, no matter which: if nothing, or as
// much facing up as down, lies above a point before each.
bool is_embedded(const std::vector<Vec3f>& vertices, const std::vector<Triangle>& triangles,
                 const std::vector<Neighbours>& neighbours, const Bvh& bvh,
                 const std::vector<Vec3f>& face_normals) {
  if (triangles.empty() || triangles.size() > kMostExaminedTriangles) return false;
  if (!is_closed(neighbours)) return false;
  const double size = size_of(vertices);
  if (touches_itself(vertices, triangles, face_normals, bvh, kTouching * size)) return false;
  const Sheets sheets(vertices, triangles, face_normals, bvh, kSamePlace * size);
  const std::vector<std::uint32_t> parts = one_of_each_part(vertices, triangles, neighbours);
  return std::all_of(parts.begin(), parts.end(),
                     [&](std::uint32_t triangle) { return sheets.face_outward_at(triangle); });
}

}  // namespace ode_ext
