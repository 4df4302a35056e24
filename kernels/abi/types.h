// SPDX-License-Identifier: BSD-3-Clause
// What host and device both read and write: counters, buffer records. Compiled by both sides, so
// only 32-bit scalars and arrays of them, with explicit padding.
#ifndef ODE_EXT_KERNELS_ABI_TYPES_H
#define ODE_EXT_KERNELS_ABI_TYPES_H

#ifdef __OPENCL_C_VERSION__
// A fused multiply-subtract is not antisymmetric: two triangles would disagree about the side of
// their shared edge on which a ray passes, and it would slip through. Holds to the end of the
// program.
#pragma OPENCL FP_CONTRACT OFF
typedef uint ox_u32;
typedef float ox_f32;
#define OX_STATIC_ASSERT(condition, name) typedef char name[(condition) ? 1 : -1]
#ifdef cl_intel_vec_len_hint
// Intel's CPU runtime packs work-items into vectors unless a kernel asks it not to. Ours branch,
// each its own way: packed they take six times as long to build, at every start, and four times as
// long to run.
#define __kernel __attribute__((intel_vec_len_hint(1))) __kernel
#endif
#else
#include <cstdint>
typedef std::uint32_t ox_u32;
typedef float ox_f32;
#define OX_STATIC_ASSERT(condition, name) static_assert(condition, #name)
#endif

// Counters live in one buffer, each on a cache line of its own. The first are those of the append
// lists; a counter runs on past the capacity of its list: that is how overflow is seen.
#define OX_COUNTER_STRIDE 16u
#define OX_LIST_CHUNKS_SMALL 0u       // paper: of rigid pairs that moved little
#define OX_LIST_CHUNKS 1u             // paper: of rigid pairs that moved far, or are new
#define OX_LIST_CHUNKS_DEFORMABLE 2u  // paper: of pairs with a deformable mesh
#define OX_LIST_RAYS_ITERATIVE 3u     // paper
#define OX_LIST_RAYS 4u               // cast in full
#define OX_LIST_RAYS_BASIC 5u         // paper
#define OX_LIST_MESHLETS 6u           // each with a subtree of the other mesh that it can meet
#define OX_LIST_MESHLET_PAIRS 7u      // that can meet
#define OX_LIST_HITS 8u
#define OX_LIST_CROSSINGS 9u
#define OX_LIST_FLOOD_WORDS 10u  // room for finding the vertices inside, handed out in stretches
#define OX_LIST_CONTACTS 11u
#define OX_LIST_COUNT 12u
#define OX_COUNTER_BOUNDED 12u   // pairs whose bounding volumes overlap
#define OX_COUNTER_UNPROVEN 13u  // paper: iterative rays that had to be cast in full
#define OX_COUNTER_DROPPED 14u   // paper: vertices dropped for want of temporal data
#define OX_COUNTER_FEATURES 15u  // room for them handed out to pairs (kernels/contacts)
#define OX_COUNTER_REGIONS 16u
#define OX_QUEUE_FLOOD 17u  // how many items the work-items have taken (ox_next_item)
#define OX_QUEUE_REGIONS 18u
#define OX_QUEUE_REDUCE 19u
#define OX_QUEUE_PAIRS 20u
#define OX_COUNTER_LEFT 21u  // pairs that the whole step left to the kernels
#define OX_COUNTER_COUNT 22u
#define OX_COUNTER_WORDS (OX_COUNTER_COUNT * OX_COUNTER_STRIDE)
// More is not counted: a counter that ran past 2^32 would begin again.
#define OX_MOST_COUNTED 0x80000000u

// There are several of each: what the kernels count comes first, then what the work-items of
// whole_step.cl have counted together, then the share of each of them. Lists too: those of the
// kernels, then what one share has of each.
#define OX_COUNTERS_TOTALS 1u
#define OX_COUNTERS_SHARES 2u

// Lists of one kind of record share a buffer: this one has `capacity` records from `first` on.
typedef struct {
  ox_u32 first;
  ox_u32 capacity;
} ox_list;
OX_STATIC_ASSERT(sizeof(ox_list) == 8, ox_list_is_8_bytes);

