// SPDX-License-Identifier: BSD-3-Clause
#include "ode/stock_collider.h"

#include <atomic>
#include <functional>
#include <mutex>
#include <optional>

#include "ode/messages.h"
#include "opencl/fork_guard.h"

// ODE registers this function for trimesh-trimesh and exports it under its C++ name; there is no
// public name for it. Weak: an ODE built without it leaves a null pointer here.
extern "C" int ode_ext_stock_trimesh_trimesh(
    dGeomID g1, dGeomID g2, int flags, dContactGeom* contacts,
    int skip) __asm__("_Z11dCollideTTLP6dxGeomS0_iP12dContactGeomi") __attribute__((weak));

namespace ode_ext {
namespace {

// ODE's mesh colliders share a cache between all threads: one at a time is let in. What they say
// goes to the program's message handler, which may come back here: its thread is let in again. A
// handler may also leave by longjmp, past any destructor: who holds the lock by a frame that is
// gone goes on with it. Stacks grow downwards.
class InStockCollider {
 public:
  explicit InStockCollider(const void* frame) : outer_(held_by_frame) {
    is_nested_ = outer_ != nullptr && std::less<>()(frame, outer_);
    if (is_nested_) return;
    if (outer_ == nullptr) one_at_a_time.lock();
    held_by_frame = frame;
  }
  ~InStockCollider() {
    if (is_nested_) return;
    held_by_frame = nullptr;
    one_at_a_time.unlock();
  }
  InStockCollider(const InStockCollider&) = delete;
  InStockCollider& operator=(const InStockCollider&) = delete;

 private:
  static std::mutex one_at_a_time;
  static thread_local const void* held_by_frame;
  const void* outer_;
  bool is_nested_;
};
std::mutex InStockCollider::one_at_a_time;
thread_local const void* InStockCollider::held_by_frame = nullptr;

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
  // A merge callback is code of the program's, which may wait for who comes here: geoms with one
  // are let in unlocked. So is a forked child, whose lock a thread may hold that it has not.
  std::optional<InStockCollider> alone;
  if (dGeomTriMeshGetTriMergeCallback(g1) == nullptr &&
      dGeomTriMeshGetTriMergeCallback(g2) == nullptr && !is_lost_by_fork())
    alone.emplace(__builtin_frame_address(0));
  return ode_ext_stock_trimesh_trimesh(g1, g2, flags, contacts, skip);
}

}  // namespace ode_ext
