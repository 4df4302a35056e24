// SPDX-License-Identifier: BSD-3-Clause
// A collider for tests, made and destroyed through the public API. Without a device it throws,
// which fails the test: no device is a failure, never a skip.
#pragma once

#include <gtest/gtest.h>
#include <ode_ext/ode_ext.h>

#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

#include "support/environment.h"
#include "support/ode_world.h"
#include "support/pass_statistics.h"

namespace ode_ext::test {

class BatchCollider {
 public:
  using Change = std::function<void(dBatchColliderParams&)>;

  explicit BatchCollider(const Change& change = {}) {
    dBatchColliderParams params;
    dBatchColliderParamsInit(&params);
    if (change) change(params);
    id_ = dBatchColliderCreate(&params);
    if (id_ == nullptr) throw std::runtime_error(dBatchColliderGetLastErrorMessage());
  }
  ~BatchCollider() { destroy(); }
  BatchCollider(const BatchCollider&) = delete;
  BatchCollider& operator=(const BatchCollider&) = delete;

  operator dBatchColliderID() const { return id_; }
  void destroy() { dBatchColliderDestroy(std::exchange(id_, nullptr)); }

  PassStatistics stats() const { return pass_statistics(id_); }
  // One pass with a callback that asks for every pair; its result.
  Collected pass(dSpaceID space) const {
    Collected collected;
    EXPECT_EQ(dBatchColliderSpaceCollide(id_, space, &collected, &collect), 1)
        << dBatchColliderGetLastErrorMessage();
    return collected;
  }

 private:
  dBatchColliderID id_ = nullptr;
};

// A collider with these settings.
inline BatchCollider::Change with(std::string config) {
  return [config = std::move(config)](dBatchColliderParams& params) {
    params.config = config.c_str();
  };
}

inline std::string last_error() { return dBatchColliderGetLastErrorMessage(); }

// What a collider answers for a pair alone.
inline Contacts answer_of(const BatchCollider& collider, dGeomID o1, dGeomID o2, int limit = 64) {
  Contacts contacts(static_cast<std::size_t>(limit));
  const dGeomID pair[] = {o1, o2};
  int count = 0;
  EXPECT_GE(dBatchColliderCollidePairs(collider, pair, 1, limit, contacts.data(),
                                       sizeof(dContactGeom), &count),
            0)
      << last_error();
  contacts.resize(static_cast<std::size_t>(count));
  return contacts;
}

// The answer of a collider that knows nothing but this pair.
inline Contacts fresh_answer(dGeomID o1, dGeomID o2, int limit = 64,
                             const BatchCollider::Change& change = {}) {
  return answer_of(BatchCollider(change), o1, o2, limit);
}

}  // namespace ode_ext::test
