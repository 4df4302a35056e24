// SPDX-License-Identifier: BSD-3-Clause
// The pairs that a pass met and did not compute ahead, since the program did not ask for them of
// late, a pile that rests, or never did, as far as there are many: what it keeps in one place and
// filters. It may ask after all.
#pragma once

#include <ode/ode.h>

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "ode/known_pairs.h"

namespace ode_ext {

class UnaskedPairs {
 public:
  // Of the outermost pass that begins.
  void clear();
  void note(Answer& answer, const GatheredPair& pair, KnownPairs& known);
  // One that was noted in this pass is asked for.
  void note_question() { ++questions_; }
  // Whether others are likely to be asked for as well. Then it is computed with those that were
  // noted after it, and the first again after the last, in one batch, twice as many as were asked
  // for: of a pile that wakes all are computed in a few batches, in whatever order they are asked
  // for, and a program that picks some pays for few that it does not want.
  bool expects_others() const { return questions_ > kQuestionsAlone && left_ != 0; }
  // Returns by how many more of them have contacts than had when they were noted.
  long long compute_from(const Answer& answer, KnownPairs& known);

 private:
  static constexpr std::uint64_t kQuestionsAlone = 3;

  struct Noted {
    std::array<dGeomID, 2> geoms;
    std::size_t next;  // the pair itself, or once it was in a batch one after it
  };
  // The first from here on, and after the last from the first on, that has been in no batch.
  std::size_t first_left(std::size_t from);

  std::vector<Noted> pairs_;
  std::size_t left_ = 0;                             // that have been in no batch
  std::unordered_map<dGeomID, PairMember> members_;  // data, mesh and given pose
  std::uint64_t questions_ = 0;
};

}  // namespace ode_ext
