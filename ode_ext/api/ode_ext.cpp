// SPDX-License-Identifier: BSD-3-Clause
// The C boundary of colliding: checks arguments, catches everything, translates. No algorithms.
#include "ode_ext/ode_ext.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "api/guarded.h"
#include "api/params.h"
#include "ode/batch_collider.h"
#include "ode/capture.h"
#include "ode/contact_export.h"
#include "ode/known_contacts.h"
#include "ode/messages.h"
#include "ode/override.h"
#include "ode/pass.h"
#include "ode/trace.h"
#include "opencl/choice.h"
#include "opencl/error.h"
#include "opencl/fork_guard.h"

using namespace ode_ext::api;

namespace {

using ode_ext::BatchCollider;
using ode_ext::CallMark;
using ode_ext::Pass;
using ode_ext::PassRoot;

// What dCheckConfiguration calls the precision that this was compiled for.
#ifdef dSINGLE
constexpr const char* kPrecision = "ODE_single_precision";
#else
constexpr const char* kPrecision = "ODE_double_precision";
#endif

// In a forked child nothing of the parent's may be touched, not even a lock: ODE's own collider
// answers there, and the handles are dead.
bool is_dead(dBatchColliderID handle) {
  if (handle == nullptr || !ode_ext::is_lost_by_fork()) return false;
  ode_ext::say_that_a_fork_lost_the_device();
  return true;
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
  const std::string fault = ode_ext::fault_of_stride(skip);
  if (!fault.empty()) refuse(fault);
}

// Null: one that knows nothing.
std::shared_ptr<BatchCollider> asked_of(dBatchColliderID handle) {
  return handle == nullptr || is_dead(handle) ? nullptr : live(handle);
}

// Of functions that write something of each contact; `no_room` says what of that is NULL.
void check_contacts(const dContactGeom* contacts, int count, int skip, const char* no_room) {
  if (count < 0) refuse("count is " + std::to_string(count));
  if (count > 0 && contacts == nullptr) refuse("contacts is NULL");
  if (count > 0 && no_room != nullptr) refuse(no_room);
  check_skip(skip);
}

// CollidePairs without a collider: what dCollide gives for each pair.
int collide_one_by_one(const dGeomID* pairs, int pair_count, int flags, dContactGeom* contacts,
                       int skip, int* counts) {
  int total = 0;
  auto* bytes = reinterpret_cast<unsigned char*>(contacts);
  for (int i = 0; i < pair_count; ++i) {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(i) * (flags & 0xffff) * skip;
    const dGeomID* pair = pairs + 2 * static_cast<std::ptrdiff_t>(i);
    const int count =
        dCollide(pair[0], pair[1], flags, reinterpret_cast<dContactGeom*>(bytes + first), skip);
    if (counts != nullptr) counts[i] = count;
    total += count;
  }
  return total;
}

std::shared_ptr<BatchCollider> created(const dBatchColliderParams& params,
                                       const ode_ext::ColliderOptions& options) {
  return std::make_shared<BatchCollider>(options, static_cast<float>(params.open_thickness),
                                         params.trust_meshes != 0, params.triangle_callbacks != 0);
}

// Where no device is selected, on the first that works: a driver may be there and not build the
// kernels. Throws what the last says if none does.
std::shared_ptr<BatchCollider> created_on_a_device(const dBatchColliderParams& params) {
  ode_ext::ColliderOptions options = to_options(params);
  std::vector<ode_ext::DeviceInfo> devices;
  if (options.device.find_first_not_of(' ') == std::string::npos)
    devices = in_default_order(ode_ext::list_devices());
  for (std::size_t i = 0; i + 1 < devices.size(); ++i) {
    try {
      return created(params, options);
    } catch (const ode_ext::DeviceError& error) {
      ode_ext::log(ode_ext::LogLevel::kWarning,
                   std::string(error.what()) + " The next device is tried.");
      options.device = std::to_string(devices[i + 1].index);
    }
  }
  return created(params, options);
}

// Who is told of a mesh: the collider of a handle, all where it is 0; or all, whichever it is, of
// what is true whoever is asked.
enum class Told : bool { kOne, kAll };

template <class Visit>
void visit_colliders(const char* call, dBatchColliderID handle, dTriMeshDataID data, Told told,
                     Visit visit) {
  guarded(call, 0, [&] {
    if (data == nullptr) refuse("the mesh is NULL");
    if (ode_ext::is_lost_by_fork()) return 0;
    const auto one = handle != nullptr ? live(handle) : nullptr;
    if (one != nullptr && told == Told::kOne)
      visit(*one);
    else
      ode_ext::for_each_collider(visit);
    return 0;
  });
}

}  // namespace

