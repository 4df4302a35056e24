// SPDX-License-Identifier: BSD-3-Clause
// Pair step (GRAPP section 3.1): is this pair worth looking at, and which vertices of it?
//
// in    objects, meshes, chunks, pair_objects (2 object indices per pair), links
// out   pairs: the relative transform and the displacement of every pair whose oriented boxes
//       overlap
//       tasks: runs of vertices whose box reaches the target's, in three lists: rigid pairs with
//       small displacement, with high displacement, pairs with a deformable mesh; none of sides
//       that are flooded (flood.cl)
//       poses, directory: what the next step needs to find its temporal data
//       pair_hits, pair_crossings, heads, pair_ranges: cleared
// item  1 pair (grid-stride)
// may overflow: OX_LIST_CHUNKS_SMALL, OX_LIST_CHUNKS_HIGH, OX_LIST_CHUNKS_DEFORMABLE
#include "shared/append.h"
#include "shared/cull.h"
#include "shared/flooded.h"

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

// The angle between two relative poses [rad]; accurate for all of them, unlike the arc cosine.
static float ox_turned_by(__global const float* rotation, __global const float* before) {
  const float3 row0 = vload3(0, rotation);
  const float3 row1 = vload3(1, rotation);
  const float3 row2 = vload3(2, rotation);
  const float3 old0 = vload3(0, before);
  const float3 old1 = vload3(1, before);
  const float3 old2 = vload3(2, before);
  const float3 axis =
      (float3)(ox_dot(row2, old1) - ox_dot(row1, old2), ox_dot(row0, old2) - ox_dot(row2, old0),
               ox_dot(row1, old0) - ox_dot(row0, old1));
  const float trace = ox_dot(row0, old0) + ox_dot(row1, old1) + ox_dot(row2, old2);
  return atan2(sqrt(ox_dot(axis, axis)), trace - 1.0f);  // both twice: sine and cosine
}

// How far the vertices of each mesh moved in the other's frame at most (GRAPP section 3.2): as the
// middle of their bounding sphere did, and by the angle on its surface.
static void ox_displace(__global ox_pair* pair, __global const ox_relative_pose* before,
                        __global const ox_mesh* a, __global const ox_mesh* b) {
  const float angle = ox_turned_by(pair->rotation[0], before->rotation);
  const float3 old0 = vload3(0, before->rotation);
  const float3 old1 = vload3(1, before->rotation);
  const float3 old2 = vload3(2, before->rotation);
  const float3 ca = vload3(0, a->box_centre);
  const float3 cb = vload3(0, b->box_centre);
  const float3 a_was =
      (float3)(ox_dot(old0, ca), ox_dot(old1, ca), ox_dot(old2, ca)) + vload3(0, before->offset[0]);
  const float3 b_was = cb.x * old0 + cb.y * old1 + cb.z * old2 + vload3(0, before->offset[1]);
  const float3 a_moved = ox_place(pair, 0u, ca) - a_was;
  const float3 b_moved = ox_place(pair, 1u, cb) - b_was;
  pair->displacement[0] = sqrt(ox_dot(a_moved, a_moved)) + angle * a->radius;
  pair->displacement[1] = sqrt(ox_dot(b_moved, b_moved)) + angle * b->radius;
}

static void ox_store_pose(__global const ox_pair* pair, uint step,
                          __global ox_relative_pose* pose) {
  pose->step = step;
  for (uint i = 0u; i < 9u; ++i) pose->rotation[i] = pair->rotation[0][i];
  for (uint i = 0u; i < 3u; ++i) {
    pose->offset[0][i] = pair->offset[0][i];
    pose->offset[1][i] = pair->offset[1][i];
  }
}

static uint ox_category(__global const ox_pair* pair, uint side, __global const ox_mesh* source,
                        __global const ox_mesh* target, float displacement_limit) {
  if (((source->flags | target->flags) & OX_MESH_DEFORMABLE) != 0u) return OX_CATEGORY_DEFORMABLE;
  const float displacement = pair->displacement[side];  // infinite: not known
  return displacement < INFINITY && displacement <= displacement_limit * target->mean_edge
             ? OX_CATEGORY_SMALL
             : OX_CATEGORY_HIGH;
}

