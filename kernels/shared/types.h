// SPDX-License-Identifier: BSD-3-Clause
// What host and device both read and write: counters, buffer records. Compiled by both sides, so
// only 32-bit scalars and arrays of them, with explicit padding.
#ifndef ODE_EXT_KERNELS_SHARED_TYPES_H
#define ODE_EXT_KERNELS_SHARED_TYPES_H

#ifdef __OPENCL_C_VERSION__
// A fused multiply-subtract is not antisymmetric: two triangles would disagree about the side of
// their shared edge on which a ray passes, and it would slip through. Holds to the end of the
// program.
#pragma OPENCL FP_CONTRACT OFF
typedef uint ox_u32;
typedef float ox_f32;
#define OX_STATIC_ASSERT(condition, name) typedef char name[(condition) ? 1 : -1]
#else
#include <cstdint>
typedef std::uint32_t ox_u32;
typedef float ox_f32;
#define OX_STATIC_ASSERT(condition, name) static_assert(condition, #name)
#endif

// Counters live in one buffer, each on a cache line of its own. A counter runs on past the capacity
// of its append buffer: that is how overflow is seen.
#define OX_COUNTER_STRIDE 16u
#define OX_COUNTER_CHUNKS 0u
#define OX_COUNTER_RAYS 1u
#define OX_COUNTER_HITS 2u
#define OX_COUNTER_CONTACTS 3u
#define OX_COUNTER_BOUNDED 4u   // pairs whose bounding volumes overlap
#define OX_COUNTER_SEGMENTS 5u  // candidates handed out to pairs
#define OX_COUNTER_COUNT 6u

#define OX_CHUNK_VERTICES 16u

// A block of the clearance grid is this many cells of the occupancy grid wide.
#define OX_BLOCK_CELLS 4u

#define OX_MESH_CLOSED 1u
#define OX_MESH_GRID 2u

// A geom of this step. world = rotation * local + (hi + lo), rotation row-major; hi + lo is the
// position to twice the float precision, so that differences hold far from the origin.
typedef struct {
  ox_f32 rotation[9];
  ox_f32 hi[3];
  ox_f32 lo[3];
  ox_u32 mesh;
} ox_object;
OX_STATIC_ASSERT(sizeof(ox_object) == 64, ox_object_is_64_bytes);

// A mesh: where its parts start in the concatenated arrays, and its bounds in its own frame [m].
typedef struct {
  ox_u32 chunk_first, chunk_count;
  ox_u32 node_first, node_count;
  ox_u32 triangle_first;
  ox_u32 grid_first;       // word index of the occupancy bits
  ox_u32 clearance_first;  // word index of the clearance steps, four to a word
  ox_u32 grid_cells[3];
  ox_u32 flags;
  ox_f32 box_centre[3];
  ox_f32 box_half[3];
  ox_f32 grid_origin[3];
  ox_f32 grid_scale[3];  // cells per metre
  ox_f32 extent;         // largest distance of a box corner from the local origin
  ox_f32 radius;         // of the vertices about the box's centre
  ox_f32 block_side;     // shortest side of a block of the clearance grid
} ox_mesh;
OX_STATIC_ASSERT(sizeof(ox_mesh) == 104, ox_mesh_is_104_bytes);

typedef struct {
  ox_f32 position[3];
  ox_f32 exit;          // [m] along `direction` to where the ray leaves its own mesh; inf: never
  ox_f32 direction[3];  // -normal, unit; 0: this vertex casts no ray
  ox_u32 padding;
} ox_vertex;
OX_STATIC_ASSERT(sizeof(ox_vertex) == 32, ox_vertex_is_32_bytes);

typedef struct {
  ox_u32 first, count;  // vertices, index into all of them
  ox_f32 centre[3];
  ox_f32 half_size[3];
  ox_f32 radius;  // of the box about its centre
  ox_f32 reach;   // largest finite exit of its vertices
  ox_u32 padding[2];
} ox_chunk;
OX_STATIC_ASSERT(sizeof(ox_chunk) == 48, ox_chunk_is_48_bytes);

