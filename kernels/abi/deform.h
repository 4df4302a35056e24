// SPDX-License-Identifier: BSD-3-Clause
// What the host says about the meshes that a deform step follows.
#ifndef ODE_EXT_KERNELS_ABI_DEFORM_H
#define ODE_EXT_KERNELS_ABI_DEFORM_H

#include "abi/types.h"

// A mesh whose vertices move. The arrays of `topology` stay as long as its triangles do.
typedef struct {
  ox_mesh shape;        // its record from now on, but for `moved`
  ox_u32 mesh;          // index into all meshes
  ox_u32 vertex_first;  // index into all vertices
  ox_u32 vertex_count;
  ox_u32 position_first;  // of its new positions, in vertices
  ox_u32 corner_first;    // into topology: 3 vertices a triangle
  ox_u32 incident_first;  // into topology: vertex_count + 1 starts of runs of corners, then the
                          // corners: triangle << 2 | corner
  ox_f32 scale;           // a power of two that takes the mesh's size to about 1 [1/m]
  ox_f32 thickness;       // exit of the vertices of a two-sided sheet [m]
  ox_f32 on_surface;      // where a ray from a vertex begins [m]
  ox_u32 measure_first;   // of its triangles in the measures, in triangles
} ox_move;
OX_STATIC_ASSERT(sizeof(ox_move) == 132, ox_move_is_132_bytes);

#endif
