// SPDX-License-Identifier: BSD-3-Clause
// What a configuration that may miss something finds, against one that does not.
#pragma once

#include <ode/ode.h>

#include <span>

namespace paper {

struct Missed {
  long long pairs = 0;            // of `all`, colliding
  long long contacts = 0;         // of `all`
  long long missed_pairs = 0;     // without a contact in `found`
  long long missed_contacts = 0;  // by which a pair has fewer in `found`
  long long false_pairs = 0;      // with contacts in `found` only

  Missed& operator+=(const Missed& other);
};

Missed compare_contacts(std::span<const dContactGeom> all, std::span<const dContactGeom> found);

}  // namespace paper
