// SPDX-License-Identifier: BSD-3-Clause
// Records that the device keeps field by field (kernels/abi/contacts.h), one by one.
#pragma once

#include <bit>
#include <cstddef>
#include <vector>

#include "abi/contacts.h"

namespace ode_ext::test {

// What may become a contact.
struct Candidate {
  ox_f32 position[3];
  ox_f32 normal[3];
  ox_f32 depth;
  ox_f32 distance2;
  ox_u32 side_kind, vertex, triangle, manifold, region, taken;  // region: OX_REGION_KEY
  ox_u32 feature[2];
};

// A list with room for so many records: field f begins f times `room` words behind the first.
struct Fields {
  const ox_u32* words;
  std::size_t room;

  ox_u32 word(ox_u32 field, std::size_t i) const { return words[field * room + i]; }
  ox_f32 number(ox_u32 field, std::size_t i) const { return std::bit_cast<ox_f32>(word(field, i)); }
};

inline Candidate candidate_at(const Fields& list, std::size_t i) {
  Candidate c{};
  for (ox_u32 k = 0; k < 3; ++k) {
    c.position[k] = list.number(OX_CANDIDATE_POSITION + k, i);
    c.normal[k] = list.number(OX_CANDIDATE_NORMAL + k, i);
  }
  c.depth = list.number(OX_CANDIDATE_DEPTH, i);
  c.distance2 = list.number(OX_CANDIDATE_DISTANCE2, i);
  c.side_kind = list.word(OX_CANDIDATE_SIDE_KIND, i);
  c.vertex = list.word(OX_CANDIDATE_VERTEX, i);
  c.triangle = list.word(OX_CANDIDATE_TRIANGLE, i);
  c.manifold = list.word(OX_CANDIDATE_MANIFOLD, i);
  c.region = list.word(OX_CANDIDATE_REGION, i);
  c.taken = list.word(OX_CANDIDATE_TAKEN, i);
  for (ox_u32 k = 0; k < 2; ++k) c.feature[k] = list.word(OX_CANDIDATE_FEATURE + k, i);
  return c;
}

// As the device keeps them: of a pair with as many features.
inline std::vector<ox_u32> words_of(const std::vector<Candidate>& candidates) {
  const std::size_t room = OX_CANDIDATES_PER_FEATURE * candidates.size();
  std::vector<ox_u32> words(OX_CANDIDATE_WORDS * room);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& c = candidates[i];
    const auto set = [&](ox_u32 field, auto value) {
      words[field * room + i] = std::bit_cast<ox_u32>(value);
    };
    for (ox_u32 k = 0; k < 3; ++k) {
      set(OX_CANDIDATE_POSITION + k, c.position[k]);
      set(OX_CANDIDATE_NORMAL + k, c.normal[k]);
    }
    set(OX_CANDIDATE_DEPTH, c.depth);
    set(OX_CANDIDATE_DISTANCE2, c.distance2);
    set(OX_CANDIDATE_SIDE_KIND, c.side_kind);
    set(OX_CANDIDATE_VERTEX, c.vertex);
    set(OX_CANDIDATE_TRIANGLE, c.triangle);
    set(OX_CANDIDATE_MANIFOLD, c.manifold);
    set(OX_CANDIDATE_REGION, c.region);
    set(OX_CANDIDATE_TAKEN, c.taken);
    for (ox_u32 k = 0; k < 2; ++k) set(OX_CANDIDATE_FEATURE + k, c.feature[k]);
  }
  return words;
}

}  // namespace ode_ext::test