// What a batch does (options.h). Whether rays are iterative at all is decided by whether pairs keep
// temporal data.
#define OX_MODE_PAPER 1u  // paper: where there is temporal data only rays that have some, as found
#define OX_MODE_BASIC 2u  // paper: deformable targets without their tree
#define OX_MODE_EDGES 4u  // crossings of edges are searched
#define OX_MODE_FLOOD 8u  // and tell which vertices are inside (lib/flooded.h)

#define OX_NONE 0xffffffffu

#define OX_CHUNK_VERTICES 16u

#define OX_LANES 16u          // triangles, and vertices, of a meshlet (mesh/meshlets.h)
#define OX_MESHLET_EDGES 32u  // edges of one

#define OX_MESH_CLOSED 1u
#define OX_MESH_DEFORMABLE 2u  // its vertices move: what depends on them is made on the device
#define OX_MESH_TWO_SIDED 4u   // deformable and open: a sheet, with no inside
#define OX_MESH_CONVEX 8u      // mesh/convex.h

// A geom of this batch. world = rotation * local + (hi + lo), rotation row-major; hi + lo is the
// position to twice the float precision, so that differences hold far from the origin, and
// rotation + rotation_rest the rotation, so that they can be turned.
typedef struct {
  ox_f32 rotation[9];
  ox_f32 rotation_rest[9];
  ox_f32 hi[3];
  ox_f32 lo[3];
  ox_u32 mesh;
} ox_object;
OX_STATIC_ASSERT(sizeof(ox_object) == 100, ox_object_is_100_bytes);

// A mesh: where its parts start in the concatenated arrays, and its bounds in its own frame [m].
typedef struct {
  ox_u32 chunk_first, chunk_count;
  ox_u32 triangle_first, triangle_count;
  ox_u32 meshlet_first, meshlet_count;
  ox_u32 meshlet_node_first, meshlet_node_count;
  ox_u32 component_count;  // parts that no edge joins
  ox_u32 flat_edge_first;  // its edges from here on, over all meshes, are within facets
  ox_u32 flags;
  ox_f32 box_centre[3];
  ox_f32 box_half[3];
  ox_f32 extent;       // largest distance of a box corner from the local origin
  ox_f32 radius;       // of the vertices about the box's centre
  ox_f32 mean_edge;    // [m]
  ox_f32 reach;        // of an open mesh: the longest ray of its vertices; 0: closed [m]
  ox_f32 moved;        // the farthest a vertex went in its own frame at the last deformation [m]
  ox_f32 vector_area;  // of an open mesh that keeps its shape: its length over the area [1]
} ox_mesh;
OX_STATIC_ASSERT(sizeof(ox_mesh) == 92, ox_mesh_is_92_bytes);

typedef struct {
  ox_f32 position[3];
  ox_f32 exit;          // [m] along `direction` to where the ray leaves its own mesh; inf: never
  ox_f32 direction[3];  // -normal, unit; 0: this vertex casts no ray
  ox_f32 moved;         // how far it went in its own frame at the last deformation [m]
} ox_vertex;
OX_STATIC_ASSERT(sizeof(ox_vertex) == 32, ox_vertex_is_32_bytes);

// A run of vertices.
typedef struct {
  ox_u32 first, count;  // index into all of them
  ox_f32 centre[3];
  ox_f32 half_size[3];
  ox_f32 reach;      // largest finite exit of its vertices
  ox_f32 moved;      // the farthest one of them went in its own frame at the last deformation [m]
  ox_u32 is_joined;  // whether edges lead from each of them to each without leaving the run
  ox_u32 padding;
} ox_chunk;
OX_STATIC_ASSERT(sizeof(ox_chunk) == 48, ox_chunk_is_48_bytes);

// An edge; those within a facet come last. All indices count over all meshes.
typedef struct {
  ox_u32 vertex[2];
  ox_u32 triangle[2];  // at it; the second is OX_NONE at a border
} ox_edge;
OX_STATIC_ASSERT(sizeof(ox_edge) == 16, ox_edge_is_16_bytes);

// At a vertex: another, and the edge to it. Over all meshes.
typedef struct {
  ox_u32 vertex;
  ox_u32 edge;
} ox_neighbour;
OX_STATIC_ASSERT(sizeof(ox_neighbour) == 8, ox_neighbour_is_8_bytes);

