// SPDX-License-Identifier: BSD-3-Clause
// The C boundary: checks arguments, catches everything, translates. No algorithms.
#include "ode_ext/ode_ext.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>

#include "device/device.h"
#include "device/fork_guard.h"
#include "ode/batch_collider.h"
#include "ode/config.h"
#include "ode/contact_ids.h"
#include "ode/messages.h"
#include "ode/override.h"
#include "ode/pass.h"
#include "ode/registry.h"
#include "ode/trace.h"

namespace {

using ode_ext::BatchCollider;
using ode_ext::CallMark;
using ode_ext::Pass;
using ode_ext::PassRoot;

// Runs `body`; an exception becomes the last error, prefixed with the call, and `failure`.
template <class Result, class Body>
Result guarded(const char* call, Result failure, Body body) noexcept {
  try {
    try {
      return body();
    } catch (const std::bad_alloc&) {
      ode_ext::set_last_error(std::string(call) + ": out of memory");
    } catch (const std::exception& error) {
      ode_ext::set_last_error(std::string(call) + ": " + error.what());
    } catch (...) {
      ode_ext::set_last_error(std::string(call) + ": unknown exception");
    }
  } catch (...) {  // no memory for the message either
  }
  return failure;
}

[[noreturn]] void refuse(const std::string& why) { throw std::invalid_argument(why); }

// In a forked child nothing of the parent's may be touched, not even a lock: ODE's own collider
// answers there, and the handles are dead.
bool is_dead(dBatchColliderID handle) {
  if (handle == nullptr || !ode_ext::is_lost_by_fork()) return false;
  ode_ext::say_that_a_fork_lost_the_device();
  return true;
}

std::shared_ptr<BatchCollider> live(dBatchColliderID handle) {
  auto collider = ode_ext::find_collider(handle);
  if (collider == nullptr) refuse("this is not the handle of a live collider");
  return collider;
}

// Where dBatchColliderParams ended in each version of it, this one's last: fields are added at the
// end alone.
constexpr std::size_t kParamsSizes[] = {sizeof(dBatchColliderParams)};

// Parameters of a caller that may have been compiled with an older, shorter struct: its part over
// the defaults.
dBatchColliderParams complete(const dBatchColliderParams* given) {
  dBatchColliderParams params;
  dBatchColliderParamsInit(&params);
  if (given == nullptr) return params;
  if (std::ranges::find(kParamsSizes, given->struct_size) == std::end(kParamsSizes))
    refuse("params->struct_size is " + std::to_string(given->struct_size) + ", expected " +
           std::to_string(sizeof(params)) + "; fill params with dBatchColliderParamsInit first");
  std::memcpy(&params, given, given->struct_size);
  params.struct_size = sizeof(params);
  return params;
}

void check(const dBatchColliderParams& p) {
  if (p.max_contacts < 1 || p.max_contacts > static_cast<int>(ode_ext::kMaxContacts))
    refuse("max_contacts is " + std::to_string(p.max_contacts) + ", expected 1 to " +
           std::to_string(ode_ext::kMaxContacts));
  if (p.max_contacts_deformable < 0 ||
      p.max_contacts_deformable > static_cast<int>(ode_ext::kMaxContacts))
    refuse("max_contacts_deformable is " + std::to_string(p.max_contacts_deformable) +
           ", expected 0 (all) to " + std::to_string(ode_ext::kMaxContacts));
  if (!(p.open_thickness >= 0) || !std::isfinite(p.open_thickness))
    refuse("open_thickness is " + std::to_string(p.open_thickness) + " m, expected 0 or more");
}

std::string selection_or_environment(const char* selection) {
  if (selection != nullptr) return selection;
  const char* environment = std::getenv("ODE_EXT_DEVICE");
  return environment == nullptr ? "" : environment;
}

ode_ext::ColliderOptions to_options(const dBatchColliderParams& p) {
  ode_ext::ColliderOptions options;
  options.device = selection_or_environment(p.device);
  options.max_contacts = static_cast<std::uint32_t>(p.max_contacts);
  options.max_contacts_deformable = static_cast<std::uint32_t>(p.max_contacts_deformable);
  if (p.config != nullptr) ode_ext::apply_config(p.config, options);
  return options;
}

// Field `text` of a setting, or null past the last.
const char* setting_text(int index, const char* ode_ext::Setting::*text) {
  const auto settings = ode_ext::settings();
  if (index < 0 || static_cast<std::size_t>(index) >= settings.size()) return nullptr;
  return settings[static_cast<std::size_t>(index)].*text;
}

int collide(const char* call, dBatchColliderID handle, const PassRoot& root, void* data,
            dNearCallback* callback) {
  if (handle == nullptr || is_dead(handle)) {
    if (root.second == nullptr)
      dSpaceCollide(reinterpret_cast<dSpaceID>(root.first), data, callback);
    else
      dSpaceCollide2(root.first, root.second, data, callback);
    return 1;
  }
  // A callback of the program may throw; that is between it and its caller, so only what this
  // library does itself is guarded.
  const CallMark mark;
  std::optional<Pass> pass;
  const bool begun = guarded(call, false, [&] {
    Pass::end_those_left(mark);
    const auto collider = live(handle);
    ode_ext::install_override();
    pass.emplace(collider, root, mark);
    return true;
  });
  if (!begun) return -1;
  return pass->deliver(data, callback) ? 1 : 0;
}

void check_skip(int skip) {
  if (skip < static_cast<int>(sizeof(dContactGeom)))
    refuse("skip is " + std::to_string(skip) +
           ", less than sizeof(dContactGeom) = " + std::to_string(sizeof(dContactGeom)));
}

// CollidePairs without a collider: what dCollide gives for each pair.
int collide_one_by_one(const dGeomID* pairs, int pair_count, int flags, dContactGeom* contacts,
                       int skip, int* counts) {
  int total = 0;
  auto* bytes = reinterpret_cast<unsigned char*>(contacts);
  for (int i = 0; i < pair_count; ++i) {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(i) * (flags & 0xffff) * skip;
    const int count = dCollide(pairs[2 * i], pairs[2 * i + 1], flags,
                               reinterpret_cast<dContactGeom*>(bytes + first), skip);
    if (counts != nullptr) counts[i] = count;
    total += count;
  }
  return total;
}

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

// Applies to one collider, or to all where the handle is 0.
template <class Visit>
void visit_colliders(const char* call, dBatchColliderID handle, dTriMeshDataID data, Visit visit) {
  guarded(call, 0, [&] {
    if (data == nullptr) refuse("the mesh is NULL");
    if (ode_ext::is_lost_by_fork()) return 0;
    if (handle != nullptr)
      visit(*live(handle));
    else
      ode_ext::for_each_collider(visit);
    return 0;
  });
}

}  // namespace

