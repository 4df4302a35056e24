// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/isolation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include "geometry/ray_cast.h"
#include "geometry/triangle_distance.h"

namespace ode_ext {
namespace {

// A vertex deeper than a few triangles' size is not found by walking from the last triangle, and
// every triangle in a ball costs a distance. In an even mesh the nearest 40 fill a ball of 2.5
// circumradii; 4 bounds the search where large triangles lie among small ones.
constexpr double kLargestRadius = 4;  // of the farthest corner's distance from the middle
constexpr std::size_t kMostTriangles = 40;

// Floats hold each component of a unit normal to 2^-25, so the normal to sqrt(3) times that, and
// the cosine between two to twice that: 2^-23.2.
constexpr double kCosineError = 0x1p-23;
constexpr double kCosine10 = 0.98480775301220806 + kCosineError;
constexpr double kCosine30 = std::numbers::sqrt3 / 2 + kCosineError;
constexpr double kCosine60 = 0.5 + kCosineError;

// The middle in floats: with coordinates up to 1 the two sums are rounded by 2 and 3 times 2^-24,
// a third of which counts, and the third and the product with it by 2^-24 each. That is 3.7 * 2^-24
// along an axis, and sqrt(3) times that, 6.4 * 2^-24, at most. Rounding here is 2^-50.
constexpr double kMiddleError = 0x1p-21;  // of the largest coordinate

float rounded_down(double value) {
  const auto rounded = static_cast<float>(value);
  return rounded > value ? std::nextafter(rounded, 0.0f) : rounded;
}

double squared_distance(Vec3d point, const BvhNode& node) {
  const Vec3d outside = max(Vec3d(node.lo) - point, point - Vec3d(node.hi));
  const Vec3d positive = max(outside, Vec3d{});
  return dot(positive, positive);
}

class Search {
 public:
  Search(const std::vector<Vec3f>& vertices, const std::vector<Triangle>& triangles,
         const std::vector<Vec3f>& face_normals, const Bvh& bvh,
         const std::vector<Neighbours>& neighbours)
      : vertices_(vertices),
        triangles_(triangles),
        normals_(face_normals),
        bvh_(bvh),
        neighbours_(neighbours),
        seen_by_(triangles.size(), kNone) {
    double largest = 0;
    for (const Vec3f& v : vertices) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        largest = std::max(largest, std::fabs(double{v[axis]}));
      }
    }
    margin_ = kMiddleError * largest;
  }

  Isolation around(std::uint32_t triangle) {
    if (normals_[triangle] == Vec3f{}) return {};
    begin(triangle);
    spread();
    find_unreached();
    return {radius_within(limit_10_), radius_within(limit_30_), radius_within(limit_60_)};
  }

 private:
  float radius_within(double bound) const {
    return rounded_down(std::max(0.0, largest_level(bound) - margin_));
  }

  using Candidate = std::pair<double, std::uint32_t>;  // distance, triangle

  // For every radius in (above, up_to] the triangles nearer than it that connect to the centre
  // through such triangles are the same, and all of them have been visited.
  struct Level {
    double above, up_to;
  };

  Corners corners(std::uint32_t triangle) const {
    const Triangle& t = triangles_[triangle];
    return {Vec3d(vertices_[t[0]]), Vec3d(vertices_[t[1]]), Vec3d(vertices_[t[2]])};
  }

  void begin(std::uint32_t triangle) {
    centre_ = triangle;
    normal_ = Vec3d(normals_[triangle]);
    const Corners own = corners(triangle);
    middle_ = (1.0 / 3) * (own[0] + own[1] + own[2]);
    limit_10_ = limit_30_ = limit_60_ =
        kLargestRadius *
        std::max({length(own[0] - middle_), length(own[1] - middle_), length(own[2] - middle_)});
    farthest_ = 0;
    levels_.clear();
    frontier_.clear();
  }

  void limit(double distance) {
    limit_10_ = std::min(limit_10_, distance);
    limit_30_ = std::min(limit_30_, distance);
    limit_60_ = std::min(limit_60_, distance);
  }

