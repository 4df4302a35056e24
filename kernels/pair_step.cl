// SPDX-License-Identifier: BSD-3-Clause
// Pair step (GRAPP section 3.1): is this pair worth looking at?
//
// in    objects, meshes, pair_objects (2 object indices per pair)
// out   pairs: whether the oriented boxes overlap; if so the relative transform
//       found, pair_ranges: cleared
// item  1 pair (grid-stride)
// may overflow: none
#include "lib/append.h"
#include "lib/general_position.h"

// What rounding can do to a coordinate, in parts of how large coordinates are.
#define OX_ROUNDING 0x1p-20f
// So many times as near coordinates have to be from bases as from origins for these to be taken:
// a bit or two are not worth another frame.
#define OX_WORTH_A_BASE 16.0f

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

// A difference or a product, and what it was rounded by.
typedef struct {
  float3 value, rest;
} ox_twofold;

// Knuth's.
static ox_twofold ox_sum(float3 a, float3 b) {
  ox_twofold sum;
  sum.value = a + b;
  const float3 part = sum.value - a;
  sum.rest = (a - (sum.value - part)) + (b - part);
  return sum;
}

// From b to a.
static ox_twofold ox_apart(__global const ox_object* a, __global const ox_object* b) {
  const ox_twofold high = ox_sum(vload3(0, a->hi), -vload3(0, b->hi));
  ox_twofold both = ox_sum(high.value, vload3(0, a->lo) - vload3(0, b->lo));
  both.rest += high.rest;
  return both;
}

// What x * v.x + y * v.y + z * v.z, in this order, is rounded by.
static float3 ox_rest_of_sum(float3 x, float3 y, float3 z, float3 v) {
  const float3 px = x * v.x;
  const float3 py = y * v.y;
  const float3 pz = z * v.z;
  const ox_twofold first = ox_sum(px, py);
  const ox_twofold all = ox_sum(first.value, pz);
  return fma(x, (float3)(v.x), -px) + fma(y, (float3)(v.y), -py) + fma(z, (float3)(v.z), -pz) +
         first.rest + all.rest;
}

// What is missing from d turned into the frame of an object, as ox_relate does.
static float3 ox_rest_of_turned(__global const ox_object* object, ox_twofold d) {
  const float3 x = vload3(0, object->rotation);
  const float3 y = vload3(1, object->rotation);
  const float3 z = vload3(2, object->rotation);
  __global const float* rest = object->rotation_rest;
  const float3 of_rotation =
      vload3(0, rest) * d.value.x + vload3(1, rest) * d.value.y + vload3(2, rest) * d.value.z;
  return ox_rest_of_sum(x, y, z, d.value) + (x * d.rest.x + y * d.rest.y + z * d.rest.z) +
         of_rotation;
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
  vstore3(b0 * d.value.x + b1 * d.value.y + b2 * d.value.z, 0, pair->offset[0]);
  vstore3(-(a0 * d.value.x + a1 * d.value.y + a2 * d.value.z), 0, pair->offset[1]);
  for (uint side = 0u; side < 2u; ++side) {
    vstore3((float3)(0.0f), 0, pair->base[side]);
    vstore3(vload3(0, pair->offset[side]), 0, pair->base_offset[side]);
  }
}

// Bases where one mesh is small beside the other: its origin, and the place of that in the other.
// What meets it lies within its extent of there, but for the span of a meshlet. Returns how large
// coordinates from there are; that gains enough to count.
static float ox_choose_bases(__global const ox_object* a, __global const ox_object* b,
                             __global const ox_mesh* mesh_a, __global const ox_mesh* mesh_b,
                             float size, __global ox_pair* pair) {
  const uint small = mesh_a->extent <= mesh_b->extent ? 0u : 1u;
  const uint large = 1u - small;
  __global const ox_object* there = small == 0u ? b : a;
  const float extent = small == 0u ? mesh_a->extent : mesh_b->extent;
  const float span = small == 0u ? mesh_b->span : mesh_a->span;
  const float size_from_base = 2.0f * extent + span + pair->margin;
  if (!(OX_WORTH_A_BASE * size_from_base <= size)) return size;
  const ox_twofold d = small == 0u ? ox_apart(a, b) : ox_apart(b, a);
  const float3 base = vload3(0, pair->offset[small]);
  const float3 rest = ox_rest_of_turned(there, d);
  vstore3(base, 0, pair->base[large]);
  vstore3(rest, 0, pair->base_offset[small]);
  vstore3(-ox_rotate(pair, large, rest), 0, pair->base_offset[large]);
  return size_from_base + fabs(rest.x) + fabs(rest.y) + fabs(rest.z);
}

static void ox_begin_found(__global ox_found* found) {
  found->features = 0u;
  found->first = 0u;
  found->placed = 0u;
  found->candidates = 0u;
  found->head[0] = OX_NONE;
  found->head[1] = OX_NONE;
}

static void ox_relate_pairs(const ox_scene* scene) {
  for (uint p = scene->pair_first + scene->item; p < scene->pair_end; p += scene->item_count) {
    ox_begin_found(scene->found + p);
    scene->pair_ranges[p].first = 0u;
    scene->pair_ranges[p].count = 0u;
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
    const float size_from_base = ox_choose_bases(a, b, mesh_a, mesh_b, size, pair);
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
