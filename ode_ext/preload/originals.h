/* SPDX-License-Identifier: BSD-3-Clause */
/* The functions that the preload stands in front of, as the program has them. A process may have
   several ODEs, say two Python modules with one each: who calls says which is meant. */
#ifndef ODE_EXT_PRELOAD_ORIGINALS_H
#define ODE_EXT_PRELOAD_ORIGINALS_H

#include <ode/ode.h>
#include <stdatomic.h>

#include "preload/find_ode.h"

typedef struct {
#define INTERPOSED(name) __typeof__(&name) name;
#include "preload/interposed.h"
  __typeof__(&dGeomGetClass) class_of;
  FoundOde found;
  atomic_bool are_meshes_the_programs; /* which has a collider of its own for two of them */
} Ode;

enum { kMostCallers = 32 };
typedef struct {
  Extent code;
  Ode* ode;
} Caller;
extern Caller ode_ext_callers[kMostCallers];
extern atomic_int ode_ext_caller_count;

__attribute__((cold)) Ode* ode_ext_ode_of_new_caller(const void* caller);
/* Within the program itself, or NULL. */
Ode* ode_ext_ode_of_program(void);
/* The one that was called first, or NULL. */
const Ode* ode_ext_first_ode(void);

/* The ODE of whoever calls from this address. Never NULL. */
static inline Ode* ode_of(const void* caller) {
  const int count = ode_ext_caller_count;
  for (int i = 0; i < count; ++i) {
    const Caller* known = &ode_ext_callers[i];
    if ((uintptr_t)caller - known->code.begin < known->code.size) return known->ode;
  }
  return ode_ext_ode_of_new_caller(caller);
}

#endif
