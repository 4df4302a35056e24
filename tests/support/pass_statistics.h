// SPDX-License-Identifier: BSD-3-Clause
// All that a collider says of its last pass, read through the public API.
#pragma once

#include <ode_ext/ode_ext.h>

#include <map>
#include <string>
#include <vector>

namespace ode_ext::test {

inline std::vector<int> stages() {
  std::vector<int> all;
  for (int s = dBatchStageNext(-1); s >= 0; s = dBatchStageNext(s)) all.push_back(s);
  return all;
}

// dBatchBuffer... of all append buffers.
inline std::vector<int> buffers() {
  std::vector<int> all;
  for (int c = dBatchBufferChunksSmall; c >= 0; c = dBatchCounterNext(c)) {
    if (std::string(dBatchCounterName(c)).starts_with("actual_")) all.push_back(c);
  }
  return all;
}

template <class Value>
struct ByKey : std::map<int, Value> {
  const Value& operator[](int key) const { return this->at(key); }
};

struct PassStatistics {
  unsigned status = 0;
  std::string device;  // empty: no such collider
  long long pairs, pairs_computed, pairs_colliding, pairs_bounded, redone, synchronizations, missed,
      iterative_unproven, dropped, temporal_pairs, deformed, passes, pairs_alone, pairs_stock,
      meshes;
  ByKey<long long> predicted, actual, capacity;  // by dBatchBuffer...
  ByKey<double> ms;                              // by dBatchStage...
};

// Zeroes where there is no such collider.
inline PassStatistics pass_statistics(dBatchColliderID collider) {
  PassStatistics s{};
  const char* device = dBatchColliderGetDeviceName(collider);
  if (device != nullptr) s.device = device;
  const int status = dBatchColliderGetStatus(collider);
  if (status < 0) return s;
  s.status = static_cast<unsigned>(status);
  const auto count = [&](int counter) { return dBatchColliderGetCount(collider, counter); };
  s.pairs = count(dBatchCounterPairs);
  s.pairs_computed = count(dBatchCounterPairsComputed);
  s.pairs_colliding = count(dBatchCounterPairsColliding);
  s.pairs_bounded = count(dBatchCounterPairsBounded);
  s.redone = count(dBatchCounterRedone);
  s.synchronizations = count(dBatchCounterSynchronizations);
  s.missed = count(dBatchCounterMissed);
  s.iterative_unproven = count(dBatchCounterIterativeUnproven);
  s.dropped = count(dBatchCounterDropped);
  s.temporal_pairs = count(dBatchCounterTemporalPairs);
  s.deformed = count(dBatchCounterDeformed);
  s.passes = count(dBatchCounterPasses);
  s.pairs_alone = count(dBatchCounterPairsAlone);
  s.pairs_stock = count(dBatchCounterPairsStock);
  s.meshes = count(dBatchCounterMeshes);
  for (const int buffer : buffers()) {
    s.predicted.emplace(buffer, count(buffer + dBatchPredicted));
    s.actual.emplace(buffer, count(buffer + dBatchActual));
    s.capacity.emplace(buffer, count(buffer + dBatchCapacity));
  }
  for (const int stage : stages()) s.ms.emplace(stage, dBatchColliderGetTime(collider, stage));
  return s;
}

}  // namespace ode_ext::test
