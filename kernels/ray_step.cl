// SPDX-License-Identifier: BSD-3-Clause
// Ray step (GRAPP section 3.3): where does the ray from this vertex leave the target?
//
// in    rays, crossings, found, pairs, meshes, vertices, edges, triangles, meshlets, meshlet_nodes
// out   hits: of vertices that are inside
// item  1 ray (grid-stride)
// may overflow: OX_LIST_HITS
#include "lib/below_border.h"
#include "lib/border.h"
#include "lib/closest.h"
#include "lib/vertex_ray.h"

static void ox_cast_rays(const ox_scene* scene) {
  const uint first = scene->lists[OX_LIST_RAYS].first;
  const uint count = ox_length(scene, OX_LIST_RAYS);
  for (uint i = scene->item; i < count; i += scene->item_count) {
    const ox_ray ray = scene->rays[first + i];
    const uint side = ray.pair_side & 1u;
    __global const ox_pair* pair = scene->pairs + (ray.pair_side >> 1);
    __global const ox_mesh* source = scene->meshes + pair->mesh[side];
    __global const ox_mesh* target = scene->meshes + pair->mesh[1u - side];
    ox_vertex_ray vertex_ray = ox_ray_of(pair, side, scene->meshes, scene->vertices + ray.vertex,
                                         scene->found[ray.pair_side >> 1].sheet_side);
    vertex_ray.known = ray.memory == OX_RAY_INSIDE || ray.memory == OX_RAY_CONTAINED;
    uint work = 0u;
    uint remember;
    ox_outcome outcome = ox_cast_in_full(false, &vertex_ray, target, &scene->surfaces, OX_NONE,
                                         0.0f, &remember, &work);
    if (ray.memory == OX_RAY_CONTAINED) {
      // Its ray leaves by a face on one side of it, and the closest may be on the other. In a solid
      // that cuts itself that may be a wall in front of which it is: not by that does it come out.
      const float3 p = ox_place(pair, side, vload3(0, scene->vertices[ray.vertex].position));
      const uint closest =
          ox_closest_triangle(&scene->surfaces, target, vertex_ray.base, p,
                              outcome.triangle == OX_NONE ? INFINITY : outcome.t, pair->epsilon);
      if (closest != OX_NONE && ox_is_behind(scene->surfaces.triangles + closest, vertex_ray.base,
                                             p, OX_MARGIN * pair->epsilon)) {
        outcome.triangle = closest;
        outcome.kind = OX_HIT_INSIDE;
      }
    }
    // What crossings tell to be behind an open target is so as deep as it is.
    const bool told = ray.memory == OX_RAY_BEHIND;
    if (told && outcome.triangle == OX_NONE) {
      const float3 p = ox_place(pair, side, vload3(0, scene->vertices[ray.vertex].position));
      outcome.triangle = ox_closest_in_front(scene, ray.pair_side, p);
      if (outcome.triangle != OX_NONE) outcome.kind = OX_HIT_INSIDE;
    }
    // Or an edge of it comes from below that.
    uint edge = OX_NONE;
    if ((told || ray.memory == OX_RAY_REACHED) && outcome.triangle == OX_NONE) {
      const ox_below_border below = ox_find_below_border(scene, ray.pair_side, ray.vertex);
      if (below.edge == OX_NONE) continue;
      edge = below.edge;
      outcome.triangle = below.triangle;
      outcome.kind = OX_HIT_INSIDE;
      outcome.depth = below.depth;
      outcome.t = below.t;
    }
    const bool may_be_behind = !vertex_ray.known && edge == OX_NONE &&
                               (target->flags & (OX_MESH_CLOSED | OX_MESH_TWO_SIDED)) == 0u &&
                               (source->flags & OX_MESH_CLOSED) != 0u;
    if (may_be_behind && outcome.t > 0.5f * vertex_ray.exit && outcome.t < INFINITY &&
        !ox_goes_on(scene, ray.pair_side, vertex_ray.origin + outcome.t * vertex_ray.direction,
                    outcome.t))
      continue;
    ox_append_hit(scene, &ray, vertex_ray.known, ray.triangle, edge, &outcome);
  }
}

__kernel void ray_step(OX_SCENE_PARAMETERS) {
  const ox_scene scene = OX_SCENE;
  ox_cast_rays(&scene);
}
