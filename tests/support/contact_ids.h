// SPDX-License-Identifier: BSD-3-Clause
// The ids of contacts, and comparing them.
#pragma once

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "support/batch_collider.h"

namespace ode_ext::test {

using Ids = std::vector<dBatchContactId>;
using IdSet = std::set<std::pair<unsigned, unsigned>>;

inline std::pair<unsigned, unsigned> key(dBatchContactId id) { return {id.feature1, id.feature2}; }
inline bool is_none(dBatchContactId id) { return id.feature1 == 0 && id.feature2 == 0; }
inline dBatchContactId exchanged(dBatchContactId id) { return {id.feature2, id.feature1}; }

inline IdSet set_of(const Ids& ids) {
  IdSet set;
  for (const dBatchContactId id : ids) set.insert(key(id));
  return set;
}

inline std::vector<std::pair<unsigned, unsigned>> keys(const Ids& ids) {
  std::vector<std::pair<unsigned, unsigned>> result;
  for (const dBatchContactId id : ids) result.push_back(key(id));
  return result;
}

// Whatever they are, known or not; the number known is what the function returns.
inline Ids ids_as_found(dBatchColliderID collider, const Contacts& contacts) {
  Ids ids(contacts.size(), {7, 7});
  const int found =
      dBatchColliderGetContactIds(collider, contacts.data(), static_cast<int>(contacts.size()),
                                  sizeof(dContactGeom), ids.data());
  EXPECT_EQ(found, std::count_if(ids.begin(), ids.end(), [](auto id) { return !is_none(id); }));
  return ids;
}

// Of contacts of one pair which the collider knows.
inline Ids ids_of(dBatchColliderID collider, const Contacts& contacts) {
  const Ids ids = ids_as_found(collider, contacts);
  for (const dBatchContactId id : ids)
    EXPECT_TRUE(id.feature1 != dBatchFeatureNone && id.feature2 != dBatchFeatureNone);
  EXPECT_EQ(set_of(ids).size(), ids.size()) << "two contacts of a pair have one id";
  return ids;
}

}  // namespace ode_ext::test