extern "C" {

dBatchColliderID dBatchColliderCreate(const dBatchColliderParams* params) {
  return guarded("dBatchColliderCreate", dBatchColliderID{}, [&] {
    const dBatchColliderParams complete_params = complete(params);
    if (dCheckConfiguration(kPrecision) == 0)
      refuse(std::string("this ODE was not built for ") + kPrecision + ", as ode_ext was");
    if (ode_ext::is_lost_by_fork())
      refuse(
          "this process was forked from one that had used OpenCL, and its driver does not work "
          "here; fork before the first call that looks at devices, or call exec in the child");
    ode_ext::set_log_level(ode_ext::log_level_of_environment());
    ode_ext::open_trace_of_environment();
    ode_ext::open_capture_of_environment();
    auto collider = created_on_a_device(complete_params);
    ode_ext::capture_collider(collider->identity(), complete_params, collider->device_name());
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
  const CallMark mark;
  return guarded("dBatchColliderCollidePairs", -1, [&] {
    const auto found = asked_of(collider);
    if (found != nullptr) Pass::end_those_left(mark);
    if (pair_count < 0) refuse("pair_count is " + std::to_string(pair_count));
    if (pair_count > 0 && (pairs == nullptr || contacts == nullptr))
      refuse(pairs == nullptr ? "pairs is NULL" : "contacts is NULL");
    if ((flags & 0xffff) == 0) refuse("the low 16 bits of flags, contacts per pair, are 0");
    check_skip(skip);
    for (std::size_t i = 0; i < 2 * static_cast<std::size_t>(pair_count); ++i) {
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
    const auto found = asked_of(collider);
    check_contacts(contacts, count, skip, ids == nullptr ? "ids is NULL" : nullptr);
    if (found != nullptr) return found->contact_ids(contacts, count, skip, ids);
    std::fill_n(ids, count, ode_ext::kNoContactId);
    return 0;
  });
}

int dBatchColliderGetContactRegions(dBatchColliderID collider, const dContactGeom* contacts,
                                    int count, int skip, dBatchContactRegion* regions) {
  return guarded("dBatchColliderGetContactRegions", -1, [&] {
    const auto found = asked_of(collider);
    check_contacts(contacts, count, skip, regions == nullptr ? "regions is NULL" : nullptr);
    if (found != nullptr) return found->contact_regions(contacts, count, skip, regions);
    std::fill_n(regions, count, ode_ext::kNoContactRegion);
    return 0;
  });
}

int dBatchColliderGetMeshlets(dBatchColliderID collider, dTriMeshDataID data, int triangle_count,
                              int* meshlets) {
  return guarded("dBatchColliderGetMeshlets", -1, [&] {
    const auto found = asked_of(collider);
    if (data == nullptr) refuse("the mesh is NULL");
    if (triangle_count < 0) refuse("triangle_count is " + std::to_string(triangle_count));
    if (triangle_count > 0 && meshlets == nullptr) refuse("meshlets is NULL");
    if (found != nullptr) return found->meshlets(data, triangle_count, meshlets);
    std::fill_n(meshlets, triangle_count, -1);
    return 0;
  });
}

void dBatchColliderTriMeshDataUpdate(dBatchColliderID collider, dTriMeshDataID data) {
  visit_colliders("dBatchColliderTriMeshDataUpdate", collider, data, Told::kAll,
                  [&](BatchCollider& c) {
                    ode_ext::install_override();
                    c.announce_change(data);
                  });
}

void dBatchColliderTriMeshDataSetDeformable(dBatchColliderID collider, dTriMeshDataID data,
                                            int deformable) {
  visit_colliders("dBatchColliderTriMeshDataSetDeformable", collider, data, Told::kOne,
                  [&](BatchCollider& c) { c.set_deformable(data, deformable != 0); });
}

void dBatchColliderTriMeshDataDestroyed(dBatchColliderID collider, dTriMeshDataID data) {
  visit_colliders("dBatchColliderTriMeshDataDestroyed", collider, data, Told::kAll,
                  [&](BatchCollider& c) { c.forget(data); });
}

}  // extern "C"
