/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ODE_EXT_PRELOAD_REDIRECT_H
#define ODE_EXT_PRELOAD_REDIRECT_H

#include <stdbool.h>

/* From now on whoever calls `function` calls `target`, from within its own object too: its first
   instructions are overwritten, so that what it did is lost. To be called while no other thread
   runs. False: nothing was changed. */
bool ode_ext_redirect(void* function, void* target);

#endif
