// SPDX-License-Identifier: BSD-3-Clause
// What the last pass did, by the table of ode/pass_stats.h.
#include <algorithm>

#include "api/guarded.h"
#include "ode/pass_stats.h"

using namespace ode_ext::api;

namespace {

// In a forked child the device counts as failed; nothing else is known there.
ode_ext::PassStats stats_of(dBatchColliderID handle) {
  if (!ode_ext::is_lost_by_fork()) return live(handle)->stats();
  ode_ext::PassStats lost;
  lost.status = dBatchStatusDeviceFailed;
  return lost;
}

// The entry with this value in a table that ascends by value, or null.
template <class Table>
auto find(const Table& table, int value) -> decltype(&*table.begin()) {
  const auto at = std::find_if(table.begin(), table.end(),
                               [&](const auto& entry) { return entry.value == value; });
  return at == table.end() ? nullptr : &*at;
}

template <class Table>
int next(const Table& table, int value) {
  const auto at = std::find_if(table.begin(), table.end(),
                               [&](const auto& entry) { return entry.value > value; });
  return at == table.end() ? -1 : at->value;
}

}  // namespace

extern "C" {

int dBatchColliderGetStatus(dBatchColliderID collider) {
  return guarded("dBatchColliderGetStatus", -1,
                 [&] { return static_cast<int>(stats_of(collider).status); });
}

const char* dBatchColliderGetDeviceName(dBatchColliderID collider) {
  return guarded("dBatchColliderGetDeviceName", static_cast<const char*>(nullptr), [&] {
    if (ode_ext::is_lost_by_fork()) refuse("a fork lost the device");
    return live(collider)->device_name().c_str();
  });
}

double dBatchColliderGetTime(dBatchColliderID collider, int stage) {
  return guarded("dBatchColliderGetTime", -1.0, [&] {
    const auto* found = find(ode_ext::timed_stages(), stage);
    if (found == nullptr) refuse("there is no stage " + std::to_string(stage));
    return found->milliseconds(stats_of(collider));
  });
}

long long dBatchColliderGetCount(dBatchColliderID collider, int counter) {
  return guarded("dBatchColliderGetCount", -1LL, [&] {
    const auto* found = find(ode_ext::counters(), counter);
    if (found == nullptr) refuse("there is no counter " + std::to_string(counter));
    return static_cast<long long>(found->read(stats_of(collider), found->index));
  });
}

long long dBatchColliderGetWork(dBatchColliderID collider, int stage, int quantity) {
  return guarded("dBatchColliderGetWork", -1LL, [&] {
    const ode_ext::PassStats stats = stats_of(collider);
    const ode_ext::WorkCount* work = ode_ext::work_of(stats, stage);
    if (work == nullptr) refuse("work is not counted of stage " + std::to_string(stage));
    switch (quantity) {
      case dBatchWorkItems:
        return static_cast<long long>(work->items);
      case dBatchWorkUnits:
        return static_cast<long long>(work->units);
      case dBatchWorkLockstep32:
        return static_cast<long long>(work->lockstep32);
      case dBatchWorkLockstep64:
        return static_cast<long long>(work->lockstep64);
      default:
        refuse("quantity is " + std::to_string(quantity) + ", expected a dBatchWork constant");
    }
  });
}

const char* dBatchStageName(int stage) {
  const auto* found = find(ode_ext::timed_stages(), stage);
  return found == nullptr ? nullptr : found->name;
}

int dBatchStageNext(int stage) { return next(ode_ext::timed_stages(), stage); }

const char* dBatchCounterName(int counter) {
  return guarded("dBatchCounterName", static_cast<const char*>(nullptr), [&] {
    const auto* found = find(ode_ext::counters(), counter);
    return found == nullptr ? nullptr : found->name.c_str();
  });
}

int dBatchCounterNext(int counter) {
  return guarded("dBatchCounterNext", -1, [&] { return next(ode_ext::counters(), counter); });
}

}  // extern "C"
