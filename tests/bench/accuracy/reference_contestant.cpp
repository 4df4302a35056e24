// SPDX-License-Identifier: BSD-3-Clause
#include "bench/accuracy/reference_contestant.h"

#include "reference/reference_collider.h"

namespace ode_ext::accuracy {

ReferenceContestant::~ReferenceContestant() { test::ReferenceCollider::forget(); }

std::vector<test::Contacts> ReferenceContestant::collide(std::span<const test::GeomPair> pairs) {
  std::vector<test::Contacts> answers;
  for (const auto& [g1, g2] : pairs)
    answers.push_back(test::ReferenceCollider::collide(g1, g2, options_));
  return answers;
}

}  // namespace ode_ext::accuracy