// A meshlet (mesh/meshlets.h), component by component, as sixteen lanes want it. All indices
// count over all meshes. Lanes beyond the vertices repeat the first, indices too.
typedef struct {
  // What is asked of every meshlet that may meet another, together,
  ox_f32 vertex[3][OX_LANES];  // x, y, z
  ox_f32 lo[3], hi[3];         // of its vertices
  ox_f32 slab_normal[3];       // unit, or 0: the mean of its triangles' by area
  ox_f32 slab_lo, slab_hi;     // [m] along it, of its vertices
  ox_u32 triangle_count, edge_count;
  ox_u32 with_area;                   // a bit for each triangle that has one in the present shape
  ox_u32 ends[OX_MESHLET_EDGES / 2];  // places in `vertex`; of edge e OX_END(ends, e, 0) and 1
  ox_u32 firsts;  // a bit for each vertex that is the first of a part of the mesh; here alone
  ox_u32 padding;
  // of those that do,
  ox_f32 normal[3][OX_LANES];  // of the vertices, unit, or 0 where none is known
  ox_u32 places[OX_LANES];     // of the corners of each triangle in `vertex`: OX_CORNER_SHIFT
  // and of edges that cross it.
  ox_u32 edge[OX_MESHLET_EDGES];
  ox_u32 vertex_index[OX_LANES];
  ox_u32 triangle[OX_LANES];
} ox_meshlet;
OX_STATIC_ASSERT(sizeof(ox_meshlet) == 832, ox_meshlet_is_832_bytes);
// Its lanes lie on boundaries of 64 bytes, sixteen floats: `vertex` at 0, `normal` at 320.
OX_STATIC_ASSERT(sizeof(ox_meshlet) % 64 == 0, ox_meshlets_are_aligned);

// Where edge e of a meshlet begins or ends: eight bits each, two edges a word.
#define OX_END_SHIFT(e, end) (16u * ((e)&1u) + 8u * (end))
#define OX_END(ends, e, end) ((ends)[(e) / 2u] >> OX_END_SHIFT(e, end) & 255u)

// Where corner 0, 1 or 2 is, eight bits each; all 0 beyond the triangles.
#define OX_CORNER_SHIFT(corner) (8u * (corner))

// A meshlet that can meet what is in a subtree of the other mesh of its pair. Of each pair they are
// those of one mesh, and no two subtrees of one share anything. Those of a block (lib/lanes.h) that
// together meet more than OX_MOST_SUBTREES are listed with the whole tree, as are one or two alone.
typedef struct {
  ox_u32 pair_side;
  ox_u32 meshlet;
  ox_u32 subtree;  // its root, as a child of another node
} ox_meshlet_task;
OX_STATIC_ASSERT(sizeof(ox_meshlet_task) == 12, ox_meshlet_task_is_12_bytes);
#define OX_MOST_SUBTREES 16u

// Two meshlets, one of each mesh of a pair, that can meet.
typedef struct {
  ox_u32 pair;
  ox_u32 meshlet[2];  // of mesh A, of mesh B
  ox_u32 padding;
} ox_meshlet_pair;
OX_STATIC_ASSERT(sizeof(ox_meshlet_pair) == 16, ox_meshlet_pair_is_16_bytes);

// Children still to be gone through on the way down a tree, at most (mesh/meshlet_tree.h).
#define OX_TREE_STACK 96u

// A node over meshlets: the boxes of its children, widened by what the rounding of a ray's slabs
// can do; lanes beyond `count` have boxes that nothing finite meets. Child k holds the meshlets
// from first[k] up to first[k + 1]. Nodes and meshlets count from the mesh's first.
typedef struct {
  ox_f32 lo[3][OX_LANES];
  ox_f32 hi[3][OX_LANES];
  ox_u32 child[OX_LANES];  // node << 1, or meshlet << 1 | OX_CHILD_MESHLET
  ox_u32 first[OX_LANES + 1];
  ox_u32 count;
  ox_u32 padding[14];
} ox_meshlet_node;
OX_STATIC_ASSERT(sizeof(ox_meshlet_node) == 576, ox_meshlet_node_is_576_bytes);
OX_STATIC_ASSERT(sizeof(ox_meshlet_node) % 64 == 0, ox_meshlet_nodes_are_aligned);