  // To the frontier, unless it faces elsewhere.
  void consider(std::uint32_t triangle) {
    if (triangle == kNone || seen_by_[triangle] == centre_) return;
    seen_by_[triangle] = centre_;
    const double distance = std::sqrt(squared_distance(middle_, corners(triangle)));
    if (normals_[triangle] != Vec3f{}) {
      const double cosine = dot(normal_, Vec3d(normals_[triangle]));
      if (!(cosine >= kCosine10)) limit_10_ = std::min(limit_10_, distance);
      if (!(cosine >= kCosine30)) limit_30_ = std::min(limit_30_, distance);
      if (!(cosine >= kCosine60)) {
        limit_60_ = std::min(limit_60_, distance);
        return;
      }
    }
    // Not known when a level of a larger radius was recorded, it was not connected there.
    if (distance < farthest_) {
      for (Level& level : levels_) level.up_to = std::min(level.up_to, distance);
    }
    frontier_.emplace_back(distance, triangle);
    std::push_heap(frontier_.begin(), frontier_.end(), std::greater<>());
  }

  // Over edges, always to the nearest triangle of the frontier.
  void spread() {
    consider(centre_);
    for (std::size_t visited = 0; visited < kMostTriangles && !frontier_.empty(); ++visited) {
      std::pop_heap(frontier_.begin(), frontier_.end(), std::greater<>());
      const auto [distance, triangle] = frontier_.back();
      frontier_.pop_back();
      if (distance >= limit_60_) return;
      farthest_ = std::max(farthest_, distance);
      for (const std::uint32_t neighbour : neighbours_[triangle]) consider(neighbour);
      const double next =
          frontier_.empty() ? std::numeric_limits<double>::infinity() : frontier_.front().first;
      levels_.push_back({farthest_, next});
    }
  }

  // Triangles that have not been seen are part of another sheet, or beyond what is visited.
  void find_unreached() {
    double radius = largest_level(limit_60_);
    for (std::uint32_t i = 0; i < bvh_.nodes.size();) {
      const BvhNode& node = bvh_.nodes[i];
      if (squared_distance(middle_, node) >= radius * radius) {
        i = node.skip;
        continue;
      }
      const std::uint32_t first = node.leaf >> 3;
      for (std::uint32_t k = first; k < first + (node.leaf & 7); ++k) {
        const std::uint32_t triangle = bvh_.order[k];
        if (seen_by_[triangle] == centre_ || normals_[triangle] == Vec3f{}) continue;
        const double distance = std::sqrt(squared_distance(middle_, corners(triangle)));
        radius = std::min(radius, distance);
        limit(distance);
      }
      ++i;
    }
  }

  // The largest radius up to `bound` at which some level holds, also if the middle is off and what
  // connects therefore farther away than a radius that was made smaller; 0 if there is none.
  double largest_level(double bound) const {
    double largest = 0;
    for (const Level& level : levels_) {
      const double radius = std::min(bound, level.up_to);
      if (level.above + 2 * margin_ < radius) largest = std::max(largest, radius);
    }
    return largest;
  }

  const std::vector<Vec3f>& vertices_;
  const std::vector<Triangle>& triangles_;
  const std::vector<Vec3f>& normals_;
  const Bvh& bvh_;
  const std::vector<Neighbours>& neighbours_;
  double margin_ = 0;  // [m]

  std::uint32_t centre_ = kNone;
  Vec3d normal_, middle_;
  double limit_10_ = 0, limit_30_ = 0, limit_60_ = 0;  // nearest triangle that may not be inside
  double farthest_ = 0;                                // that was visited
  std::vector<Level> levels_;
  std::vector<Candidate> frontier_;     // a heap, the nearest first
  std::vector<std::uint32_t> seen_by_;  // for each triangle the last centre that considered it
};

}  // namespace

std::vector<Isolation> isolation(const std::vector<Vec3f>& vertices,
                                 const std::vector<Triangle>& triangles,
                                 const std::vector<Vec3f>& face_normals, const Bvh& bvh,
                                 const std::vector<Neighbours>& neighbours) {
  Search search(vertices, triangles, face_normals, bvh, neighbours);
  std::vector<Isolation> result;
  result.reserve(triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) result.push_back(search.around(i));
  return result;
}

}  // namespace ode_ext
