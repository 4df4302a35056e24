/* SPDX-License-Identifier: BSD-3-Clause */
/* The ODE of a program: linked to it, loaded by it at any time, wherever its functions are. */
#ifndef ODE_EXT_PRELOAD_FIND_ODE_H
#define ODE_EXT_PRELOAD_FIND_ODE_H

#include <stddef.h>
#include <stdint.h>

typedef struct {
  void* handle;     /* of the object, which stays loaded; NULL: there is none */
  const char* path; /* "" for the program itself */
} FoundOde;

/* Which one the code at the address `caller` would call without this library: that of all, else
   that of the object that holds the code. Where this does not tell, the first that was loaded. */
FoundOde ode_ext_find_ode(const void* caller);

/* A function of it, or NULL. */
void* ode_ext_find_function(const FoundOde* ode, const char* name);

/* That within the program itself, whose calls never leave it. */
FoundOde ode_ext_find_ode_in_program(void);

/* Where the object that holds an address is in memory; of what no object holds, its page. */
typedef struct {
  uintptr_t begin;
  size_t size; /* [bytes] */
} Extent;
Extent ode_ext_extent_around(const void* address);

/* The directory of this library, with a slash at its end, to be freed. */
char* ode_ext_own_directory(void);

#endif
