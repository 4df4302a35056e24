/* SPDX-License-Identifier: BSD-3-Clause */
#include "preload/statistics.h"

#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static int are_wanted;
static pid_t process; /* not those that are forked from it */
static atomic_llong passes, nanoseconds;
static _Thread_local int passes_of_this_thread;

PassTimer begin_pass(void) {
  PassTimer timer = {are_wanted && passes_of_this_thread == 0, {0, 0}};
  if (!timer.is_outermost) return timer;
  ++passes_of_this_thread;
  clock_gettime(CLOCK_MONOTONIC, &timer.start);
  return timer;
}

void end_pass(const PassTimer* timer) {
  if (!timer->is_outermost) return;
  struct timespec end;
  clock_gettime(CLOCK_MONOTONIC, &end);
  --passes_of_this_thread;
  ++passes;
  nanoseconds +=
      (end.tv_sec - timer->start.tv_sec) * 1000000000LL + end.tv_nsec - timer->start.tv_nsec;
}

/* The program that ode_ext-run was given, not one that it starts in its turn. */
static int is_the_one_asked_for(void) {
  const char* asked_for = getenv("ODE_EXT_STATS_OF");
  return asked_for != NULL && atol(asked_for) == (long)process;
}

static void print_statistics(void) {
  const char* path = found_ode_path();
  if (getpid() != process || (path == NULL && !is_the_one_asked_for())) return;
  if (path == NULL) {
    fputs("ode_ext: the program called no ODE that can be seen from outside\n", stderr);
  } else {
    fprintf(stderr, "ode_ext: %lld passes, %.3f s with all that their callbacks did; ODE is %s\n",
            (long long)passes, 1e-9 * (double)nanoseconds, *path == '\0' ? "in the program" : path);
    print_core_statistics();
  }
}

__attribute__((constructor)) static void begin(void) {
  const char* wanted = getenv("ODE_EXT_STATS");
  are_wanted = wanted != NULL && *wanted != '\0' && *wanted != '0';
  process = getpid();
  if (are_wanted) atexit(&print_statistics);
}