#define OX_CHILD_MESHLET 1u
#define OX_TREE_ROOT 0u  // as a child

// In the order of MeshTopology::triangles, which neither the program's listing of a rigid mesh
// decides nor the shape that a deformable one was first met in: so ties may go by it. Triangles of
// no area have three equal corners here: no ray hits them. At a side there is an edge, or within a
// facet OX_WITHIN_FACET | the triangle across it, or OX_NONE (mesh/edges.h), over all meshes.
typedef struct {
  ox_f32 a[3];
  ox_u32 facet;  // its number within the mesh (mesh/facets.h)
  ox_f32 b[3];
  ox_u32 side_ab;
  ox_f32 c[3];
  ox_u32 side_bc;
  ox_f32 normal[3];  // unit, outward
  ox_u32 side_ca;
} ox_triangle;
#define OX_WITHIN_FACET 0x80000000u
OX_STATIC_ASSERT(sizeof(ox_triangle) == 64, ox_triangle_is_64_bytes);

// What the pair step finds for a pair of objects A = object[0], B = object[1]; displacements are
// found by paper/chunk_tasks.cl. Side 0 takes points of A into the frame of B, side 1 points of B
// into the frame of A: target = rotation[side] * source + offset[side]. rotation[1] is the
// transpose of rotation[0].
//
// That is as good as floats are over all of both meshes. Of what is compared closely coordinates
// are taken from a base in the frame of each mesh: of one that is much larger than the other, from
// where the other lies; mostly from the origin. (target - base[1 - side]) = rotation[side] *
// (source - base[side]) + base_offset[side].
typedef struct {
  ox_f32 rotation[2][9];
  ox_f32 offset[2][3];
  ox_f32 base[2][3];
  ox_f32 base_offset[2][3];
  ox_f32 epsilon;  // [m] what rounding can do to a coordinate from the base
  ox_u32 mesh[2];
  // Paper: [m] per side, how far a vertex of the source moved in the frame of the target at most
  // since the last pass; infinite: not known.
  ox_f32 displacement[2];
  ox_u32 near;    // whether the oriented boxes of the meshes overlap; else the rest may be void
  ox_f32 margin;  // [m] what is farther apart by coordinates from the origins does not meet
  ox_f32 snap;    // lib/general_position.h
} ox_pair;
OX_STATIC_ASSERT(sizeof(ox_pair) == 176, ox_pair_is_176_bytes);

// What has been found of a pair so far.
typedef struct {
  ox_u32 head[2];   // per side the last of its crossings, which links lead on from; OX_NONE: none
  ox_u32 features;  // how many; the first of its members and candidates is
  ox_u32 first;     // this, void where there are no features
  ox_u32 placed;    // of its members, so far
  ox_u32 candidates;
  ox_u32 at_border[2];  // per side whether one of those crossings is of an edge at its border
  ox_u32 is_below[2];   // per side whether all of it is just below the other (lib/below_ground.h)
  ox_u32 sheet_side;    // OX_SHEET_...: of a sheet and another mesh, where that is
} ox_found;
OX_STATIC_ASSERT(sizeof(ox_found) == 44, ox_found_is_44_bytes);

#define OX_SHEET_UNTOLD 0u  // or the pair is no such
#define OX_SHEET_FRONT 1u   // in front of the faces of the sheet
#define OX_SHEET_BACK 2u

// Vertices to be looked at. pair_side = pair << 1 | side; side 0: vertices of A against B, side 1:
// of B against A. The last two fields are the paper's (abi/paper.h).
typedef struct {
  ox_u32 pair_side;
  ox_u32 chunk;
  ox_u32 previous;
  ox_u32 category;
} ox_chunk_task;
OX_STATIC_ASSERT(sizeof(ox_chunk_task) == 16, ox_chunk_task_is_16_bytes);

// Of a vertex. The last two fields are the paper's (abi/paper.h); the product's are OX_RAY_...
// and `from` of ox_hit.
typedef struct {
  ox_u32 pair_side;
  ox_u32 vertex;
  ox_u32 memory;
  ox_u32 triangle;
} ox_ray;
OX_STATIC_ASSERT(sizeof(ox_ray) == 16, ox_ray_is_16_bytes);

