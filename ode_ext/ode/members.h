// SPDX-License-Identifier: BSD-3-Clause
// Mesh geoms as they were last seen: all that contacts of theirs depend on. A geom of which any of
// that changed gets another stamp, so that an answer names what it is of by two numbers.
#pragma once

#include <ode/ode.h>

#include <cstdint>
#include <memory>
#include <unordered_map>

#include "pipeline/scene.h"

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
  std::uint64_t last_pass = 0;  // that saw it
  std::uint64_t scene = 0;      // the last one that it was seen for,
  std::uint64_t object_of = 0;  // the last one that it is an object of,
  std::uint32_t object = 0;     // and which
};

class Members {
 public:
  // The geom as it is now. Stays where it is until pruned.
  PairMember& note(dGeomID geom, dTriMeshDataID data, const std::shared_ptr<const Mesh>& mesh,
                   const Pose& given, std::uint64_t pass);
  // Null: it was never seen.
  PairMember* find(dGeomID geom);
  // The geom, if it is now as it was last seen; null: it is not.
  const PairMember* find_same(dGeomID geom, dTriMeshDataID data, const Mesh* mesh,
                              const Pose& given);
  // Forgets those that no pass saw of late.
  void prune(std::uint64_t pass);
  void clear() { map_.clear(); }

 private:
  std::unordered_map<dGeomID, PairMember> map_;
  std::uint64_t stamps_ = 0;  // given so far
};

// The order in which a pair is computed. It depends on the meshes and the poses alone, so that a
// pair gives the same bytes whichever way round, whenever and in whatever company it is asked for;
// only copies at one pose are told apart by their handles.
bool in_canonical_order(const PairMember& a, const PairMember& b);

}  // namespace ode_ext
