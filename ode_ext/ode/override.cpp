// SPDX-License-Identifier: BSD-3-Clause
#include "ode/override.h"

#include <cxxabi.h>
#include <ode/ode.h>

#include <atomic>
#include <string>

#include "ode/contact_export.h"
#include "ode/messages.h"
#include "ode/registry.h"
#include "ode/stock_collider.h"
#include "opencl/fork_guard.h"

namespace ode_ext {
namespace {

// ODE's own collider ends the program there.
void refuse_stride(const std::string& fault) {
  const std::string message = "dCollide: " + fault + ": no contact is given";
  set_last_error(message);
  static std::atomic<bool> said{false};
  if (!said.exchange(true)) log(LogLevel::kError, message);
}

// dSetColliderOverride(i, i, fn) fills its one cell twice, and the second time as reversed:
// dCollide(A, B) calls fn(B, A) and then negates the normals and swaps g1/g2 and side1/side2. An
// answer in the order of fn's own arguments is thus right as it is. Stock contacts are not
// symmetric in the arguments, so they are asked for as the program did and turned round here first.
int collide_meshes(dGeomID g1, dGeomID g2, int flags, dContactGeom* contacts, int skip) {
  try {
    const std::string fault = fault_of_stride(skip);
    if (!fault.empty()) {
      refuse_stride(fault);
      return 0;
    }
    if (is_lost_by_fork()) {
      say_that_a_fork_lost_the_device();
    } else {
      const int count = answer_from_registry(g1, g2, flags & 0xffff, contacts, skip);
      if (count >= 0) return count;
    }
  } catch (const abi::__forced_unwind&) {  // the program ends the thread in a callback of its own
    throw;
  } catch (...) {  // out of memory: nothing may pass through ODE, and there still is an answer
  }
  const int stock = stock_collide(g2, g1, flags, contacts, skip);
  auto* bytes = reinterpret_cast<unsigned char*>(contacts);
  for (int i = 0; i < stock; ++i)
    turn_round(*reinterpret_cast<dContactGeom*>(bytes + static_cast<std::ptrdiff_t>(i) * skip));
  return stock;
}

}  // namespace

void install_override() { dSetColliderOverride(dTriMeshClass, dTriMeshClass, &collide_meshes); }

}  // namespace ode_ext
