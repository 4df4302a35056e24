// SPDX-License-Identifier: BSD-3-Clause
#include "ode/unasked_pairs.h"

#include <algorithm>

#include "ode/pose_of.h"

namespace ode_ext {

void UnaskedPairs::clear() {
  questions_ = 0;
  pairs_.clear();
  members_.clear();
}

// Geoms and meshes may be gone when the program asks, so all that is needed is kept, the mesh as it
// was last read: where it has changed since, the answer will not hold.
void UnaskedPairs::note(Answer& answer, const GatheredPair& pair, KnownPairs& known) {
  if (answer.noted_pass == known.pass()) return;  // in a pass around this one
  answer.noted_pass = known.pass();
  for (const PlacedGeom& placed : {pair.first, pair.second}) {
    const auto [place, is_new] = members_.try_emplace(placed.geom);
    if (!is_new) continue;
    PairMember& now = known.members().seen(placed.geom).now;
    now.last_round = known.round();  // it may be asked for again
    const dTriMeshDataID data = dGeomTriMeshGetData(placed.geom);
    place->second.data = data;
    place->second.mesh = known.meshes().keep(data, known.round());
    place->second.given = pose_of(placed);
    if (place->second.mesh != nullptr)
      known.note_status(data, Members::is_placed(now, place->second.given));
  }
  pairs_.push_back({pair.first.geom, pair.second.geom});
}

// A few of very many are what a program picks that filters its pairs.
bool UnaskedPairs::wakes_by_question() {
  return ++questions_ >= std::max<std::uint64_t>(4, pairs_.size() / 256) && !pairs_.empty();
}

void UnaskedPairs::compute(KnownPairs& known) {
  known.begin_batch(true);
  const auto note = [&](dGeomID geom, const PairMember& as) -> PairMember& {
    PairMember& member = known.members().note(known.members().seen(geom), geom, as.data, as.mesh,
                                              as.given, known.round());
    known.note_status(as.data, member.is_placed);
    return member;
  };
  for (const auto& [first, second] : pairs_) {
    const PairMember &a = members_.at(first), &b = members_.at(second);
    if (known.meshes().is_as_known(a.data, a.mesh) && known.meshes().is_as_known(b.data, b.mesh))
      known.add(known.entry(first, second), note(first, a), note(second, b));
  }
  pairs_.clear();
  members_.clear();
  known.compute(nullptr);
}

}  // namespace ode_ext
