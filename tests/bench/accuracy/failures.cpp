// SPDX-License-Identifier: BSD-3-Clause
#include "bench/accuracy/failures.h"

#include <cstdio>

#include "bench/accuracy/measures.h"

namespace ode_ext::accuracy {
namespace {

constexpr std::size_t kKept = 100;

nlohmann::json pose_json(dGeomID geom) {
  const test::TestPose pose = test::pose_of(geom);
  return {{"position", pose.position},
          {"rotation", pose.rotation},
          {"triangles", dGeomTriMeshGetTriangleCount(geom)}};
}

}  // namespace

nlohmann::json poses_of(const test::GeomPair& geoms) {
  return {{"g1", pose_json(geoms.first)}, {"g2", pose_json(geoms.second)}};
}

std::string describe(const dContactGeom* deepest, const test::Point& direction, double depth) {
  if (deepest == nullptr) return "no contact";
  const double off = 100 * (deepest->depth / depth - 1);
  char text[96];
  std::snprintf(text, sizeof text, "%.3g %% too %s, %.3g degrees off", std::fabs(off),
                off < 0 ? "shallow" : "deep", degrees_between(test::normal(*deepest), direction));
  return text;
}

void Failures::add(const std::string& what, const test::GeomPair& geoms) {
  if (++count_ <= kKept) first_.push_back({{"what", what}, {"poses", poses_of(geoms)}});
}

nlohmann::json Failures::json() const { return {{"count", count_}, {"first", first_}}; }

}  // namespace ode_ext::accuracy
