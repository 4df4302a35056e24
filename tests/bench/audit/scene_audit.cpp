// SPDX-License-Identifier: BSD-3-Clause
#include "bench/audit/scene_audit.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/audit/broad_phase.h"
#include "bench/audit/pair_audit.h"
#include "bench/audit/rounding.h"
#include "support/ode_world.h"

namespace ode_ext::audit {
namespace {

std::unique_ptr<Shape> shape_of(const falling_objects::TriangleMesh& mesh) {
  return std::make_unique<Shape>(test::TestMesh{mesh.vertices, mesh.indices});
}

}  // namespace

Findings& Findings::operator+=(const Findings& other) {
  pairs += other.pairs;
  intersecting += other.intersecting;
  contained += other.contained;
  in_contact += other.in_contact;
  found += other.found;
  overlooked += other.overlooked;
  false_contacts += other.false_contacts;
  fragile += other.fragile;
  edges_only += other.edges_only;
  regions += other.regions;
  bare += other.bare;
  bare_full += other.bare_full;
  bare_slight += other.bare_slight;
  bare_beyond += other.bare_beyond;
  return *this;
}

struct SceneAudit::Placed {
  const Shape& shape;
  test::TestPose pose;
};

SceneAudit::SceneAudit(const falling_objects::Scene& scene, int max_contacts)
    : scene_(scene), max_contacts_(max_contacts) {
  for (const falling_objects::Shape& shape : scene.shapes())
    shapes_.push_back(shape_of(shape.mesh));
  shapes_.push_back(shape_of(scene.ground().mesh()));
}

SceneAudit::~SceneAudit() = default;

SceneAudit::Placed SceneAudit::place(dGeomID geom) const {
  const std::size_t index = falling_objects::index_of(geom);
  const bool is_ground = index == scene_.objects().size();
  return {*shapes_[is_ground ? scene_.shapes().size() : scene_.objects()[index].shape],
          test::pose_of(geom)};
}

Findings SceneAudit::look(std::span<const dContactGeom> contacts) const {
  std::map<Pair, test::Contacts> of_pair;
  for (const dContactGeom& contact : contacts)
    of_pair[in_order(contact.g1, contact.g2)].push_back(contact);
  Pairs pairs = broad_phase(scene_.space());
  for (const auto& [pair, found] : of_pair) pairs.insert(pair);  // none that it did not see
  Findings findings;
  for (const auto& [a, b] : pairs) look_at_pair(place(a), place(b), of_pair[{a, b}], findings);
  return findings;
}

void SceneAudit::look_at_pair(const Placed& a, const Placed& b,
                              std::span<const dContactGeom> contacts, Findings& findings) const {
  const PairTruth truth(a.shape, b.shape, {Approach::kDeep, a.pose, b.pose});
  ++findings.pairs;
  findings.intersecting += truth.intersecting();
  findings.contained += truth.contained();
  findings.in_contact += !contacts.empty();
  findings.regions += static_cast<long long>(truth.regions());
  if (contacts.empty() != truth.colliding()) {
    const Answers answers = truth.judge(contacts, max_contacts_);
    findings.found += answers.found;
    findings.bare += answers.bare;
    findings.bare_full += answers.bare_full;
    findings.bare_slight += answers.bare_slight;
    findings.bare_beyond += answers.bare_beyond;
    return;
  }

  const oracle::Mesh &solid_a = a.shape.solid, &solid_b = b.shape.solid;
  const double slack = rounding(solid_a, a.pose, solid_b, b.pose);
  // One mesh is taken larger by twice the rounding (docs/contacts.md, "General position"): what is
  // less than that and the rounding apart may have a contact.
  const double apart = contacts.empty() ? slack : 3 * slack;
  const double nudge = std::max(kNudge * std::min(solid_a.radius(), solid_b.radius()), apart);
  for (const test::TestPose& pose : test::nudged(a.pose, nudge)) {
    if (surfaces_intersect(a.shape.surface, pose, b.shape.surface, b.pose) ==
        truth.intersecting()) {
      continue;
    }
    ++findings.fragile;
    return;
  }
  if (!contacts.empty()) {
    ++findings.false_contacts;
  } else if (oracle::penetration(solid_a, oracle_pose(a.pose), solid_b, oracle_pose(b.pose),
                                 slack) > slack) {
    ++findings.overlooked;
  } else {
    ++findings.edges_only;
  }
}

}  // namespace ode_ext::audit
