// SPDX-License-Identifier: BSD-3-Clause
// Deform step: makes everything anew that depends on the vertices of deformable meshes, for all
// meshes that moved together. In this order: triangles, vertices, meshlets and the tree over them
// (deform_meshlets.cl), exits (deform_exits.cl), chunks, meshes. Meshes that moved before and rest
// now only have that taken back.
//
// in    moves, starts (of all launches; those of this one lie from starts_first on), positions (3
//       floats a vertex), topology
// out   triangles, vertices, chunks, meshes: those of the meshes that moved, in place
//       measures: from triangles to vertices, 4 floats a triangle: the angles at its corners
//       and its area
// item  1 triangle / vertex / chunk of vertices / mesh (grid-stride)
// may overflow: none
//
// Nothing here depends on the shape that a mesh had before (but for `moved`), nor on the order of
// its vertices: a mesh gives the same bits however it came to its shape.
#include "lib/moves.h"

// a * b - c * d to 1.5 roundings of the result (Kahan; Jeannerod, Louvet, Muller 2013).
static float ox_minor(float a, float b, float c, float d) {
  const float q = c * d;
  const float rest = fma(-c, d, q);
  return fma(a, b, -q) + rest;
}

static float3 ox_cross(float3 a, float3 b) {
  return (float3)(ox_minor(a.y, b.z, a.z, b.y), ox_minor(a.z, b.x, a.x, b.z),
                  ox_minor(a.x, b.y, a.y, b.x));
}

// What rounding takes off `difference` = a - b (Knuth's two-sum).
static float3 ox_rest(float3 a, float3 b, float3 difference) {
  const float3 minus_b = difference - a;
  return (a - (difference - minus_b)) - (b + minus_b);
}

typedef struct {
  float3 normal;  // unit; 0: no area
  float area;     // twice the area
} ox_deformed_face;

// As good as in double precision: edges are kept with what their rounding takes off, so the cross
// product carries, besides 3 roundings of its own, only products of two roundings: per component 4
// of the low terms, 2 that are left out and 4 of their sums, 10 * 2^-48 of the lengths, times
// sqrt(3) less than 2^-43. A smaller one is noise, and the area zero.
static ox_deformed_face ox_face_of(float3 a, float3 b, float3 c) {
  const float3 u = b - a;
  const float3 v = c - a;
  const float3 u_low = ox_rest(b, a, u);
  const float3 v_low = ox_rest(c, a, v);
  const float3 low = (float3)((u.y * v_low.z - u.z * v_low.y) + (u_low.y * v.z - u_low.z * v.y),
                              (u.z * v_low.x - u.x * v_low.z) + (u_low.z * v.x - u_low.x * v.z),
                              (u.x * v_low.y - u.y * v_low.x) + (u_low.x * v.y - u_low.y * v.x));
  const float3 n = ox_cross(u, v) + low;
  ox_deformed_face face;
  face.area = ox_norm(n);
  face.normal = (float3)(0.0f);
  // Below the smallest normal float a product has lost digits.
  if (face.area <= 0x1p-43f * ox_norm(u) * ox_norm(v) || face.area < 0x1p-100f) {
    face.area = 0.0f;
    return face;
  }
  const float3 shrunk = n / face.area;  // again, since area may be off by a few roundings
  face.normal = shrunk / sqrt(ox_dot(shrunk, shrunk));
  return face;
}

static float3 ox_position(__global const ox_move* move, __global const float* positions,
                          uint vertex) {
  return vload3(move->position_first + vertex, positions);
}

// The angle of (x, y) to the x axis, y not negative, to 4 roundings: accurate for all, unlike
// the arc cosine. Not atan2(), of which every device has its own. The tangent is brought to at most
// that of pi/8; up to there the arc is t + t^3 * polynomial(t^2), made to meet it at Chebyshev's
// places, within 2^-28.
static float ox_angle(float y, float x) {
  const float low = ox_min(fabs(x), y);
  const float high = ox_max(fabs(x), y);
  const bool steep = low > 0.41421356f * high;
  const float t = high == 0.0f ? 0.0f : (steep ? low - high : low) / (steep ? low + high : high);
  const float z = t * t;
  const float polynomial =
      -0.33333331f + z * (0.19999540f + z * (-0.14263956f + z * (0.10743731f + z * -0.064519279f)));
  const float arc = (steep ? 0.78539816f : 0.0f) + (t + t * z * polynomial);
  const float upright = y > fabs(x) ? 1.5707963f - arc : arc;
  return x < 0.0f ? 3.1415927f - upright : upright;
}