typedef struct {
  ox_f32 lo[3];
  ox_u32 skip;
  ox_f32 hi[3];
  ox_u32 leaf;  // 0, or first << 3 | count; both links count from the mesh's first node / triangle
} ox_node;
OX_STATIC_ASSERT(sizeof(ox_node) == 32, ox_node_is_32_bytes);

// In the order of the leaves. Triangles of no area have three equal corners here: no ray hits them.
typedef struct {
  ox_f32 a[3];
  ox_u32 id;  // breaks ties of distance
  ox_f32 b[3];
  ox_u32 padding0;
  ox_f32 c[3];
  ox_u32 padding1;
  ox_f32 normal[3];  // unit, outward
  ox_u32 padding2;
} ox_triangle;
OX_STATIC_ASSERT(sizeof(ox_triangle) == 64, ox_triangle_is_64_bytes);

// What the pair step finds for a pair of objects A = object[0], B = object[1]. Side 0 takes points
// of A into the frame of B, side 1 points of B into the frame of A: target = rotation[side] *
// source + offset[side]. rotation[1] is the transpose of rotation[0].
typedef struct {
  ox_f32 rotation[2][9];
  ox_f32 offset[2][3];
  ox_f32 epsilon;  // [m] what rounding can do to a coordinate of this pair
  ox_u32 mesh[2];
  ox_u32 padding;
} ox_pair;
OX_STATIC_ASSERT(sizeof(ox_pair) == 112, ox_pair_is_112_bytes);

// pair_side = pair << 1 | side; side 0: vertices of A against B, side 1: of B against A.
typedef struct {
  ox_u32 pair_side;
  ox_u32 chunk;
} ox_chunk_task;
OX_STATIC_ASSERT(sizeof(ox_chunk_task) == 8, ox_chunk_task_is_8_bytes);

typedef struct {
  ox_u32 pair_side;
  ox_u32 vertex;
} ox_ray;
OX_STATIC_ASSERT(sizeof(ox_ray) == 8, ox_ray_is_8_bytes);

#define OX_HIT_INSIDE 0u    // met within the source's own exit
#define OX_HIT_FALLBACK 1u  // inside a closed target, but beyond the source's own exit
#define OX_HIT_TOUCHING 2u  // on the surface, depth 0

typedef struct {
  ox_u32 pair_side;
  ox_u32 vertex;
  ox_u32 triangle;  // index into all triangles, in the order of the leaves
  ox_u32 kind;      // OX_HIT_...
  ox_f32 depth;     // [m] to the plane of the triangle
  ox_f32 t;         // [m] along the ray
  ox_u32 slot;      // how many hits of this pair were appended before it
  ox_u32 padding;
} ox_hit;
OX_STATIC_ASSERT(sizeof(ox_hit) == 32, ox_hit_is_32_bytes);

// A hit among those of its pair, in the frame of B.
typedef struct {
  ox_f32 position[3];
  ox_f32 depth;
  ox_f32 normal[3];  // into A
  ox_f32 t;
  ox_u32 side_kind;  // side << 2 | kind
  ox_u32 vertex;
  ox_u32 triangle;
  ox_u32 patch;      // OX_NO_PATCH, a patch, or OX_TAKEN
  ox_f32 distance2;  // [m^2] to the nearest contact already taken from its patch
  ox_u32 padding[3];
} ox_candidate;
OX_STATIC_ASSERT(sizeof(ox_candidate) == 64, ox_candidate_is_64_bytes);

typedef struct {
  ox_u32 side;
  ox_u32 vertex;
  ox_u32 triangle;
  ox_f32 depth;
} ox_contact;
OX_STATIC_ASSERT(sizeof(ox_contact) == 16, ox_contact_is_16_bytes);

// The contacts of a pair: `count` from `first` on. first is meaningless where count is 0.
typedef struct {
  ox_u32 first;
  ox_u32 count;
} ox_range;
OX_STATIC_ASSERT(sizeof(ox_range) == 8, ox_range_is_8_bytes);

#endif