// `memory` of a ray of the product. Its vertex is inside where the ray says so; or it is, whatever
// the ray meets; or it is, of a part of its mesh that no crossing tells of, so that nothing but its
// vertices says where the surface is; or it is behind an open mesh, as far as that goes on; or it
// is behind one no deeper than the rays of others reach, or beyond its border.
#define OX_RAY_ASKING 0u
#define OX_RAY_INSIDE 1u
#define OX_RAY_CONTAINED 2u
#define OX_RAY_BEHIND 3u
#define OX_RAY_REACHED 4u

#define OX_HIT_INSIDE 0u    // met within the source's own exit
#define OX_HIT_FALLBACK 1u  // inside a closed target, but beyond the source's own exit
#define OX_HIT_TOUCHING 2u  // on the surface, not known to be inside
#define OX_HIT_NONE 3u
#define OX_HIT_KIND 3u
#define OX_HIT_REVERSED 4u  // the triangle's normal is to be turned: met from the other side
#define OX_HIT_SIDE 8u      // of side 1
#define OX_HIT_POINT 16u    // not of a vertex: position and normal are its own,
#define OX_HIT_IN_A 32u     // the position in the frame of A, not of B

// A vertex that is inside, and what its ray meets.
typedef struct {
  ox_u32 pair_side;
  ox_u32 vertex;
  ox_u32 triangle;  // index into all triangles; OX_NONE: none is known
  ox_u32 kind;      // OX_HIT_..., with OX_HIT_REVERSED
  ox_f32 depth;     // [m] to the plane of the triangle
  ox_f32 t;         // [m] along the ray, or along `edge`
  // A vertex that it hangs together with inside, one for all that do, perhaps itself; OX_NONE: no
  // flood tells.
  ox_u32 from;
  // Of a vertex beyond the border of an open mesh: along which of its edges there is a place below
  // that, `t` from the vertex, which stands for it; else OX_NONE.
  ox_u32 edge;
} ox_hit;
OX_STATIC_ASSERT(sizeof(ox_hit) == 32, ox_hit_is_32_bytes);

// Where an edge of one mesh crosses the surface of the other, as it is found.
typedef struct {
  ox_u32 pair_side;
  ox_u32 edge;
  ox_u32 triangle;  // crossed, over all triangles
  ox_f32 t;         // [m] along the edge, from its first vertex
  ox_f32 blur;      // [m] what rounding may have moved it along the edge
  ox_u32 leaves;    // whether the edge leaves the target here: a back face
  ox_u32 before;    // of flooded sides and pairs with a sheet: that of the side found before it
  ox_u32 of_edge;   // and, in the flood, another of the same edge; OX_NONE: there is none
} ox_edge_crossing;
OX_STATIC_ASSERT(sizeof(ox_edge_crossing) == 32, ox_edge_crossing_is_32_bytes);

// What a contact is of in a mesh: a kind, and which over all meshes. Indices are below 2^30: no
// device has room for as many.
#define OX_OF_VERTEX 1u
#define OX_OF_EDGE 2u
#define OX_OF_FACET 3u  // as one of its triangles
#define OX_OF_SHIFT 30u
#define OX_OF(kind, index) ((kind) << OX_OF_SHIFT | (index))

// What tells regions of overlap apart: which it is, and whether the surfaces cross in it.
#define OX_REGION_CROSSED 1u
#define OX_REGION_KEY(index, flags) ((index) << 1 | ((flags)&OX_REGION_CROSSED))

typedef struct {
  ox_u32 side_kind;  // as of a candidate (abi/contacts.h), and so are the others
  ox_u32 vertex;
  ox_u32 triangle;
  ox_f32 depth;
  ox_f32 position[3];
  ox_f32 normal[3];  // in the frame of B
  ox_u32 feature[2];
  ox_u32 region;  // OX_REGION_KEY: which contacts of a pair are of one. Numbers are as they come
} ox_contact;
OX_STATIC_ASSERT(sizeof(ox_contact) == 52, ox_contact_is_52_bytes);

// The contacts of a pair: `count` from `first` on. first is meaningless where count is 0.
typedef struct {
  ox_u32 first;
  ox_u32 count;
  ox_u32 features;  // that the pair has: how long it takes goes by them
} ox_range;
OX_STATIC_ASSERT(sizeof(ox_range) == 12, ox_range_is_12_bytes);

#endif
