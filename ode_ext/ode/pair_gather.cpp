// SPDX-License-Identifier: BSD-3-Clause
#include "ode/pair_gather.h"

#include <algorithm>
#include <exception>
#include <unordered_set>

#include "ode/pose_of.h"

namespace ode_ext {
namespace {

// Deprecated in ODE, in use in programs.
dGeomID geom_inside(dGeomID transform) {
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
  return dGeomTransformGetGeom(transform);
#pragma GCC diagnostic pop
}

// Follows geom transforms down to the mesh they hold.
bool find_mesh(dGeomID holder, PlacedGeom& placed) {
  dGeomID geom = holder;
  while (geom != nullptr && dGeomGetClass(geom) == dGeomTransformClass) geom = geom_inside(geom);
  placed = {geom, holder};
  return geom != nullptr && dGeomGetClass(geom) == dTriMeshClass;
}

// Members of a space, or none if it cannot be listed: dSpaceGetGeom aborts for a quadtree.
template <class Visit>
void for_each_member(dGeomID space, Visit visit) {
  if (dGeomGetClass(space) == dQuadTreeSpaceClass) return;
  const auto id = reinterpret_cast<dSpaceID>(space);
  const int count = dSpaceGetNumGeoms(id);
  for (int i = 0; i < count; ++i) visit(dSpaceGetGeom(id, i));
}

// Counts meshes up to 2; what may be or hold any number counts as 2.
int count_meshes(dGeomID geom) {
  if (geom == nullptr) return 0;
  if (!dGeomIsSpace(geom)) {
    const int geom_class = dGeomGetClass(geom);
    return geom_class == dTriMeshClass || geom_class == dGeomTransformClass ? 1 : 0;
  }
  if (dGeomGetClass(geom) == dQuadTreeSpaceClass) return 2;
  int meshes = 0;
  for_each_member(geom, [&](dGeomID member) {
    if (meshes < 2) meshes += count_meshes(member);
  });
  return meshes;
}

// Passes still to run, one at a time: nothing is entered while something else is traversed.
class Gatherer {
 public:
  Gatherer(std::span<const PassRoot> traversed, std::size_t expected) : traversed_(traversed) {
    pairs_.reserve(expected);
  }

  std::vector<GatheredPair> run(const PassRoot& root) {
    pending_.push_back(root);
    enter_members(root.first);
    enter_members(root.second);
    while (!pending_.empty()) {
      const PassRoot next = pending_.back();
      pending_.pop_back();
      if (is_forbidden(next.first) || is_forbidden(next.second)) continue;
      if (next.second == nullptr)
        dSpaceCollide(reinterpret_cast<dSpaceID>(next.first), this, &near);
      else
        dSpaceCollide2(next.first, next.second, this, &near);
      if (failure_) std::rethrow_exception(failure_);
    }
    return std::move(pairs_);
  }

 private:
  static void near(void* self, dGeomID g1, dGeomID g2) {
    auto& gatherer = *static_cast<Gatherer*>(self);
    if (gatherer.failure_) return;
    try {
      gatherer.meet(g1, g2);
    } catch (...) {  // ODE would be left with a locked space
      gatherer.failure_ = std::current_exception();
    }
  }

  void meet(dGeomID g1, dGeomID g2) {
    if (dGeomIsSpace(g1) || dGeomIsSpace(g2)) {
      pending_.push_back({g1, g2});
      enter(g1);
      enter(g2);
      return;
    }
    GatheredPair pair;
    if (find_mesh(g1, pair.first) && find_mesh(g2, pair.second)) pairs_.push_back(pair);
  }

  void enter(dGeomID geom) {
    if (!dGeomIsSpace(geom) || !entered_.insert(geom).second) return;
    pending_.push_back({geom, nullptr});
    enter_members(geom);
  }

  void enter_members(dGeomID geom) {
    if (geom != nullptr && dGeomIsSpace(geom))
      for_each_member(geom, [&](dGeomID member) { enter(member); });
  }

  bool is_forbidden(dGeomID geom) const {
    return geom != nullptr && dGeomGetClass(geom) == dSweepAndPruneSpaceClass &&
           std::any_of(traversed_.begin(), traversed_.end(), [&](const PassRoot& root) {
             return root.first == geom || root.second == geom;
           });
  }

  std::span<const PassRoot> traversed_;
  std::vector<PassRoot> pending_;
  std::unordered_set<dGeomID> entered_;
  std::vector<GatheredPair> pairs_;
  std::exception_ptr failure_;
};

}  // namespace

Pose pose_of(const PlacedGeom& placed) {
  dGeomID geom = placed.holder;
  dVector3 position;
  dMatrix3 rotation;
  std::copy_n(dGeomGetPosition(geom), 4, position);
  std::copy_n(dGeomGetRotation(geom), 12, rotation);
  while (geom != placed.geom) {
    geom = geom_inside(geom);
    dVector3 composed;
    dMultiply0_331(composed, rotation, dGeomGetPosition(geom));
    for (int k = 0; k < 3; ++k) composed[k] += position[k];
    dMatrix3 turned;
    dMultiply0_333(turned, rotation, dGeomGetRotation(geom));
    std::copy_n(composed, 3, position);
    std::copy_n(turned, 12, rotation);
  }
  return to_pose(position, rotation);
}

bool may_hold_mesh_pair(const PassRoot& root) {
  return count_meshes(root.first) + count_meshes(root.second) >= 2;
}

std::vector<GatheredPair> gather_pairs(const PassRoot& root, std::span<const PassRoot> traversed,
                                       std::size_t expected) {
  return Gatherer(traversed, expected).run(root);
}

}  // namespace ode_ext