__kernel void deform_triangles(__global const ox_move* moves, uint move_count,
                               __global const uint* all_starts, uint starts_first,
                               __global const float* positions, __global const uint* topology,
                               __global ox_triangle* triangles, __global float* measures) {
  __global const uint* starts = all_starts + starts_first;
  const uint stride = (uint)get_global_size(0);
  for (uint i = (uint)get_global_id(0); i < starts[move_count]; i += stride) {
    const uint m = ox_move_of(starts, move_count, i);
    __global const ox_move* move = moves + m;
    const uint local_index = i - starts[m];
    __global const uint* corners = topology + move->corner_first + 3u * local_index;
    __global ox_triangle* triangle = triangles + move->shape.triangle_first + local_index;
    const float3 a = ox_position(move, positions, corners[0]);
    const float3 b = ox_position(move, positions, corners[1]);
    const float3 c = ox_position(move, positions, corners[2]);
    const float scale = move->scale;
    const ox_deformed_face face = ox_face_of(scale * a, scale * b, scale * c);
    const bool flat = face.area == 0.0f;
    vstore3(a, 0, triangle->a);
    vstore3(flat ? a : b, 0, triangle->b);
    vstore3(flat ? a : c, 0, triangle->c);
    vstore3(face.normal, 0, triangle->normal);
    // The area is that of the parallelogram at any corner: sides times the sine.
    const float3 ab = scale * b - scale * a;
    const float3 bc = scale * c - scale * b;
    const float3 ca = scale * a - scale * c;
    vstore4((float4)(ox_angle(face.area, -ox_dot(ca, ab)), ox_angle(face.area, -ox_dot(ab, bc)),
                     ox_angle(face.area, -ox_dot(bc, ca)), face.area),
            move->measure_first + local_index, measures);
  }
}

// The sum of the normals of the faces weighted by their angles (Thuermer and Wuethrich 1998), as
// mesh/normals.h. Where they cancel out it is the normal of the largest face: each term is
// right to about 20 roundings, 2^-20 of the weights; a sum 16 times as long still has a direction.
static float3 ox_vertex_normal(__global const ox_move* move, __global const uint* topology,
                               __global const ox_triangle* all_triangles,
                               __global const float* all_measures, uint vertex) {
  __global const uint* runs = topology + move->incident_first;
  __global const uint* incident = runs + move->vertex_count + 1u;
  __global const ox_triangle* triangles = all_triangles + move->shape.triangle_first;
  __global const float* measures = all_measures + 4u * move->measure_first;
  float3 sum = (float3)(0.0f);
  float3 rest = (float3)(0.0f);  // of the sum, after Kahan: it does not matter how many there are
  float weight = 0.0f;
  float largest = 0.0f;
  float3 normal_of_largest = (float3)(0.0f);
  for (uint k = runs[vertex]; k < runs[vertex + 1u]; ++k) {
    const uint face = incident[k] >> 2;
    const float area = measures[4u * face + 3u];
    if (area == 0.0f) continue;
    const float angle = measures[4u * face + (incident[k] & 3u)];
    const float3 normal = vload3(0, triangles[face].normal);
    const float3 term = angle * normal - rest;
    const float3 next = sum + term;
    rest = (next - sum) - term;
    sum = next;
    weight += angle;
    if (area > largest) {
      largest = area;
      normal_of_largest = normal;
    }
  }
  const float norm = ox_norm(sum);
  return norm > 0x1p-16f * weight ? sum / norm : normal_of_largest;
}

