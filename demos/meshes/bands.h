// SPDX-License-Identifier: BSD-3-Clause
// What surfaces of rings are made from. A ring is a run of vertices, numbered consecutively.
#pragma once

#include "meshes/triangle_mesh.h"

namespace falling_objects {

// Joins two rings of equally many vertices by a band of quads. Going round a ring is
// counter-clockwise seen from the side of `upper`.
inline void add_band(TriangleMesh& mesh, unsigned lower, unsigned upper, unsigned count) {
  for (unsigned i = 0; i < count; ++i) {
    const unsigned j = (i + 1) % count;
    mesh.add_quad(lower + i, lower + j, upper + j, upper + i);
  }
}

// Closes a ring by a fan. `outward_up`: seen from outside the ring goes counter-clockwise.
inline void add_fan(TriangleMesh& mesh, unsigned ring, unsigned apex, unsigned count,
                    bool outward_up) {
  for (unsigned i = 0; i < count; ++i) {
    const unsigned j = (i + 1) % count;
    if (outward_up) {
      mesh.add_triangle(ring + i, ring + j, apex);
    } else {
      mesh.add_triangle(ring + j, ring + i, apex);
    }
  }
}

}  // namespace falling_objects
