// SPDX-License-Identifier: BSD-3-Clause
// What is known of each pair of geoms: its contacts, what they were computed from, and whether the
// program cares. Handles are keys here; nothing is dereferenced.
#pragma once

#include <ode/ode.h>

#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "pipeline/scene.h"

namespace ode_ext {

// Passes after which an answer nobody gathered or asked for is forgotten, and after which a pair
// nobody asks for is no longer computed ahead.
inline constexpr std::uint64_t kPassesRemembered = 8;

// One geom of a pair: all that its contacts depend on.
struct PairMember {
  dGeomID geom = nullptr;
  dTriMeshDataID data = nullptr;
  std::shared_ptr<const Mesh> mesh;
  Pose pose;
};

struct Answer {
  std::array<PairMember, 2> members;  // contacts are those of dCollide(members[0], members[1])
  std::vector<Contact> contacts;
  bool valid = false;
  std::uint64_t gathering = 0;       // the last gathering that met it; nested passes count
  std::uint64_t gathered_pass = 0;   // the last outermost pass that gathered it
  std::uint64_t last_pass = 0;       // the last one that gathered it or in which it was asked for
  std::uint64_t passes_unasked = 0;  // that gathered it since the program last asked
  std::uint64_t noted_pass = 0;      // the last one that met it and did not compute it ahead

  // Whether this is the answer for these two, in either order.
  bool holds(const PairMember& a, const PairMember& b) const;
};

class Answers {
 public:
  // The entry of the unordered pair; created empty.
  Answer& entry(dGeomID a, dGeomID b) { return map_[key(a, b)]; }
  Answer* find(dGeomID a, dGeomID b);
  void prune(std::uint64_t pass);
  void clear() { map_.clear(); }
  std::size_t size() const { return map_.size(); }

 private:
  using Key = std::array<dGeomID, 2>;
  struct Hash {
    std::size_t operator()(const Key& key) const;
  };
  static Key key(dGeomID a, dGeomID b);

  std::unordered_map<Key, Answer, Hash> map_;
};

// The order in which a pair is computed. It depends on the meshes and the poses alone, so that a
// pair gives the same bytes whichever way round, whenever and in whatever company it is asked for;
// only copies at one pose are told apart by their handles.
bool in_canonical_order(const PairMember& a, const PairMember& b);

}  // namespace ode_ext
