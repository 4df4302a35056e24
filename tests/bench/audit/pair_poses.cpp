// SPDX-License-Identifier: BSD-3-Clause
#include "bench/audit/pair_poses.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ode_ext::audit {
namespace {

using namespace test;

// How far the mesh reaches from its origin along `direction` [m].
double reach(const TestMesh& mesh, const TestPose& pose, const Point& direction) {
  const Point local = rotate_back(pose, direction);
  double most = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(mesh.vertex_count()); ++i) {
    most = std::max(most, dot(mesh.vertex(i), local));
  }
  return most;
}

Point in_box(const Point& low, const Point& high, Random& random) {
  Point p{};
  for (std::size_t k = 0; k < 3; ++k) p[k] = random.uniform(low[k], high[k]);
  return p;
}

}  // namespace

const char* name_of(Approach approach) {
  constexpr const char* kNames[] = {"shallow", "deep", "contained"};
  return kNames[static_cast<std::size_t>(approach)];
}

oracle::Pose oracle_pose(const TestPose& pose) {
  const auto& r = pose.rotation;
  const Point& p = pose.position;
  return {{{{r[0], r[1], r[2]}, {r[3], r[4], r[5]}, {r[6], r[7], r[8]}}}, {p[0], p[1], p[2]}};
}

PosedPair shallow_pair(const TestMesh& a, const TestMesh& b, Random& random) {
  PosedPair pair{Approach::kShallow, random.pose(0), random.pose(0.5)};
  const Point away = random.direction();
  const double sum = reach(a, pair.a, -1.0 * away) + reach(b, pair.b, away);
  pair.a.position = pair.b.position + random.uniform(0.7, 1.05) * sum * away;
  return pair;
}

PosedPair deep_pair(const TestMesh&, const TestMesh& b, Random& random) {
  PosedPair pair{Approach::kDeep, random.pose(0), random.pose(0.5)};
  Point low = b.vertex(0), high = low;
  for (std::size_t i = 0; i < b.vertices.size(); ++i) {
    low[i % 3] = std::min<double>(low[i % 3], b.vertices[i]);
    high[i % 3] = std::max<double>(high[i % 3], b.vertices[i]);
  }
  pair.a.position = to_world(pair.b, in_box(low, high, random));
  return pair;
}

std::optional<Hollow> Hollow::find(const oracle::Mesh& outer, Random& random) {
  if (!outer.closed()) return std::nullopt;
  const double r = outer.radius();
  std::vector<std::pair<double, Point>> found;  // depth, place
  for (int tries = 0; tries < 100000 && found.size() < 300; ++tries) {
    const Point p = in_box({-r, -r, -r}, {r, r, r}, random);
    const double depth = outer.depth({p[0], p[1], p[2]}, 0);
    if (depth > 0) found.emplace_back(depth, p);
  }
  if (found.empty()) return std::nullopt;
  Hollow hollow;
  for (const auto& [depth, p] : found) hollow.room_ = std::max(hollow.room_, 0.5 * depth);
  for (const auto& [depth, p] : found) {
    if (depth >= hollow.room_) hollow.middles_.push_back(p);
  }
  return hollow;
}

// 0.9: clear of the surface, so that rounding to float decides nothing.
double Hollow::scale_for(const TestMesh& mesh) const {
  double radius = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(mesh.vertex_count()); ++i) {
    radius = std::max(radius, length(mesh.vertex(i)));
  }
  return 0.9 * room_ / radius;
}

TestPose Hollow::pose(Random& random) const {
  TestPose pose = random.pose(0);
  pose.position =
      middles_[static_cast<std::size_t>(random.below(static_cast<int>(middles_.size())))];
  return pose;
}

}  // namespace ode_ext::audit