// The vertices of a closed mesh get their exits from deform_exits.
__kernel void deform_vertices(__global const ox_move* moves, uint move_count,
                              __global const uint* all_starts, uint starts_first,
                              __global const float* positions, __global const uint* topology,
                              __global const ox_triangle* triangles, __global const float* measures,
                              __global ox_vertex* vertices) {
  __global const uint* starts = all_starts + starts_first;
  const uint stride = (uint)get_global_size(0);
  for (uint i = (uint)get_global_id(0); i < starts[move_count]; i += stride) {
    const uint m = ox_move_of(starts, move_count, i);
    __global const ox_move* move = moves + m;
    const uint local_index = i - starts[m];
    __global ox_vertex* vertex = vertices + move->vertex_first + local_index;
    const float3 position = ox_position(move, positions, local_index);
    const float3 normal = ox_vertex_normal(move, topology, triangles, measures, local_index);
    const float distance = ox_norm(position - vload3(0, vertex->position));
    vertex->moved = distance * (1.0f + 0x1p-20f);  // up: fewer than 8 roundings
    vstore3(position, 0, vertex->position);
    vstore3(-normal, 0, vertex->direction);
    vertex->exit = ox_dot(normal, normal) == 0.0f ? 0.0f : move->thickness;
  }
}

// centre +- half_size holds the box.
static void ox_store_box(float3 lo, float3 hi, __global ox_chunk* chunk) {
  const float3 centre = 0.5f * lo + 0.5f * hi;
  const float3 above = hi - centre;
  const float3 below = centre - lo;
  // 2^-23 of a float is at least its last digit.
  const float3 half_size =
      (1.0f + 0x1p-23f) *
      (float3)(ox_max(above.x, below.x), ox_max(above.y, below.y), ox_max(above.z, below.z));
  vstore3(centre, 0, chunk->centre);
  vstore3(half_size, 0, chunk->half_size);
}

__kernel void deform_chunks(__global const ox_move* moves, uint move_count,
                            __global const uint* all_starts, uint starts_first,
                            __global const ox_vertex* vertices, __global ox_chunk* chunks) {
  __global const uint* starts = all_starts + starts_first;
  const uint stride = (uint)get_global_size(0);
  for (uint i = (uint)get_global_id(0); i < starts[move_count]; i += stride) {
    const uint m = ox_move_of(starts, move_count, i);
    __global ox_chunk* chunk = chunks + moves[m].shape.chunk_first + (i - starts[m]);
    float3 lo = (float3)(INFINITY);
    float3 hi = (float3)(-INFINITY);
    float reach = 0.0f;
    float moved = 0.0f;
    for (uint v = chunk->first; v < chunk->first + chunk->count; ++v) {
      __global const ox_vertex* vertex = vertices + v;
      const float3 p = vload3(0, vertex->position);
      lo = (float3)(ox_min(p.x, lo.x), ox_min(p.y, lo.y), ox_min(p.z, lo.z));
      hi = (float3)(ox_max(p.x, hi.x), ox_max(p.y, hi.y), ox_max(p.z, hi.z));
      if (vertex->exit != INFINITY) reach = ox_max(reach, vertex->exit);
      moved = ox_max(moved, vertex->moved);
    }
    ox_store_box(lo, hi, chunk);
    chunk->reach = reach;
    chunk->moved = moved;
  }
}

__kernel void deform_meshes(__global const ox_move* moves, uint move_count,
                            __global const ox_chunk* chunks, __global ox_mesh* meshes) {
  const uint stride = (uint)get_global_size(0);
  for (uint m = (uint)get_global_id(0); m < move_count; m += stride) {
    ox_mesh shape = moves[m].shape;
    shape.moved = 0.0f;
    for (uint k = shape.chunk_first; k < shape.chunk_first + shape.chunk_count; ++k)
      shape.moved = ox_max(shape.moved, chunks[k].moved);
    meshes[moves[m].mesh] = shape;
  }
}

// The vertices of meshes that moved before and do not now.
__kernel void deform_rest(__global const ox_move* moves, uint move_count,
                          __global const uint* all_starts, uint starts_first,
                          __global ox_vertex* vertices, __global ox_chunk* chunks) {
  __global const uint* starts = all_starts + starts_first;
  const uint stride = (uint)get_global_size(0);
  for (uint i = (uint)get_global_id(0); i < starts[move_count]; i += stride) {
    const uint m = ox_move_of(starts, move_count, i);
    const uint local_index = i - starts[m];
    vertices[moves[m].vertex_first + local_index].moved = 0.0f;
    if (local_index % OX_CHUNK_VERTICES == 0u)
      chunks[moves[m].shape.chunk_first + local_index / OX_CHUNK_VERTICES].moved = 0.0f;
  }
}