// dense_first: used if is_dense. Per pair the place of its first chunk among those of all pairs.
// Then a task is written for every chunk, at its own place, and those with nothing to do say so.
__kernel void pair_step(__global volatile uint* counters, __global const ox_list* lists,
                        __global const ox_object* objects, __global const ox_mesh* meshes,
                        __global const ox_chunk* chunks, __global const uint* pair_objects,
                        __global const ox_link* links, uint pair_count, uint step, uint rays_mode,
                        float displacement_limit, __global ox_relative_pose* poses,
                        __global ox_directory_entry* directory, __global ox_pair* pairs,
                        __global uint* pair_hits, __global uint* pair_crossings,
                        __global uint* heads, __global ox_range* pair_ranges, uint is_dense,
                        __global const uint* dense_first, __global ox_chunk_task* tasks) {
  const uint parity = step & 1u;  // what is read and what is written: a step may be run again
  const uint stride = (uint)get_global_size(0);
  for (uint p = (uint)get_global_id(0); p < pair_count; p += stride) {
    pair_hits[p] = 0u;
    pair_crossings[p] = 0u;
    heads[2u * p] = OX_NONE;
    heads[2u * p + 1u] = OX_NONE;
    pair_ranges[p].first = 0u;
    pair_ranges[p].count = 0u;
    pairs[p].near = 0u;

    __global const ox_object* a = objects + pair_objects[2u * p];
    __global const ox_object* b = objects + pair_objects[2u * p + 1u];
    __global const ox_mesh* mesh_a = meshes + a->mesh;
    __global const ox_mesh* mesh_b = meshes + b->mesh;
    const bool empty = mesh_a->chunk_count == 0u || mesh_b->chunk_count == 0u;
    if (empty && is_dense == 0u) continue;

    __global ox_pair* pair = pairs + p;
    ox_relate(a, b, pair);
    // A coordinate in the target's frame is a sum of three products and an offset, of factors that
    // carry up to six roundings (two turns of three terms): 16 * 2^-24 of the extents covers it.
    __global const float* offset = pair->offset[0];
    const float distance = fabs(offset[0]) + fabs(offset[1]) + fabs(offset[2]);
    const float epsilon = 0x1p-20f * (distance + mesh_a->extent + mesh_b->extent);
    pair->epsilon = epsilon;
    pair->mesh[0] = a->mesh;
    pair->mesh[1] = b->mesh;
    // Inside a closed target is inside its box, and the rays of a closed source end within it; but
    // those of an open one that meet another may leave its box.
    const bool both_open = ((mesh_a->flags | mesh_b->flags) & OX_MESH_CLOSED) == 0u;
    const float reach = both_open ? ox_max(mesh_a->reach, mesh_b->reach) : 0.0f;
    const bool bounded = !empty && ox_boxes_overlap(pair, mesh_a, mesh_b, epsilon + reach);
    pair->near = bounded ? 1u : 0u;
    __global const ox_link* link = links + p;
    const bool remembered = link->slot != OX_NONE;
    bool known = false;
    uint category[2] = {OX_CATEGORY_HIGH, OX_CATEGORY_HIGH};
    if (bounded) {
      ox_count(counters, OX_COUNTER_BOUNDED);
      __global ox_relative_pose* now = poses + 2u * link->slot + parity;
      __global ox_relative_pose* before = poses + 2u * link->slot + (1u - parity);
      known = remembered && link->known != 0u && before->step == step - 1u;
      pair->displacement[0] = INFINITY;
      pair->displacement[1] = INFINITY;
      if (known) ox_displace(pair, before, mesh_a, mesh_b);
      category[0] = ox_category(pair, 0u, mesh_a, mesh_b, displacement_limit);
      category[1] = ox_category(pair, 1u, mesh_b, mesh_a, displacement_limit);
      const bool both_small = category[0] == OX_CATEGORY_SMALL && category[1] == OX_CATEGORY_SMALL;
      // Temporal data that are complete after every step are as good as the last pose. Where
      // vertices without them are dropped, that is only so after the pair was last cast in full.
      const bool paper = (rays_mode & OX_RAYS_PAPER) != 0u;
      if (paper && !both_small && category[0] != OX_CATEGORY_DEFORMABLE)
        category[0] = category[1] = OX_CATEGORY_HIGH;
      if (remembered) {
        if (paper && both_small) {
          *now = *before;
          now->step = step;
        } else {
          ox_store_pose(pair, step, now);
        }
      }
    }
    if (!bounded && is_dense == 0u) continue;

    uint place = is_dense != 0u ? dense_first[p] : 0u;
    for (uint side = 0u; side < 2u; ++side) {
      __global const ox_mesh* source = side == 0u ? mesh_a : mesh_b;
      __global const ox_mesh* target = side == 0u ? mesh_b : mesh_a;
      if (ox_is_flooded(rays_mode, source, target)) continue;
      for (uint k = 0u; k < source->chunk_count; ++k) {
        const uint chunk = source->chunk_first + k;
        const bool keep = bounded && ox_keep_chunk(pair, side, target, chunks + chunk);
        uint slot_of_task;
        if (is_dense != 0u) {
          slot_of_task = place++;
          tasks[slot_of_task].chunk = OX_NONE;
        }
        if (!keep) continue;
        if (is_dense == 0u) slot_of_task = ox_append(counters, lists, category[side]);
        if (slot_of_task == OX_NONE) continue;
        __global ox_chunk_task* task = tasks + slot_of_task;
        task->pair_side = p << 1 | side;
        task->chunk = chunk;
        task->category = category[side] | (remembered ? OX_CATEGORY_REMEMBERED : 0u);
        task->previous = OX_NONE;
        if (!remembered) continue;
        __global ox_directory_entry* entry = directory + 2u * (link->directory[side] + k);
        if (known && entry[1u - parity].step == step - 1u)
          task->previous = entry[1u - parity].block;
        entry[parity].block = slot_of_task;
        entry[parity].step = step;
      }
    }
  }
}
