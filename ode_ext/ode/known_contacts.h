// SPDX-License-Identifier: BSD-3-Clause
// What is known of contacts that a program holds: they are looked for among those of the answer.
#pragma once

#include <ode/ode.h>

#include <cstddef>
#include <span>
#include <vector>

#include "contacts/contact.h"
#include "ode_ext/ode_ext.h"

namespace ode_ext {

inline constexpr dBatchContactId kNoContactId{dBatchFeatureNone, dBatchFeatureNone};
inline constexpr dBatchContactRegion kNoContactRegion{-1, dBatchOverlapNone};

// Looks for contacts of one pair. Programs mostly keep the order of the answer, so each is looked
// for from behind the last one on, round about.
class KnownContacts {
 public:
  // `known` are the contacts between `first` and another geom.
  KnownContacts(std::span<const Contact> known, dGeomID first) : known_(known), first_(first) {}
  // kNoContactId: it is none of these.
  dBatchContactId id_of(const dContactGeom& contact);
  // kNoContactRegion: it is none of these.
  dBatchContactRegion region_of(const dContactGeom& contact);

 private:
  // Past the last: it is none of these.
  std::size_t find(const dContactGeom& contact);

  std::span<const Contact> known_;
  dGeomID first_;
  std::size_t next_ = 0;
  std::vector<int> regions_;  // of each of these, once asked for
};

}  // namespace ode_ext
