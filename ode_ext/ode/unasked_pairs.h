// SPDX-License-Identifier: BSD-3-Clause
// The pairs that a pass met and did not compute ahead, since the program did not ask for them of
// late: a pile that rests. It may wake.
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
  // One that was noted in this pass is asked for after all. Whether the rest of them is to be
  // computed too, in one batch.
  bool wakes_by_question();
  void compute(KnownPairs& known);

 private:
  std::vector<std::array<dGeomID, 2>> pairs_;
  std::unordered_map<dGeomID, PairMember> members_;  // data, mesh and given pose
  std::uint64_t questions_ = 0;
};

}  // namespace ode_ext
