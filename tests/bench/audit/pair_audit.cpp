// SPDX-License-Identifier: BSD-3-Clause
#include "bench/audit/pair_audit.h"

#include <algorithm>
#include <stdexcept>

#include "support/region_contacts.h"

namespace ode_ext::audit {
namespace {

using namespace test;

// Enough where the surfaces do not meet: these meshes are in one piece.
bool first_vertex_inside(const Shape& inner, const TestPose& pi, const Shape& outer,
                         const TestPose& po) {
  if (!outer.solid.closed()) return false;
  const oracle::Vector p = oracle_pose(pi).to_world(inner.solid.vertices().front());
  return outer.solid.signed_distance(oracle_pose(po).to_local(p)) < 0;
}

}  // namespace

Shape::Shape(const TestMesh& mesh)
    : surface(mesh), graph(mesh), solid(mesh.vertices, mesh.indices) {
  if (graph.closed() != solid.closed()) throw std::invalid_argument("vertices are not shared");
}

Answers& Answers::operator+=(const Answers& other) {
  found += other.found;
  missed += other.missed;
  missed_contained += other.missed_contained;
  false_contacts += other.false_contacts;
  on_edge += other.on_edge;
  bare += other.bare;
  bare_full += other.bare_full;
  bare_slight += other.bare_slight;
  bare_beyond += other.bare_beyond;
  return *this;
}

Tally& Tally::operator+=(const Tally& other) {
  pairs += other.pairs;
  intersecting += other.intersecting;
  contained += other.contained;
  regions += other.regions;
  batch += other.batch;
  stock += other.stock;
  return *this;
}

PairTruth::PairTruth(const Shape& a, const Shape& b, const PosedPair& poses)
    : a_(a),
      b_(b),
      poses_(poses),
      smaller_(std::min(a.surface.size(), b.surface.size())),
      triangles_(intersecting_triangles(a.surface, poses.a, b.surface, poses.b)),
      contained_(triangles_.empty() && (first_vertex_inside(a, poses.a, b, poses.b) ||
                                        first_vertex_inside(b, poses.b, a, poses.a))) {
  if (intersecting()) regions_ = find_regions(a.graph, poses.a, b.graph, poses.b, triangles_);
}

std::vector<Region> PairTruth::regions_at(const TestPose& pose_a) const {
  return find_regions(a_.graph, pose_a, b_.graph, poses_.b,
                      intersecting_triangles(a_.surface, pose_a, b_.surface, poses_.b));
}

bool PairTruth::on_edge() const {
  const auto poses = nudged(poses_.a, kNudge * smaller_);
  return std::any_of(poses.begin(), poses.end(), [&](const TestPose& pose) {
    return surfaces_intersect(a_.surface, pose, b_.surface, poses_.b) != intersecting();
  });
}

// A region that stays still overlaps its old self, but for the nudge.
bool PairTruth::survives_nudges(const Region& region) const {
  const double nudge = kNudge * smaller_;
  const auto poses = nudged(poses_.a, nudge);
  return std::all_of(poses.begin(), poses.end(), [&](const TestPose& pose) {
    const auto regions = regions_at(pose);
    return std::any_of(regions.begin(), regions.end(), [&](const Region& other) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (other.low[k] > region.high[k] + nudge || other.high[k] < region.low[k] - nudge) {
          return false;
        }
      }
      return true;
    });
  });
}

Answers PairTruth::judge(std::span<const dContactGeom> contacts, int max_contacts) const {
  Answers answers;
  if (contacts.empty() == colliding()) {
    if (on_edge()) {
      answers.on_edge = 1;
    } else if (contacts.empty()) {
      answers.missed = 1;
      answers.missed_contained = contained_;
    } else {
      answers.false_contacts = 1;
    }
    return answers;
  }
  answers.found = colliding();
  if (!intersecting()) return answers;
  for (const Region& region : without_contact(regions_, contacts, poses_.b, smaller_)) {
    if (region.size() < kTiny * smaller_ || !survives_nudges(region)) {
      ++answers.bare_slight;
    } else {
      ++answers.bare;
    }
  }
  const auto most = static_cast<std::size_t>(max_contacts);
  const auto beyond = static_cast<long long>(regions() - std::min(most, regions()));
  answers.bare_beyond = std::min(answers.bare, beyond);
  answers.bare -= answers.bare_beyond;
  if (contacts.size() == most) answers.bare_full = answers.bare;
  return answers;
}

}  // namespace ode_ext::audit
