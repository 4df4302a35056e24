// SPDX-License-Identifier: BSD-3-Clause
// Mesh geoms as they were last seen: all that contacts of theirs depend on. A geom of which any of
// that changed gets another stamp, so that an answer names what it is of by two numbers.
#pragma once

#include <ode/ode.h>

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <unordered_set>

#include "search/scene.h"

namespace ode_ext {

// One geom of a pair.
struct PairMember {
  dGeomID geom = nullptr;
  dTriMeshDataID data = nullptr;
  std::shared_ptr<const Mesh> mesh;
  Pose pose;              // with the rotation that is meant (ode/rotation.h)
  Pose given;             // as ODE has it
  bool is_placed = true;  // a pose that contacts can be computed of
  std::uint64_t stamp = 0;
  std::uint64_t last_round = 0;  // that it was seen in
  std::uint64_t scene = 0;       // the last one that it was seen for,
  std::uint64_t object_of = 0;   // the last one that it is an object of,
  std::uint32_t object = 0;      // and which
};

class Members {
 public:
  // A geom as it was last noted, and as the time before; stamp 0: never. Stays where it is as long
  // as generation() is the same.
  struct Seen {
    PairMember now, before;
  };

  Seen& seen(dGeomID geom) { return map_[geom]; }
  std::uint64_t generation() const { return generation_; }
  // The geom as it is now.
  PairMember& note(Seen& seen, dGeomID geom, dTriMeshDataID data,
                   const std::shared_ptr<const Mesh>& mesh, const Pose& given, std::uint64_t round);
  // The geom, if it is now as it was when last noted, or as the time before: a program may move a
  // geom, collide it, and move it back. Null: it is not.
  static const PairMember* find_same(Seen& seen, dTriMeshDataID data, const Mesh* mesh,
                                     const Pose& given, std::uint64_t round);
  // Whether contacts can be computed of a geom at a pose that may be the one it was noted at.
  static bool is_placed(const PairMember& noted, const Pose& given);
  // As it was with this stamp, one of the last two.
  const PairMember& at(dGeomID geom, std::uint64_t stamp) const;
  // Forgets those that nobody asked for of late. Looks every so many rounds.
  void prune(std::uint64_t round);
  // A mesh that is destroyed: geoms that had it let go of it, a few meshes later or when let_go is
  // called, since that takes a look at all geoms.
  void forget(dTriMeshDataID data);
  void let_go();
  void clear() {
    map_.clear();
    ++generation_;
  }

 private:
  std::unordered_map<dGeomID, Seen> map_;
  std::unordered_set<dTriMeshDataID> destroyed_;  // that geoms may still have
  std::uint64_t generation_ = 1;
  std::uint64_t pruned_round_ = 0;
  std::uint64_t stamps_ = 0;  // given so far
};

// The order in which a pair is computed. It depends on the meshes and the poses alone, so that a
// pair gives the same bytes whichever way round, whenever and in whatever company it is asked for;
// only copies at one pose are told apart by their handles. Copies go by where they are, along a
// direction that is askew: that is the same wherever the scene is, and mostly in the next pass.
bool in_canonical_order(const PairMember& a, const PairMember& b);

}  // namespace ode_ext
