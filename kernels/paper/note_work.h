// SPDX-License-Identifier: BSD-3-Clause
// What work-items did, in programs built to count it. Device only.
#ifndef ODE_EXT_KERNELS_PAPER_NOTE_WORK_H
#define ODE_EXT_KERNELS_PAPER_NOTE_WORK_H

#include "abi/paper.h"

static inline void ox_note_work(__global ox_work* works, uint item, const ox_work* work) {
#ifdef OX_COUNT_WORK
  works[item] = *work;
#else
  (void)works;
  (void)item;
  (void)work;
#endif
}

#endif
