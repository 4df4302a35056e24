// SPDX-License-Identifier: BSD-3-Clause
#include "ode/known_pairs.h"

#include <array>
#include <functional>
#include <memory>

#include "ode/pose_of.h"
#include "ode/stopwatch.h"
#include "opencl/error.h"

namespace ode_ext {

KnownPairs::KnownPairs(const ColliderOptions& options, float open_thickness, bool trust_meshes,
                       PassStats& stats)
    : stats_(stats),
      collider_(make_collider(options)),
      meshes_({.open_thickness = open_thickness}, trust_meshes) {}

bool KnownPairs::holds(Answer& answer, dGeomID g1, dGeomID g2, bool reads) {
  const PairMember* a = current_member(answer, g1, g2, reads);
  const PairMember* b = a != nullptr ? current_member(answer, g2, g1, reads) : nullptr;
  return b != nullptr && answer.holds(*a, *b);
}

Members::Seen& KnownPairs::seen(Answer& answer, dGeomID geom, dGeomID other) {
  if (answer.generation != members_.generation()) {
    answer.seen = {};
    answer.generation = members_.generation();
  }
  Members::Seen*& seen = answer.seen[std::less<>()(geom, other) ? 0 : 1];
  if (seen == nullptr) seen = &members_.seen(geom);
  return *seen;
}

const PairMember* KnownPairs::current_member(Answer& answer, dGeomID geom, dGeomID other,
                                             bool reads) {
  const dTriMeshDataID data = dGeomTriMeshGetData(geom);
  const std::shared_ptr<const Mesh> mesh =
      reads ? meshes_.refresh(data, dGeomTriMeshGetTriangleCount(geom), look_, round())
            : meshes_.known(data, dGeomTriMeshGetTriangleCount(geom));
  if (mesh == nullptr) return nullptr;
  return Members::find_same(seen(answer, geom, other), data, mesh.get(), pose_of(geom), round());
}

AnswerCopy KnownPairs::copy_of(const Answer& answer) const {
  return {{members_.at(answer.geoms[0], answer.stamps[0]),
           members_.at(answer.geoms[1], answer.stamps[1])},
          answer.contacts};
}

void KnownPairs::add(Answer& answer, const GatheredPair& pair) {
  const dGeomID a = pair.first.geom, b = pair.second.geom;
  add(answer, member_of(seen(answer, a, b), pair.first),
      member_of(seen(answer, b, a), pair.second));
}

void KnownPairs::add(Answer& answer, PairMember& a, PairMember& b) {
  const auto are = [&](const PairMember& first, const PairMember& second) {
    return answer.given_up_meshes ==
           std::array{first.mesh->topology.get(), second.mesh->topology.get()};
  };
  if (skips_given_up_ && is_given_up(answer) && (are(a, b) || are(b, a))) {
    answer.valid = false;
    why_given_up_ = "The device had no room for a pair of meshes of late.";
    return;
  }
  scene_.add(
      answer, a, b,
      a.is_placed && b.is_placed && !meshes_.is_refused(a.data) && !meshes_.is_refused(b.data));
}

PairMember& KnownPairs::member_of(Members::Seen& seen, const PlacedGeom& placed) {
  seen.now.last_round = round();
  if (seen.now.stamp != 0 && seen.now.scene == scene_.number()) return seen.now;
  const dTriMeshDataID data = dGeomTriMeshGetData(placed.geom);
  const auto& mesh =
      meshes_.refresh(data, dGeomTriMeshGetTriangleCount(placed.geom), look_, round());
  PairMember& member = members_.note(seen, placed.geom, data, mesh, pose_of(placed), round());
  member.scene = scene_.number();
  note_status(data, member.is_placed);
  return member;
}

void KnownPairs::note_status(dTriMeshDataID data, bool is_placed) {
  if (meshes_.is_refused(data)) stats_.status |= dBatchStatusMeshRefused;
  if (!is_placed) stats_.status |= dBatchStatusPoseRefused;
  if (meshes_.has_left_box(data)) stats_.status |= dBatchStatusMeshLeftBox;
}

void KnownPairs::make_collider_anew() { collider_ = make_collider(collider_->options_here()); }

void KnownPairs::give_up(std::size_t pair, const std::string& why) {
  scene_.give_up(pair, pass_);
  why_given_up_ = why;
  ++given_up_;
}

// What is given up is known, whatever becomes of the rest.
void KnownPairs::compute(PassMemory* memory) {
  const auto give_up_those_reported = [&] {
    for (const std::size_t pair : collider_->report().given_up)
      give_up(pair, collider_->report().why_given_up);
  };
  const PairContacts* collided = nullptr;
  try {
    collided = &scene_.collide(this, *collider_, meshes_, round(), memory);
  } catch (const DeviceError& error) {
    give_up_those_reported();
    if (!is_no_room(error.code()) || scene_.size() != 1) throw;
    give_up(0, error.what());
    scene_.drop();
    return;
  }
  give_up_those_reported();
  if (collider_->report().backtracked) {  // nothing to keep
    scene_.drop();
    return;
  }
  const Stopwatch storing;
  scene_.store(*collided);
  if (memory != nullptr) stats_.ms_export = storing.milliseconds();
}

void KnownPairs::prune() {
  answers_.prune(round());
  members_.prune(round());
  meshes_.prune(round());
}

void KnownPairs::age() {
  answers_.clear();
  members_.clear();
  meshes_.forget_before(round());
  rounds_.end();
}

}  // namespace ode_ext
