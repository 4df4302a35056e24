// SPDX-License-Identifier: BSD-3-Clause
#include "ode/stock_collider.h"

#include <atomic>
#include <mutex>

#include "ode/messages.h"

// ODE registers this function for trimesh-trimesh and exports it under its C++ name; there is no
// public name for it. Weak: an ODE built without it leaves a null pointer here.
extern "C" int ode_ext_stock_trimesh_trimesh(
    dGeomID g1, dGeomID g2, int flags, dContactGeom* contacts,
    int skip) __asm__("_Z11dCollideTTLP6dxGeomS0_iP12dContactGeomi") __attribute__((weak));

namespace ode_ext {
namespace {

std::mutex in_stock_collider;

}  // namespace

int stock_collide(dGeomID g1, dGeomID g2, int flags, dContactGeom* contacts, int skip) {
  if (dGeomTriMeshGetTriangleCount(g1) == 1 && dGeomTriMeshGetTriangleCount(g2) == 1) return 0;
  if (&ode_ext_stock_trimesh_trimesh == nullptr) {
    static std::atomic<bool> said{false};
    if (!said.exchange(true))
      log(LogLevel::kError,
          "this ODE does not export its own trimesh-trimesh collider; without a working device "
          "mesh pairs get no contacts");
    return 0;
  }
  // ODE's mesh colliders share a cache between all threads. A merge callback is code of the
  // program's, which may come back here or wait for who does: geoms with one are let in unlocked.
  std::unique_lock lock(in_stock_collider, std::defer_lock);
  if (dGeomTriMeshGetTriMergeCallback(g1) == nullptr &&
      dGeomTriMeshGetTriMergeCallback(g2) == nullptr)
    lock.lock();
  return ode_ext_stock_trimesh_trimesh(g1, g2, flags, contacts, skip);
}

}  // namespace ode_ext
