/* SPDX-License-Identifier: BSD-3-Clause */
/* What the preload saw, printed to stderr at the end of a program with ODE_EXT_STATS. */
#ifndef ODE_EXT_PRELOAD_STATISTICS_H
#define ODE_EXT_PRELOAD_STATISTICS_H

#include <time.h>

typedef struct {
  int is_outermost; /* and passes are counted */
  struct timespec start;
} PassTimer;

/* Around a pass of the program. A pass that is left by longjmp is not counted. */
PassTimer begin_pass(void);
void end_pass(PassTimer timer);

/* Of preload.c. */
void print_core_statistics(void);
const char* found_ode_path(void); /* NULL: none was needed */

#endif
