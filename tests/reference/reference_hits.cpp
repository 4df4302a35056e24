// SPDX-License-Identifier: BSD-3-Clause
#include "reference/reference_hits.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace ode_ext::test {
namespace {

// From one frame to another without passing through world coordinates, which may be huge.
Point between(const TestPose& from, const TestPose& to, const Point& p) {
  return rotate_back(to, rotate(from, p) + (from.position - to.position));
}

// Largest coordinate of the pair in the target's frame [m].
double pair_reach(const TestMesh& source, const TestPose& ps, const TestMesh& target,
                  const TestPose& pt) {
  double reach = 0;
  for (int i = 0; i < target.vertex_count(); ++i) {
    reach = std::max(reach, largest_component(target.vertex(static_cast<std::size_t>(i))));
  }
  for (int i = 0; i < source.vertex_count(); ++i) {
    const Point p = between(ps, pt, source.vertex(static_cast<std::size_t>(i)));
    reach = std::max(reach, largest_component(p));
  }
  return reach;
}

struct Ray {
  Point origin, direction;  // in the target's frame
  double exit;
};

struct Verdict {
  HitKind kind = HitKind::None;
  Crossing crossing{};
  bool ambiguous = false;
};

// `epsilon` [m]: within it a point lies on the surface.
Verdict judge(const Ray& ray, const ReferenceMesh& target, double epsilon) {
  Verdict verdict;
  for (const Crossing& c : crossings(target, ray.origin, ray.direction, epsilon)) {
    const double blur = epsilon / std::fabs(c.facing);  // of t and margin, for a slanted plane
    // At 0 the decision does not hang on the exact epsilon; in its neighbourhood it does.
    const double near_limit = std::fabs(c.t) / epsilon;
    const bool at_limit = near_limit > 1.0 / 16 && c.t < 8 * blur && c.t > -8 * blur;
    if (c.t < -8 * blur) continue;
    const bool at_border = c.margin < blur;
    if (c.margin < 0) {  // a near miss
      verdict.ambiguous = true;
      continue;
    }
    verdict.ambiguous = verdict.ambiguous || at_limit || at_border;
    if (c.t < -epsilon || (c.facing < 0 && c.t <= epsilon)) continue;
    if (c.facing < 0) return verdict;
    verdict.crossing = c;
    if (c.t <= epsilon) {
      verdict.kind = HitKind::Touching;
      return verdict;
    }
    if (std::fabs(c.t - ray.exit) < 8 * blur && ray.exit != c.t) verdict.ambiguous = true;
    if (c.t <= ray.exit + epsilon)
      verdict.kind = HitKind::Contact;
    else if (target.closed)
      verdict.kind = HitKind::Fallback;
    return verdict;
  }
  return verdict;
}

void cast_side(int side, const ReferenceMesh& source, const TestPose& ps,
               const ReferenceMesh& target, const TestPose& pt, double epsilon,
               std::vector<ReferenceHit>& hits) {
  for (std::size_t v = 0; v < source.vertices.size(); ++v) {
    if (length(source.normals[v]) == 0) continue;  // only zero-area triangles: no direction
    const Point direction = rotate_back(pt, rotate(ps, -1 * source.normals[v]));
    const Ray ray{between(ps, pt, source.vertices[v]), direction, source.exits[v]};
    const Verdict verdict = judge(ray, target, epsilon);
    ReferenceHit hit{};
    hit.side = side;
    hit.vertex = source.vertices[v];
    hit.position = to_world(ps, source.vertices[v]);
    hit.triangle = -1;
    hit.exit = ray.exit;
    hit.kind = verdict.kind;
    hit.ambiguous = verdict.ambiguous || source.doubtful[v];
    if (verdict.kind != HitKind::None) {
      const Crossing& c = verdict.crossing;
      hit.triangle = target.source_triangle[c.triangle];
      hit.t = c.t;
      hit.depth = verdict.kind == HitKind::Touching ? 0 : c.t * c.facing;
      // The vertex leaves along the target's normal; if it is b's vertex, a moves the other way.
      hit.normal = (side == 0 ? 1.0 : -1.0) * rotate(pt, target.face_normals[c.triangle]);
    }
    hits.push_back(hit);
  }
}

}  // namespace

std::vector<ReferenceHit> reference_rays(const TestMesh& a, const TestPose& pa, const TestMesh& b,
                                         const TestPose& pb, double open_thickness) {
  const ReferenceMesh ra = reference_mesh(a, open_thickness);
  const ReferenceMesh rb = reference_mesh(b, open_thickness);
  std::vector<ReferenceHit> hits;
  cast_side(0, ra, pa, rb, pb, rounding_bound(pair_reach(a, pa, b, pb)), hits);
  cast_side(1, rb, pb, ra, pa, rounding_bound(pair_reach(b, pb, a, pa)), hits);
  return hits;
}

std::vector<ReferenceHit> reference_hits(const TestMesh& a, const TestPose& pa, const TestMesh& b,
                                         const TestPose& pb, double open_thickness) {
  std::vector<ReferenceHit> hits;
  const auto rays = reference_rays(a, pa, b, pb, open_thickness);
  std::copy_if(rays.begin(), rays.end(), std::back_inserter(hits),
               [](const ReferenceHit& hit) { return hit.kind != HitKind::None; });
  return hits;
}

double comparison_tolerance(const TestMesh& a, const TestPose& pa, const TestMesh& b,
                            const TestPose& pb) {
  return rounding_bound(std::max(pair_reach(a, pa, b, pb), pair_reach(b, pb, a, pa)));
}

}  // namespace ode_ext::test
