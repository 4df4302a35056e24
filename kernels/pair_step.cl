// SPDX-License-Identifier: BSD-3-Clause
// Pair step (GRAPP section 3.1): is this pair worth looking at?
//
// in    objects, meshes, meshlet_nodes, pair_objects (2 object indices per pair)
// out   pairs: whether the oriented boxes overlap; if so the relative transform
//       found, pair_ranges: cleared
// item  1 pair (grid-stride)
// may overflow: none
#include "lib/append.h"
#include "lib/bases.h"
#include "lib/general_position.h"

// Separating axes of two oriented boxes (Gottschalk 1996) in the frame of B. Rounding is covered by
// epsilon on every axis; near-parallel edges give a short axis, on which both sides shrink alike
// and epsilon still errs towards overlap.
static bool ox_boxes_overlap(__global const ox_pair* pair, __global const ox_mesh* a,
                             __global const ox_mesh* b, float epsilon) {
  const float3 ha = vload3(0, a->box_half);
  const float3 hb = vload3(0, b->box_half);
  const float3 d = ox_transform(pair, 0u, vload3(0, a->box_centre)) - vload3(0, b->box_centre);
  const float3 in_b = ox_rotate_extents(pair, 0u, ha) + hb;
  if (fabs(d.x) > in_b.x + epsilon || fabs(d.y) > in_b.y + epsilon || fabs(d.z) > in_b.z + epsilon)
    return false;
  const float3 d_in_a = ox_rotate(pair, 1u, d);
  const float3 in_a = ox_rotate_extents(pair, 1u, hb) + ha;
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
  const ox_twofold d = ox_apart(a, b);
  vstore3(ox_turned_back(b->rotation, d.value), 0, pair->offset[0]);
  vstore3(-ox_turned_back(a->rotation, d.value), 0, pair->offset[1]);
}

static void ox_begin_found(__global ox_found* found) {
  found->features = 0u;
  found->first = 0u;
  found->placed = 0u;
  found->candidates = 0u;
  found->head[0] = OX_NONE;
  found->head[1] = OX_NONE;
  found->at_border[0] = 0u;
  found->at_border[1] = 0u;
  found->is_below[0] = 0u;
  found->is_below[1] = 0u;
  found->sheet_side = OX_SHEET_UNTOLD;
}

static void ox_relate_pairs(const ox_scene* scene) {
  for (uint p = scene->pair_first + scene->item; p < scene->pair_end; p += scene->item_count) {
    ox_begin_found(scene->found + p);
    scene->pair_ranges[p].first = 0u;
    scene->pair_ranges[p].count = 0u;
    scene->pair_ranges[p].features = 0u;
    scene->pairs[p].near = 0u;

    __global const ox_object* a = scene->objects + scene->pair_objects[2u * p];
    __global const ox_object* b = scene->objects + scene->pair_objects[2u * p + 1u];
    __global const ox_mesh* mesh_a = scene->meshes + a->mesh;
    __global const ox_mesh* mesh_b = scene->meshes + b->mesh;
    __global ox_pair* pair = scene->pairs + p;
    pair->mesh[0] = a->mesh;
    pair->mesh[1] = b->mesh;
    if (mesh_a->chunk_count == 0u || mesh_b->chunk_count == 0u) continue;

    ox_relate(a, b, pair);
    // A coordinate in the target's frame is a sum of three products and an offset, of factors that
    // carry up to six roundings (two turns of three terms): 16 * 2^-24 of the extents covers it.
    __global const float* offset = pair->offset[0];
    const float distance = fabs(offset[0]) + fabs(offset[1]) + fabs(offset[2]);
    const float size = distance + mesh_a->extent + mesh_b->extent;
    pair->epsilon = OX_ROUNDING * size;
    pair->margin = OX_MARGIN * pair->epsilon;
    const float apart = pair->margin;
    // Inside a closed target is inside its box, and the rays of a closed source end within it; but
    // those of an open one that meet another may leave its box.
    const bool both_open = ((mesh_a->flags | mesh_b->flags) & OX_MESH_CLOSED) == 0u;
    const float reach = both_open ? ox_max(mesh_a->reach, mesh_b->reach) : 0.0f;
    if (!ox_boxes_overlap(pair, mesh_a, mesh_b, apart + reach)) continue;
    const float size_from_base = ox_choose_bases(scene, a, b, size, pair);
    pair->epsilon = OX_ROUNDING * size_from_base;
    pair->snap = ox_snap_of(size_from_base + OX_MARGIN * pair->epsilon);
    pair->near = 1u;
    ox_count(scene, OX_COUNTER_BOUNDED);
  }
}

__kernel void pair_step(OX_SCENE_PARAMETERS) {
  const ox_scene scene = OX_SCENE;
  ox_relate_pairs(&scene);
}
