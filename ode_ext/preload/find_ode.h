/* SPDX-License-Identifier: BSD-3-Clause */
/* The ODE of the program: linked to it, loaded by it at any time, wherever its functions are. */
#ifndef ODE_EXT_PRELOAD_FIND_ODE_H
#define ODE_EXT_PRELOAD_FIND_ODE_H

/* Looks where the object that holds the address `caller` would find dSpaceCollide without this
   library, then in every object of the process in the order in which they were loaded. What is
   found stays loaded. Returns where, "" for the program itself, or NULL. */
const char* ode_ext_find_ode(const void* caller);

/* A function of the ODE found, or NULL. */
void* ode_ext_find_function(const char* name);

/* Whether the program itself holds an ODE. Its calls then never leave it. */
int ode_ext_ode_is_in_program(void);

/* The directory of this library, with a slash at its end, to be freed. */
char* ode_ext_own_directory(void);

#endif
