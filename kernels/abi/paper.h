// SPDX-License-Identifier: BSD-3-Clause
// What host and device both read and write of the paper's pipeline alone: temporal data, work. As
// abi/types.h.
#ifndef ODE_EXT_KERNELS_ABI_PAPER_H
#define ODE_EXT_KERNELS_ABI_PAPER_H

#include "abi/types.h"

// Where the temporal data of a pair are (paper/temporal_cache.h). OX_NONE as pose: nowhere.
typedef struct {
  ox_u32 pose;          // the number of its pose in the last pass
  ox_u32 directory[2];  // per side its first directory entry, one per chunk of the source
  ox_u32 known;         // whether the last pass left anything there
} ox_link;
OX_STATIC_ASSERT(sizeof(ox_link) == 16, ox_link_is_16_bytes);

// The relative pose of a pair, as in ox_pair.
typedef struct {
  ox_f32 rotation[9];
  ox_f32 offset[2][3];
  ox_u32 pass;  // that wrote it
} ox_relative_pose;
OX_STATIC_ASSERT(sizeof(ox_relative_pose) == 64, ox_relative_pose_is_64_bytes);

// The temporal datum of a vertex.
typedef struct {
  ox_u32 triangle;  // met last, from the target's first on; or OX_NONE
  ox_f32 moved;     // [m] since it was last cast in full; kept with OX_MODE_PAPER only
} ox_temporal;
OX_STATIC_ASSERT(sizeof(ox_temporal) == 8, ox_temporal_is_8_bytes);

// The block of temporal data that a chunk had in a pass: OX_CHUNK_VERTICES of them.
typedef struct {
  ox_u32 block;
  ox_u32 pass;
} ox_directory_entry;
OX_STATIC_ASSERT(sizeof(ox_directory_entry) == 8, ox_directory_entry_is_8_bytes);

// Of an ox_chunk_task. Its block of temporal data has the task's own index; `previous` is the one
// that the chunk had in the last pass, or OX_NONE. OX_NONE as chunk: nothing to do (the monolithic
// organization keeps a place for every chunk). `category` is one of these,
#define OX_CATEGORY_SMALL OX_LIST_CHUNKS_SMALL
#define OX_CATEGORY_HIGH OX_LIST_CHUNKS
#define OX_CATEGORY_DEFORMABLE OX_LIST_CHUNKS_DEFORMABLE
#define OX_CATEGORY_MASK 3u
// and this, where the pair keeps temporal data.
#define OX_CATEGORY_REMEMBERED 4u

// Of an ox_ray: `memory` is where its temporal datum goes, `triangle` that of the last pass;
// OX_NONE: nowhere, none.

// What a work-item did, by algorithm, in units of about one box test.
typedef struct {
  ox_u32 vertex, iterative, bvh, basic;
} ox_work;
OX_STATIC_ASSERT(sizeof(ox_work) == 16, ox_work_is_16_bytes);

#endif
