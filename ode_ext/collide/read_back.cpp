// SPDX-License-Identifier: BSD-3-Clause
#include "collide/read_back.h"

#include <algorithm>

namespace ode_ext {

void ReadBack::reserve(const BatchData& data) {
  ranges_.reserve(data.pairs.ranges, data.pairs.count * sizeof(ox_range));
  contacts_.reserve(data.lists.contacts(),
                    data.lists.capacity(List::kContacts) * sizeof(ox_contact));
}

void ReadBack::read(BatchData& data, std::uint64_t expected) {
  ranges_.read(data.pairs.ranges, data.pairs.count * sizeof(ox_range));
  read_contacts(data, expected);
  data.lists.count();
}

void ReadBack::read_rest(const BatchData& data) {
  const std::uint64_t count = data.lists.length(List::kContacts);
  if (count <= read_) return;
  read_contacts(data, count);
  if (!device_.is_idle()) device_.finish();
}

// At most as many as there is room for.
void ReadBack::read_contacts(const BatchData& data, std::uint64_t count) {
  read_ = std::min(count, data.lists.capacity(List::kContacts));
  contacts_.read(data.lists.contacts(), read_ * sizeof(ox_contact));
}

}  // namespace ode_ext
