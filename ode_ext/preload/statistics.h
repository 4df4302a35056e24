/* SPDX-License-Identifier: BSD-3-Clause */
/* What the preload saw, printed to stderr at the end of a program with ODE_EXT_STATS. */
#ifndef ODE_EXT_PRELOAD_STATISTICS_H
#define ODE_EXT_PRELOAD_STATISTICS_H

#include <time.h>

typedef struct {
  int is_outermost; /* and passes are counted */
  struct timespec start;
} PassTimer;

PassTimer begin_pass(void);
void end_pass(const PassTimer* timer);

/* For a pass of the program, until the end of the block, by an exception of its callback too. One
   that is left by longjmp is not counted, nor are later ones of its thread. */
#define PASS_TIMER \
  __attribute__((cleanup(end_pass), unused)) const PassTimer timer_of_the_pass = begin_pass()

/* Of preload.c. */
void print_core_statistics(void);
const char* found_ode_path(void); /* NULL: none was needed */

#endif
