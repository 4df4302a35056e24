// SPDX-License-Identifier: BSD-3-Clause
// Pair step (GRAPP section 3.1): is this pair worth looking at, and which vertices of it?
//
// in    objects, meshes, chunks, grids, pair_objects (2 object indices per pair)
// out   pairs: the relative transform of every pair whose oriented boxes overlap
//       tasks: runs of vertices whose box reaches the target's
//       pair_hits, pair_ranges: cleared
// item  1 pair (grid-stride)
// may overflow: OX_COUNTER_CHUNKS
#include "shared/transform.h"

// Separating axes of two oriented boxes (Gottschalk 1996) in the frame of B. Rounding is covered by
// epsilon on every axis; near-parallel edges give a short axis, on which both sides shrink alike
// and epsilon still errs towards overlap.
static bool ox_boxes_overlap(__global const ox_pair* pair, __global const ox_mesh* a,
                             __global const ox_mesh* b, float epsilon) {
  const float3 ha = vload3(0, a->box_half);
  const float3 hb = vload3(0, b->box_half);
  const float3 d = ox_place(pair, 0u, vload3(0, a->box_centre)) - vload3(0, b->box_centre);
  const float3 in_b = ox_turn_extents(pair, 0u, ha) + hb;
  if (fabs(d.x) > in_b.x + epsilon || fabs(d.y) > in_b.y + epsilon || fabs(d.z) > in_b.z + epsilon)
    return false;
  const float3 d_in_a = ox_turn(pair, 1u, d);
  const float3 in_a = ox_turn_extents(pair, 1u, hb) + ha;
  if (fabs(d_in_a.x) > in_a.x + epsilon || fabs(d_in_a.y) > in_a.y + epsilon ||
      fabs(d_in_a.z) > in_a.z + epsilon)
    return false;

  const float half_a[3] = {ha.x, ha.y, ha.z};
  const float half_b[3] = {hb.x, hb.y, hb.z};
  const float distance[3] = {d.x, d.y, d.z};
  for (uint i = 0u; i < 3u; ++i) {  // axis i of B times axis j of A
    const uint i1 = (i + 1u) % 3u;
    const uint i2 = (i + 2u) % 3u;
    for (uint j = 0u; j < 3u; ++j) {
      const uint j1 = (j + 1u) % 3u;
      const uint j2 = (j + 2u) % 3u;
      const float r1 = pair->rotation[0][3u * i1 + j];
      const float r2 = pair->rotation[0][3u * i2 + j];
      const float reach_b = half_b[i1] * fabs(r2) + half_b[i2] * fabs(r1);
      const float reach_a = half_a[j1] * fabs(pair->rotation[0][3u * i + j2]) +
                            half_a[j2] * fabs(pair->rotation[0][3u * i + j1]);
      if (fabs(distance[i2] * r1 - distance[i1] * r2) > reach_a + reach_b + epsilon) return false;
    }
  }
  return true;
}

// No point within this distance [m] of p may be inside the mesh (geometry/clearance_grid.h).
static float ox_clearance(__global const ox_mesh* mesh, __global const uint* grids, float3 p) {
  const float point[3] = {p.x, p.y, p.z};
  float moved = 0.0f;
  uint index = 0u;
  for (uint axis = 3u; axis-- > 0u;) {
    const uint cells = mesh->grid_cells[axis];
    const float scale = mesh->grid_scale[axis];
    const float cell = (point[axis] - mesh->grid_origin[axis]) * scale;
    const float nearest = ox_min(ox_max(cell, 0.0f), (float)cells - 1.0f);
    moved += fabs(cell - nearest) / scale;
    const uint blocks = (cells + (OX_BLOCK_CELLS - 1u)) / OX_BLOCK_CELLS;
    index = index * blocks + (uint)nearest / OX_BLOCK_CELLS;
  }
  const uint steps = grids[mesh->clearance_first + (index >> 2)] >> 8u * (index & 3u) & 255u;
  return ((float)steps - 1.0f) * mesh->block_side - moved;
}

