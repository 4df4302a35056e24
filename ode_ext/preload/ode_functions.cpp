// SPDX-License-Identifier: BSD-3-Clause
// Each function of ODE that this library calls, under its own name: a jump to where it was found in
// the program. Hidden, so that neither the program nor ODE sees them, and what calls them is the
// same code that elsewhere is linked with ODE.
#include <ode/ode.h>

#include <atomic>

#include "ode/messages.h"
#include "preload/find_ode_functions.h"

#if defined(__x86_64__)
#define ODE_EXT_JUMP(pointer) "jmp *" pointer "(%rip)\n"
#elif defined(__aarch64__)
#define ODE_EXT_JUMP(pointer)     \
  "adrp x16, " pointer            \
  "\n"                            \
  "ldr x16, [x16, :lo12:" pointer \
  "]\n"                           \
  "br x16\n"
#else
#error "a jump through a variable, in the assembly of this processor, is missing here"
#endif

#define ODE_FUNCTION(name)                                                                 \
  extern "C" {                                                                             \
  __attribute__((visibility("hidden"))) void* ode_ext_place_of_##name = nullptr;           \
  }                                                                                        \
  __asm__(".text\n.globl " #name "\n.hidden " #name "\n.type " #name ", %function\n" #name \
          ":\n" ODE_EXT_JUMP("ode_ext_place_of_" #name));
#include "preload/ode_functions.h"

namespace ode_ext {
namespace {

// Of an ODE that does not show these: where it keeps the arrays of meshes is not found then
// (ode/mesh_arrays.h).
void build_nothing(dTriMeshDataID, const void*, int, int, const void*, int, int) {}

// Of an ODE without merge callbacks.
dTriTriMergeCallback* no_merge_callback(dGeomID) { return nullptr; }

// An ODE that hides its own mesh collider: asked for where a device failed.
int no_contacts(dGeomID, dGeomID, int, dContactGeom*, int) {
  static std::atomic<bool> said{false};
  if (!said.exchange(true))
    log(LogLevel::kError,
        "this ODE does not export its own trimesh-trimesh collider; without a working device mesh "
        "pairs get no contacts");
  return 0;
}

struct Function {
  const char* name;
  void** place;
  void* own;
};

const Function kFunctions[] = {
#define ODE_FUNCTION(name) {#name, &ode_ext_place_of_##name, nullptr},
#define ODE_FUNCTION_OR(name, own) \
  {#name, &ode_ext_place_of_##name, reinterpret_cast<void*>(&(own))},
#include "preload/ode_functions.h"
};

}  // namespace

const char* find_ode_functions(void* (*find)(const char* name)) {
  for (const Function& function : kFunctions) {
    void* found = find(function.name);
    *function.place = found != nullptr ? found : function.own;
    if (*function.place == nullptr) return function.name;
  }
  return nullptr;
}

}  // namespace ode_ext
