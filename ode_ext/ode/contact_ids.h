// SPDX-License-Identifier: BSD-3-Clause
// The ids of contacts that a program holds: they are looked for among those of the answer.
#pragma once

#include <ode/ode.h>

#include <cstddef>
#include <span>

#include "contacts/contact.h"
#include "ode_ext/ode_ext.h"

namespace ode_ext {

inline constexpr dBatchContactId kNoContactId{dBatchFeatureNone, dBatchFeatureNone};

// Looks for contacts of one pair. Programs mostly keep the order of the answer, so each is looked
// for from behind the last one on, round about.
class ContactIds {
 public:
  // `known` are the contacts between `first` and another geom.
  ContactIds(std::span<const Contact> known, dGeomID first) : known_(known), first_(first) {}
  // kNoContactId: it is none of these.
  dBatchContactId id_of(const dContactGeom& contact);

 private:
  std::span<const Contact> known_;
  dGeomID first_;
  std::size_t next_ = 0;
};

}  // namespace ode_ext
