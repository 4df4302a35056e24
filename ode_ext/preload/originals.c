/* SPDX-License-Identifier: BSD-3-Clause */
#include "preload/originals.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

enum { kMostOdes = 8 };

Caller ode_ext_callers[kMostCallers];
atomic_int ode_ext_caller_count;

static Ode odes[kMostOdes];
static int ode_count;

static Ode* entry_of(FoundOde found) {
  for (int i = 0; i < ode_count; ++i)
    if (odes[i].found.handle == found.handle) return &odes[i];
  if (found.handle == NULL || ode_count == kMostOdes) return NULL;
  Ode* ode = &odes[ode_count++];
  ode->found = found;
#define INTERPOSED(name) ode->name = (__typeof__(ode->name))ode_ext_find_function(&found, #name);
#include "preload/interposed.h"
  ode->class_of = (__typeof__(ode->class_of))ode_ext_find_function(&found, "dGeomGetClass");
  return ode;
}

Ode* ode_ext_ode_of_program(void) { return entry_of(ode_ext_find_ode_in_program()); }

const Ode* ode_ext_first_ode(void) { return ode_count == 0 ? NULL : &odes[0]; }

Ode* ode_ext_ode_of_new_caller(const void* caller) {
  static pthread_mutex_t one_at_a_time = PTHREAD_MUTEX_INITIALIZER;
  pthread_mutex_lock(&one_at_a_time);
  Ode* ode = entry_of(ode_ext_find_ode(caller));
  if (ode != NULL && ode_ext_caller_count < kMostCallers) {
    ode_ext_callers[ode_ext_caller_count] = (Caller){ode_ext_extent_around(caller), ode};
    ++ode_ext_caller_count;
  }
  pthread_mutex_unlock(&one_at_a_time);
  if (ode == NULL) { /* whoever called had none either */
    fputs("ode_ext: a function of ODE was called, and there is no ODE in this process\n", stderr);
    abort();
  }
  return ode;
}