extern "C" {

void dBatchColliderParamsInit(dBatchColliderParams* params) {
  if (params == nullptr) return;
  *params = {};
  params->struct_size = sizeof(*params);
  params->max_contacts = 16;
}

const char* dBatchConfigName(int index) { return setting_text(index, &ode_ext::Setting::name); }
const char* dBatchConfigValues(int index) { return setting_text(index, &ode_ext::Setting::values); }
const char* dBatchConfigDefault(int index) {
  return setting_text(index, &ode_ext::Setting::initial);
}
const char* dBatchConfigMeaning(int index) {
  return setting_text(index, &ode_ext::Setting::meaning);
}

int dBatchConfigCheck(const char* config) {
  return guarded("dBatchConfigCheck", -1, [&] {
    if (config == nullptr) refuse("the config is NULL");
    ode_ext::ColliderOptions options;
    ode_ext::apply_config(config, options);
    return 0;
  });
}

dBatchColliderID dBatchColliderCreate(const dBatchColliderParams* params) {
  return guarded("dBatchColliderCreate", dBatchColliderID{}, [&] {
    const dBatchColliderParams complete_params = complete(params);
    check(complete_params);
    if (dCheckConfiguration("ODE_double_precision") == 0)
      refuse("this ODE was built in single precision, ode_ext for double");
    if (ode_ext::is_lost_by_fork())
      refuse(
          "this process was forked from one that had used OpenCL, and its driver does not work "
          "here; fork before the first collider is created, or call exec in the child");
    ode_ext::set_log_level(ode_ext::log_level_of_environment());
    ode_ext::open_trace_of_environment();
    auto collider = std::make_shared<BatchCollider>(
        to_options(complete_params), static_cast<float>(complete_params.open_thickness),
        complete_params.trust_meshes != 0, complete_params.triangle_callbacks != 0);
    ode_ext::install_override();
    ode_ext::register_collider(collider);
    return reinterpret_cast<dBatchColliderID>(collider.get());
  });
}

void dBatchColliderDestroy(dBatchColliderID handle) {
  if (handle == nullptr || ode_ext::is_lost_by_fork()) return;
  const CallMark mark;
  guarded("dBatchColliderDestroy", 0, [&] {
    Pass::end_those_left(mark);
    if (!ode_ext::unregister_collider(live(handle))) refuse("a pass of this collider is running");
    return 0;
  });
}

const char* dBatchColliderGetLastErrorMessage(void) { return ode_ext::last_error(); }

int dBatchColliderSpaceCollide(dBatchColliderID collider, dSpaceID space, void* data,
                               dNearCallback* callback) {
  const char* call = "dBatchColliderSpaceCollide";
  const bool sound = guarded(call, false, [&] {
    if (space == nullptr) refuse("the space is NULL");
    if (callback == nullptr) refuse("the callback is NULL");
    return true;
  });
  if (!sound) return -1;
  return collide(call, collider, {reinterpret_cast<dGeomID>(space), nullptr}, data, callback);
}

int dBatchColliderSpaceCollide2(dBatchColliderID collider, dGeomID g1, dGeomID g2, void* data,
                                dNearCallback* callback) {
  const char* call = "dBatchColliderSpaceCollide2";
  const bool sound = guarded(call, false, [&] {
    if (g1 == nullptr || g2 == nullptr) refuse("a geom is NULL");
    if (callback == nullptr) refuse("the callback is NULL");
    return true;
  });
  if (!sound) return -1;
  return collide(call, collider, {g1, g2}, data, callback);
}

int dBatchColliderCollidePairs(dBatchColliderID collider, const dGeomID* pairs, int pair_count,
                               int flags, dContactGeom* contacts, int skip, int* contact_counts) {
  return guarded("dBatchColliderCollidePairs", -1, [&] {
    const auto found = collider == nullptr || is_dead(collider) ? nullptr : live(collider);
    if (pair_count < 0) refuse("pair_count is " + std::to_string(pair_count));
    if (pair_count > 0 && (pairs == nullptr || contacts == nullptr))
      refuse(pairs == nullptr ? "pairs is NULL" : "contacts is NULL");
    if ((flags & 0xffff) == 0) refuse("the low 16 bits of flags, contacts per pair, are 0");
    check_skip(skip);
    for (int i = 0; i < 2 * pair_count; ++i) {
      if (pairs[i] == nullptr) refuse("geom " + std::to_string(i) + " of pairs is NULL");
      if (dGeomGetClass(pairs[i]) != dTriMeshClass)
        refuse("geom " + std::to_string(i) + " of pairs is not a trimesh");
    }
    ode_ext::install_override();
    if (found == nullptr)
      return collide_one_by_one(pairs, pair_count, flags, contacts, skip, contact_counts);
    return found->collide_pairs({pairs, 2 * static_cast<std::size_t>(pair_count)}, flags, contacts,
                                skip, contact_counts);
  });
}

int dBatchColliderGetContactIds(dBatchColliderID collider, const dContactGeom* contacts, int count,
                                int skip, dBatchContactId* ids) {
  return guarded("dBatchColliderGetContactIds", -1, [&] {
    const auto found = collider == nullptr || is_dead(collider) ? nullptr : live(collider);
    if (count < 0) refuse("count is " + std::to_string(count));
    if (count > 0 && (contacts == nullptr || ids == nullptr))
      refuse(contacts == nullptr ? "contacts is NULL" : "ids is NULL");
    check_skip(skip);
    if (found != nullptr) return found->contact_ids(contacts, count, skip, ids);
    std::fill_n(ids, count, ode_ext::kNoContactId);
    return 0;
  });
}

void dBatchColliderTriMeshDataUpdate(dBatchColliderID collider, dTriMeshDataID data) {
  visit_colliders("dBatchColliderTriMeshDataUpdate", collider, data, [&](BatchCollider& c) {
    ode_ext::install_override();
    c.announce_change(data);
  });
}

void dBatchColliderTriMeshDataSetDeformable(dBatchColliderID collider, dTriMeshDataID data,
                                            int deformable) {
  visit_colliders("dBatchColliderTriMeshDataSetDeformable", collider, data,
                  [&](BatchCollider& c) { c.set_deformable(data, deformable != 0); });
}

void dBatchColliderTriMeshDataDestroyed(dBatchColliderID collider, dTriMeshDataID data) {
  visit_colliders("dBatchColliderTriMeshDataDestroyed", collider, data,
                  [&](BatchCollider& c) { c.forget(data); });
}

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

int dBatchColliderDescribeDevices(const char* selection, char* text, size_t size) {
  return guarded("dBatchColliderDescribeDevices", 0, [&] {
    if (ode_ext::is_lost_by_fork())
      refuse("this process was forked from one that had used OpenCL; call exec in the child");
    const std::string description = ode_ext::describe_devices(selection_or_environment(selection));
    if (text != nullptr && size > 0) {
      const std::size_t count = std::min(description.size(), size - 1);
      std::memcpy(text, description.data(), count);
      text[count] = '\0';
    }
    return static_cast<int>(description.size());
  });
}

}  // extern "C"
