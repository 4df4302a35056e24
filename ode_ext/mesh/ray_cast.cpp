// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/ray_cast.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ode_ext {
namespace {

// Brings the ray onto the z axis by a permutation and a shear, so that the test of a triangle
// becomes the sign of three 2D edge functions (Woop, Benthin, Wald 2013). The edge that two
// triangles share gives both the same number with opposite sign; no rounding can come between.
class ShearedTriangleTest {
 public:
  explicit ShearedTriangleTest(const Ray& ray) : origin_(ray.origin) {
    const Vec3d d = ray.direction;
    z_ = std::fabs(d.x) > std::fabs(d.y) ? 0 : 1;
    if (std::fabs(d.z) > std::fabs(d[z_])) z_ = 2;
    x_ = (z_ + 1) % 3;
    y_ = (z_ + 2) % 3;
    if (d[z_] < 0) std::swap(x_, y_);  // keeps the winding
    shear_ = {d[x_] / d[z_], d[y_] / d[z_], 1 / d[z_]};
  }

  // True with t and the side if the line meets the triangle.
  bool operator()(Vec3f corner_a, Vec3f corner_b, Vec3f corner_c, RayHit& hit) const {
    const Vec3d a = sheared(corner_a);
    const Vec3d b = sheared(corner_b);
    const Vec3d c = sheared(corner_c);
    const double u = c.x * b.y - c.y * b.x;
    const double v = a.x * c.y - a.y * c.x;
    const double w = b.x * a.y - b.y * a.x;
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return false;
    const double det = u + v + w;
    if (det == 0) return false;
    hit.t = (u * a.z + v * b.z + w * c.z) / det;
    hit.back = det < 0;  // counter-clockwise as seen along the ray
    return true;
  }

 private:
  Vec3d sheared(Vec3f corner) const {
    const Vec3d p = Vec3d(corner) - origin_;
    return {p[x_] - shear_.x * p[z_], p[y_] - shear_.y * p[z_], shear_.z * p[z_]};
  }

  Vec3d origin_;
  std::size_t x_, y_, z_;
  Vec3d shear_;
};

// Boxes are widened by 2^-48 of the coordinates: the differences and products of the triangle test
// are off by a few 2^-53 of them, and what it accepts must not be lost to the box before.
class SlabTest {
 public:
  SlabTest(const Ray& ray, const BvhNode& root) : origin_(ray.origin) {
    double largest = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      inverse_[axis] = 1 / ray.direction[axis];
      largest = std::max({largest, std::fabs(ray.origin[axis]), std::fabs(double{root.lo[axis]}),
                          std::fabs(double{root.hi[axis]})});
    }
    widening_ = 0x1p-48 * largest;
  }

  bool operator()(const BvhNode& node, double t_min, double t_max) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double enter = (node.lo[axis] - widening_ - origin_[axis]) * inverse_[axis];
      double leave = (node.hi[axis] + widening_ - origin_[axis]) * inverse_[axis];
      if (inverse_[axis] < 0) std::swap(enter, leave);
      // NaN is 0 * infinity, an origin on the plane of a slab that the ray runs along: no bound.
      t_min = enter > t_min ? enter : t_min;
      t_max = leave < t_max ? leave : t_max;
    }
    return t_min <= t_max;
  }

 private:
  Vec3d origin_;
  Vec3d inverse_{};
  double widening_ = 0;
};

bool has_corner(const Triangle& triangle, std::uint32_t vertex) {
  return triangle[0] == vertex || triangle[1] == vertex || triangle[2] == vertex;
}

}  // namespace

RayHit cast_ray(const Ray& ray, const Bvh& bvh, const std::vector<Vec3f>& vertices,
                const std::vector<Triangle>& triangles) {
  RayHit nearest;
  double nearest_of[2] = {nearest.t, nearest.t};  // front faces, back faces
  if (bvh.nodes.empty()) return nearest;
  const ShearedTriangleTest meets(ray);
  const SlabTest may_meet(ray, bvh.nodes[0]);
  double t_max = ray.t_max;
  for (std::uint32_t i = 0; i < bvh.nodes.size();) {
    const BvhNode& node = bvh.nodes[i];
    if (!may_meet(node, ray.t_min, t_max)) {
      i = node.skip;
      continue;
    }
    const std::uint32_t first = node.leaf >> 3;
    for (std::uint32_t k = first; k < first + (node.leaf & 7); ++k) {
      const std::uint32_t index = bvh.order[k];
      const Triangle& triangle = triangles[index];
      if (has_corner(triangle, ray.excluded_vertex)) continue;
      RayHit hit;
      if (!meets(vertices[triangle[0]], vertices[triangle[1]], vertices[triangle[2]], hit))
        continue;
      if (!(hit.t >= ray.t_min && hit.t <= t_max)) continue;
      hit.triangle = index;
      double& of_side = nearest_of[hit.back ? 1 : 0];
      of_side = std::min(of_side, hit.t);
      if (hit.t < nearest.t || (hit.t == nearest.t && index < nearest.triangle)) nearest = hit;
      t_max = std::min(ray.t_max, nearest.t + ray.near);
    }
    ++i;
  }
  nearest.both =
      nearest.triangle != kNone && std::max(nearest_of[0], nearest_of[1]) <= nearest.t + ray.near;
  return nearest;
}

}  // namespace ode_ext
