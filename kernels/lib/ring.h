// SPDX-License-Identifier: BSD-3-Clause
// The edges at a vertex. Device only.
#ifndef ODE_EXT_KERNELS_LIB_RING_H
#define ODE_EXT_KERNELS_LIB_RING_H

#include "lib/scene.h"

// Of the neighbours of all vertices (ox_scene::rings).
typedef struct {
  uint first, end;
} ox_ring;

static inline ox_ring ox_ring_of(const ox_scene* scene, uint vertex) {
  const ox_ring ring = {scene->ring_starts[vertex] & ~OX_RING_BOUNDS_NOTHING,
                        scene->ring_starts[vertex + 1u] & ~OX_RING_BOUNDS_NOTHING};
  return ring;
}

#endif
