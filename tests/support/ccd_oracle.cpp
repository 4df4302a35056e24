// SPDX-License-Identifier: BSD-3-Clause
#include "support/ccd_oracle.h"

#include <ccd/ccd.h>

#include <algorithm>

namespace ode_ext::test {
namespace {

struct Hull {
  std::vector<Point> corners;  // relative to a common origin, so that far scenes lose nothing
};

Hull hull_of(const TestMesh& mesh, const TestPose& pose, const Point& origin) {
  Hull hull;
  for (std::size_t i = 0; i < mesh.vertices.size() / 3; ++i) {
    hull.corners.push_back(rotate(pose, mesh.vertex(i)) + (pose.position - origin));
  }
  return hull;
}

void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* result) {
  const auto& corners = static_cast<const Hull*>(object)->corners;
  const Point d{direction->v[0], direction->v[1], direction->v[2]};
  const Point& best =
      *std::max_element(corners.begin(), corners.end(),
                        [&](const Point& p, const Point& q) { return dot(p, d) < dot(q, d); });
  ccdVec3Set(result, best[0], best[1], best[2]);
}

}  // namespace

ConvexPenetration convex_penetration(const TestMesh& a, const TestPose& pa, const TestMesh& b,
                                     const TestPose& pb) {
  const Hull ha = hull_of(a, pa, pb.position), hb = hull_of(b, pb, pb.position);
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = ccd.support2 = support;
  ccd.max_iterations = 1000;  // EPA adds one face at a time; the default never gives up
  ccd.epa_tolerance = kEpaTolerance * std::max(mesh_size(a), mesh_size(b));
  ccd_real_t depth = 0;
  ccd_vec3_t direction, position;
  ConvexPenetration result;
  // libccd's direction moves its second object, which here is a.
  result.overlap = ccdGJKPenetration(&hb, &ha, &ccd, &depth, &direction, &position) == 0;
  if (result.overlap) {
    result.depth = depth;
    result.direction = {direction.v[0], direction.v[1], direction.v[2]};
  }
  return result;
}

}  // namespace ode_ext::test
