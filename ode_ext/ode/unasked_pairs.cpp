// SPDX-License-Identifier: BSD-3-Clause
#include "ode/unasked_pairs.h"

#include "ode/pose_of.h"

namespace ode_ext {

void UnaskedPairs::clear() {
  questions_ = 0;
  left_ = 0;
  pairs_.clear();
  members_.clear();
}

// Geoms and meshes may be gone when the program asks, so all that is needed is kept, the mesh as it
// was last read, if it ever was: where it has changed since, the answer will not hold.
void UnaskedPairs::note(Answer& answer, const GatheredPair& pair, KnownPairs& known) {
  if (answer.noted_pass == known.pass()) return;  // in a pass around this one
  answer.noted_pass = known.pass();
  answer.noted_as = pairs_.size();
  for (const PlacedGeom& placed : {pair.first, pair.second}) {
    const auto [place, is_new] = members_.try_emplace(placed.geom);
    if (!is_new) continue;
    PairMember& now = known.members().seen(placed.geom).now;
    now.last_round = known.round();  // it may be asked for again
    const dTriMeshDataID data = dGeomTriMeshGetData(placed.geom);
    place->second.data = data;
    place->second.mesh = known.meshes().keep(data, known.round());
    if (place->second.mesh == nullptr)
      place->second.mesh = known.meshes().refresh(data, dGeomTriMeshGetTriangleCount(placed.geom),
                                                  known.look(), known.round());
    place->second.given = pose_of(placed);
    if (place->second.mesh != nullptr)
      known.note_status(data, Members::is_placed(now, place->second.given));
  }
  pairs_.push_back({{pair.first.geom, pair.second.geom}, pairs_.size()});
  ++left_;
}

// On the way each is made to point farther (path halving), so that all questions of a pass together
// hardly look at a pair twice. There is one.
std::size_t UnaskedPairs::first_left(std::size_t from) {
  for (;;) {
    if (from >= pairs_.size()) from = 0;
    if (pairs_[from].next == from) return from;
    std::size_t& next = pairs_[from].next;
    if (next < pairs_.size()) next = pairs_[next].next;
    from = next;
  }
}

long long UnaskedPairs::compute_from(const Answer& answer, KnownPairs& known) {
  known.begin_batch(true);
  long long colliding_before = 0;
  const auto note = [&](dGeomID geom, const PairMember& as) -> PairMember& {
    PairMember& member = known.members().note(known.members().seen(geom), geom, as.data, as.mesh,
                                              as.given, known.round());
    known.note_status(as.data, member.is_placed);
    return member;
  };
  for (std::size_t from = answer.noted_as; left_ != 0 && known.changed() < 2 * questions_;) {
    const std::size_t i = first_left(from);
    pairs_[i].next = from = i + 1;
    --left_;
    const auto& [first, second] = pairs_[i].geoms;
    const PairMember &a = members_.at(first), &b = members_.at(second);
    if (!known.meshes().is_as_known(a.data, a.mesh) || !known.meshes().is_as_known(b.data, b.mesh))
      continue;
    Answer& entry = known.entry(first, second);
    colliding_before += entry.collides() ? 1 : 0;
    known.add(entry, note(first, a), note(second, b));
  }
  known.compute(nullptr);
  return known.colliding() - colliding_before;
}

}  // namespace ode_ext
