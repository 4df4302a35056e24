// SPDX-License-Identifier: BSD-3-Clause
#include "preload/core.h"

#include <cstdio>

#include "ode/mesh_arrays.h"
#include "ode/override.h"
#include "ode/pair_gather.h"
#include "ode/registry.h"
#include "opencl/fork_guard.h"
#include "preload/colliders.h"
#include "preload/find_ode_functions.h"

namespace {

using namespace ode_ext;

int collide(dGeomID first, dGeomID second, void* data, dNearCallback* callback) {
  // In a forked child ODE's own collider answers (ode/override.h); there is nothing to compute.
  if (is_lost_by_fork() || !may_hold_mesh_pair({first, second})) return 0;
  return collide_by_a_free_collider({first, second}, data, callback) ? 1 : 0;
}

void meet() {
  if (!is_lost_by_fork()) have_a_collider();
}

void initialized() {
  if (!is_lost_by_fork() && !live_colliders().empty()) install_override();
}

// Not through the C API, which wants ODE to be initialized.
void mesh_changed(dTriMeshDataID data) {
  if (is_lost_by_fork()) return;
  for_each_collider([&](BatchCollider& collider) { collider.announce_change(data); });
}

void mesh_destroyed(dTriMeshDataID data) {
  if (is_lost_by_fork()) return;
  for_each_collider([&](BatchCollider& collider) { collider.forget(data); });
}

void print_statistics() {
  if (is_lost_by_fork()) return;
  for_each_collider([](BatchCollider& collider) {
    const PassStats stats = collider.stats();
    const Totals& totals = stats.totals;
    std::fprintf(stderr,
                 "ode_ext: %s: %lld passes with meshes, %lld mesh pairs collided in %.3f s, %lld "
                 "alone; dCollide of two meshes %lld times, %lld colliding, %lld contacts; %lld "
                 "pairs answered by ODE's own collider\n",
                 collider.device_name().c_str(), static_cast<long long>(stats.passes),
                 static_cast<long long>(totals.pairs_batched), totals.ms_passes / 1e3,
                 static_cast<long long>(stats.pairs_alone), static_cast<long long>(totals.asked),
                 static_cast<long long>(totals.asked_colliding),
                 static_cast<long long>(totals.contacts_given),
                 static_cast<long long>(stats.pairs_stock));
  });
  std::fprintf(stderr, "ode_ext: starting took %.3f s\n", seconds_of_starting());
}

// Where ODE keeps the arrays of a mesh is found out once, by building some. ODE builds them by
// functions that the preload sees, and tells the colliders of: not while one is locked.
void find_mesh_layout() {
  const dTriMeshDataID data = dGeomTriMeshDataCreate();
  arrays_of(data);
  dGeomTriMeshDataDestroy(data);
}

const dxPreloadCore kCore = {&collide,      &meet,           &initialized,
                             &mesh_changed, &mesh_destroyed, &print_statistics};

}  // namespace

extern "C" __attribute__((visibility("default"))) const char* ode_ext_preload_config_fault(
    const char* config) {
  return dBatchConfigCheck(config) == 0 ? nullptr : dBatchColliderGetLastErrorMessage();
}

extern "C" __attribute__((visibility("default"))) const dxPreloadCore* ode_ext_preload_core(
    void* (*find)(const char*), const char** missing) {
  *missing = find_ode_functions(find);
  if (*missing != nullptr) return nullptr;
  find_mesh_layout();
  return &kCore;
}
