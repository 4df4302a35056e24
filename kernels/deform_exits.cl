// SPDX-License-Identifier: BSD-3-Clause
// Deform step, the part of exits: where the ray from a vertex of a closed mesh leaves that mesh, as
// mesh/exit_distance.h.
//
// in    moves, starts (deform_step.cl), topology, vertices, meshlets, meshlet_nodes
// out   vertices: their exits
// item  1 vertex (grid-stride)
// may overflow: none
#include "lib/meshlet_tree.h"
#include "lib/moves.h"
#include "lib/ray_meshlet.h"

// The next faces of either side on a ray [m]; INFINITY: there is none.
typedef struct {
  float front_t, back_t;
} ox_wall;

// Beyond `from`, and not at the vertex; of the farther one it matters whether it is met at once.
static ox_wall ox_next_wall(__global const ox_move* move, __global const uint* topology,
                            __global const ox_meshlet* meshlets,
                            __global const ox_meshlet_node* meshlet_nodes, const ox_cast* cast,
                            float from, float at_once, uint vertex) {
  __global const ox_mesh* shape = &move->shape;
  ox_wall wall = {INFINITY, INFINITY};
  uint work = 0u;
  ox_ray_walk walk = ox_begin_ray_walk(shape);
  for (;;) {
    // More than t rounds: so the nearest is met whatever the order of the meshlets.
    const float limit = ox_min(wall.front_t, wall.back_t) + at_once;
    const uint next = ox_next_on_ray(&walk, cast, shape, meshlet_nodes, 0.0f, limit, &work);
    if (next == OX_NONE) return wall;
    __global const ox_meshlet* meshlet = meshlets + next;
    ox_moved_vertices seen;
    ox_shear_vertices(cast, meshlet, &seen);
    for (uint first = 0u; first < meshlet->triangle_count; first += OX_VECTOR_WIDTH) {
      ox_floats t, determinant;
      uint left = ox_meets_lanes(cast, meshlet, &seen, first / OX_VECTOR_WIDTH, from, INFINITY, &t,
                                 &determinant);
      if (left == 0u) continue;
      ox_lane_floats t_of, determinant_of;
      ox_keep_lanes(&t, &t_of);
      ox_keep_lanes(&determinant, &determinant_of);
      for (; left != 0u; left &= left - 1u) {
        const uint k = ox_lowest(left);
        const float here = ox_lane(&t_of, k);
        if (!(here > from)) continue;
        const uint triangle = meshlet->triangle[first + k] - shape->triangle_first;
        __global const uint* corners = topology + move->corner_first + 3u * triangle;
        if (corners[0] == vertex || corners[1] == vertex || corners[2] == vertex) continue;
        if (ox_lane(&determinant_of, k) < 0.0f)
          wall.back_t = ox_min(wall.back_t, here);
        else
          wall.front_t = ox_min(wall.front_t, here);
      }
    }
  }
}

// As in mesh/exit_distance.cpp. Each wall takes a walk down the tree.
#define OX_ALONG_RAY 8.0f
#define OX_MOST_WALLS 16

// Where it has left as often as it had entered, its start among that, or by a wall with nothing
// behind; INFINITY: it never does. What lies within on_surface is where it starts.
static float ox_exit(__global const ox_move* move, __global const uint* topology,
                     __global const ox_meshlet* meshlets,
                     __global const ox_meshlet_node* meshlet_nodes, float3 origin, float3 direction,
                     uint vertex) {
  const ox_cast cast = ox_cast_from((float3)(0.0f), origin, direction);
  const float at_once = OX_ALONG_RAY * move->on_surface;
  float from = move->on_surface;
  int inside = 1;
  float last = INFINITY;
  for (int wall = 0; wall < OX_MOST_WALLS; ++wall) {
    const ox_wall next =
        ox_next_wall(move, topology, meshlets, meshlet_nodes, &cast, from, at_once, vertex);
    const float t = ox_min(next.front_t, next.back_t);
    if (t == INFINITY) break;
    from = t + at_once;
    inside += (next.front_t <= from ? 1 : 0) - (next.back_t <= from ? 1 : 0);
    if (inside == 0) return t;
    last = ox_max(next.front_t, next.back_t) <= from ? t : INFINITY;
  }
  return last;
}

__kernel void deform_exits(__global const ox_move* moves, uint move_count,
                           __global const uint* all_starts, uint starts_first,
                           __global const uint* topology, __global const ox_meshlet* meshlets,
                           __global const ox_meshlet_node* meshlet_nodes,
                           __global ox_vertex* vertices) {
  __global const uint* starts = all_starts + starts_first;
  const uint stride = (uint)get_global_size(0);
  for (uint i = (uint)get_global_id(0); i < starts[move_count]; i += stride) {
    const uint m = ox_move_of(starts, move_count, i);
    __global const ox_move* move = moves + m;
    const uint local_index = i - starts[m];
    __global ox_vertex* vertex = vertices + move->vertex_first + local_index;
    const float3 direction = vload3(0, vertex->direction);
    if (ox_dot(direction, direction) == 0.0f) continue;
    vertex->exit = ox_exit(move, topology, meshlets, meshlet_nodes, vload3(0, vertex->position),
                           direction, local_index);
  }
}