static void ox_relate(__global const ox_object* a, __global const ox_object* b,
                      __global ox_pair* pair) {
  const float3 a0 = vload3(0, a->rotation);
  const float3 a1 = vload3(1, a->rotation);
  const float3 a2 = vload3(2, a->rotation);
  const float3 b0 = vload3(0, b->rotation);
  const float3 b1 = vload3(1, b->rotation);
  const float3 b2 = vload3(2, b->rotation);
  // transpose(RB) * RA: row i is column i of RB against the rows of RA.
  const float3 row0 = b0.x * a0 + b1.x * a1 + b2.x * a2;
  const float3 row1 = b0.y * a0 + b1.y * a1 + b2.y * a2;
  const float3 row2 = b0.z * a0 + b1.z * a1 + b2.z * a2;
  vstore3(row0, 0, pair->rotation[0]);
  vstore3(row1, 1, pair->rotation[0]);
  vstore3(row2, 2, pair->rotation[0]);
  vstore3((float3)(row0.x, row1.x, row2.x), 0, pair->rotation[1]);
  vstore3((float3)(row0.y, row1.y, row2.y), 1, pair->rotation[1]);
  vstore3((float3)(row0.z, row1.z, row2.z), 2, pair->rotation[1]);
  // The high parts of neighbours differ exactly (Sterbenz), so nothing is lost far from the origin.
  const float3 d = (vload3(0, a->hi) - vload3(0, b->hi)) + (vload3(0, a->lo) - vload3(0, b->lo));
  vstore3(b0 * d.x + b1 * d.y + b2 * d.z, 0, pair->offset[0]);
  vstore3(-(a0 * d.x + a1 * d.y + a2 * d.z), 0, pair->offset[1]);
}

__kernel void pair_step(__global volatile uint* counters, __global const ox_object* objects,
                        __global const ox_mesh* meshes, __global const ox_chunk* chunks,
                        __global const uint* grids, __global const uint* pair_objects,
                        uint pair_count, __global ox_pair* pairs, __global uint* pair_hits,
                        __global ox_range* pair_ranges, __global ox_chunk_task* tasks,
                        uint capacity) {
  const uint stride = (uint)get_global_size(0);
  for (uint p = (uint)get_global_id(0); p < pair_count; p += stride) {
    pair_hits[p] = 0u;
    pair_ranges[p].first = 0u;
    pair_ranges[p].count = 0u;

    __global const ox_object* a = objects + pair_objects[2u * p];
    __global const ox_object* b = objects + pair_objects[2u * p + 1u];
    __global const ox_mesh* mesh_a = meshes + a->mesh;
    __global const ox_mesh* mesh_b = meshes + b->mesh;
    if (mesh_a->chunk_count == 0u || mesh_b->chunk_count == 0u) continue;

    __global ox_pair* pair = pairs + p;
    ox_relate(a, b, pair);
    // A coordinate in the target's frame is a sum of three products and an offset, of factors that
    // carry up to six roundings (two turns of three terms): 16 * 2^-24 of the extents covers it.
    __global const float* offset = pair->offset[0];
    const float reach = fabs(offset[0]) + fabs(offset[1]) + fabs(offset[2]);
    const float epsilon = 0x1p-20f * (reach + mesh_a->extent + mesh_b->extent);
    pair->epsilon = epsilon;
    pair->mesh[0] = a->mesh;
    pair->mesh[1] = b->mesh;
    if (!ox_boxes_overlap(pair, mesh_a, mesh_b, epsilon)) continue;
    atomic_inc(counters + OX_COUNTER_BOUNDED * OX_COUNTER_STRIDE);

    for (uint side = 0u; side < 2u; ++side) {
      __global const ox_mesh* source = side == 0u ? mesh_a : mesh_b;
      __global const ox_mesh* target = side == 0u ? mesh_b : mesh_a;
      const bool open = (target->flags & OX_MESH_CLOSED) == 0u;
      const float3 centre = vload3(0, target->box_centre);
      const float3 half_size = vload3(0, target->box_half);
      for (uint k = 0u; k < source->chunk_count; ++k) {
        __global const ox_chunk* chunk = chunks + source->chunk_first + k;
        const float3 middle = ox_place(pair, side, vload3(0, chunk->centre));
        const float3 d = fabs(middle - centre);
        float3 limit =
            ox_turn_extents(pair, side, vload3(0, chunk->half_size)) + half_size + epsilon;
        // Inside a closed target is inside its box; under an open one is not: the ray has to reach
        // it.
        if (open) limit += chunk->reach;
        if (d.x > limit.x || d.y > limit.y || d.z > limit.z) continue;
        if ((target->flags & OX_MESH_GRID) != 0u &&
            ox_clearance(target, grids, middle) > chunk->radius + epsilon)
          continue;
        const uint slot = atomic_inc(counters + OX_COUNTER_CHUNKS * OX_COUNTER_STRIDE);
        if (slot >= capacity) continue;
        tasks[slot].pair_side = p << 1 | side;
        tasks[slot].chunk = source->chunk_first + k;
      }
    }
  }
}
