// SPDX-License-Identifier: BSD-3-Clause
#include "ode/members.h"

#include <cmath>
#include <cstring>
#include <functional>
#include <tuple>
#include <utility>

#include "ode/answers.h"
#include "ode/rotation.h"

namespace ode_ext {
namespace {

static_assert(sizeof(Pose) == 12 * sizeof(double), "poses are compared by their bytes");

bool same(const Pose& a, const Pose& b) { return std::memcmp(&a, &b, sizeof(Pose)) == 0; }

// Rotations, and positions a float can hold with room for what is summed of them: differences,
// turned, over three axes, 36 times as much. Beyond, and for NaN, there is nothing to compute.
bool is_usable(const Pose& pose) {
  if (!(off_rotation(pose.rotation) <= kMostOff)) return false;
  for (std::size_t k = 0; k < 3; ++k)
    if (!(std::fabs(pose.position[k]) < 1e36)) return false;
  return true;
}

// Askew to all that things are lined up along: which of two copies in a stack or in a row comes
// first does not depend on what one is off to the side by rounding.
constexpr Vec3d kOrderAlong{577, 769, 1283};

bool is_as(const PairMember& member, dTriMeshDataID data, const Mesh* mesh, const Pose& given) {
  return member.stamp != 0 && member.data == data && member.mesh.get() == mesh &&
         same(member.given, given);
}

}  // namespace

PairMember& Members::note(Seen& seen, dGeomID geom, dTriMeshDataID data,
                          const std::shared_ptr<const Mesh>& mesh, const Pose& given,
                          std::uint64_t round) {
  auto& [now, before] = seen;
  if (!is_as(now, data, mesh.get(), given)) {
    const bool is_back = is_as(before, data, mesh.get(), given);
    std::swap(now, before);
    if (!is_back) {
      now = {};
      now.geom = geom;
      now.data = data;
      now.mesh = mesh;
      now.given = now.pose = given;
      now.pose.rotation = nearest_rotation(given.rotation);
      now.is_placed = is_usable(now.pose);
      now.stamp = ++stamps_;
    }
    now.scene = before.scene;
    now.object_of = before.object_of;
    now.object = before.object;
    // What was edited does not come back, and need not be kept alive.
    if (before.data == now.data && before.mesh != now.mesh) before = {};
  }
  now.last_round = round;
  return now;
}

const PairMember* Members::find_same(Seen& seen, dTriMeshDataID data, const Mesh* mesh,
                                     const Pose& given, std::uint64_t round) {
  auto& [now, before] = seen;
  now.last_round = round;
  if (is_as(now, data, mesh, given)) return &now;
  return is_as(before, data, mesh, given) ? &before : nullptr;
}

bool Members::is_placed(const PairMember& noted, const Pose& given) {
  if (noted.stamp != 0 && same(noted.given, given)) return noted.is_placed;
  Pose meant = given;
  meant.rotation = nearest_rotation(given.rotation);
  return is_usable(meant);
}

const PairMember& Members::at(dGeomID geom, std::uint64_t stamp) const {
  const auto& [now, before] = map_.at(geom);
  return now.stamp == stamp ? now : before;
}

void Members::forget(dTriMeshDataID data) {
  destroyed_.insert(data);
  if (16 * destroyed_.size() > map_.size()) let_go();
}

void Members::let_go() {
  if (destroyed_.empty()) return;
  for (auto& [geom, seen] : map_)
    for (PairMember* member : {&seen.now, &seen.before})
      if (destroyed_.contains(member->data)) {
        member->data = nullptr;
        member->mesh = nullptr;
        member->stamp = 0;
      }
  destroyed_.clear();
}

void Members::prune(std::uint64_t round) {
  if (round < pruned_round_ + kRoundsRemembered) return;
  pruned_round_ = round;
  const auto is_old = [&](const auto& item) {
    return item.second.now.last_round + kRoundsRemembered < round;
  };
  if (std::erase_if(map_, is_old) != 0) ++generation_;
}

bool in_canonical_order(const PairMember& a, const PairMember& b) {
  if (a.mesh->shape_hash != b.mesh->shape_hash) return a.mesh->shape_hash < b.mesh->shape_hash;
  const Vec3d apart = frame_pose(a.pose, *a.mesh).position - frame_pose(b.pose, *b.mesh).position;
  const double along = dot(kOrderAlong, apart);
  if (along != 0) return along < 0;
  const std::tuple by_axes(apart.x, apart.y, apart.z), none(0.0, 0.0, 0.0);
  if (by_axes != none) return by_axes < none;
  const int poses = std::memcmp(&a.pose, &b.pose, sizeof(Pose));
  if (poses != 0) return poses < 0;
  const std::vector<Triangle>& triangles = a.mesh->topology->triangles;
  const std::vector<Triangle>& others = b.mesh->topology->triangles;
  if (triangles != others) return triangles < others;
  if (a.mesh->content_hash != b.mesh->content_hash)
    return a.mesh->content_hash < b.mesh->content_hash;
  const int soups = compare_soups(a.mesh->source, b.mesh->source);  // hashes can be forged
  if (soups != 0) return soups < 0;
  // Copies at one pose: nothing of theirs tells them apart, so their handles have to.
  return std::less<>()(a.geom, b.geom);
}

}  // namespace ode_ext
