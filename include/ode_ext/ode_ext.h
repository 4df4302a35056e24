/* SPDX-License-Identifier: BSD-3-Clause */
/**
 * @file ode_ext.h
 * A batched trimesh-trimesh collider for the Open Dynamics Engine.
 *
 * All mesh pairs of a dSpaceCollide pass are gathered, collided together on an OpenCL device by
 * casting rays from the vertices of each mesh at the other (Lehericey, Gouranton, Arnaldi, "GPU
 * Ray-Traced Collision Detection: Fine Pipeline Reorganization", GRAPP 2015), and answered from the
 * near callback the program already has: its dCollide(mesh, mesh, ...) reads the batch.
 *
 *     dBatchColliderID collider = dBatchColliderCreate(NULL);       // after dInitODE2
 *     dBatchColliderSpaceCollide(collider, space, data, &near);  // was: dSpaceCollide(space, ...)
 *     dBatchColliderDestroy(collider);                              // before dCloseODE
 *
 * Contacts follow ODE: `pos` in world coordinates [m], `normal` a unit vector into g1, moving g1 by
 * depth * normal [m] clears the contact; `side1` / `side2` are the triangles of g1 / g2.
 *
 * Threads: one pass per collider at a time. Different colliders may run in different threads as far
 * as ODE itself allows it (each thread its own space and geoms; Debian's ODE shares one global mesh
 * cache, so no two threads may be inside ODE's own mesh colliders at once).
 *
 * Errors: creators return 0, int functions -1; the sentence is in
 * dBatchColliderGetLastErrorMessage(). No function throws. ODE itself aborts where it is used
 * before dInitODE2 or after dCloseODE, and these functions then with it.
 */
#ifndef ODE_EXT_ODE_EXT_H
#define ODE_EXT_ODE_EXT_H

#include <ode/ode.h>
#include <stddef.h>

#include "export.h"
#include "version.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Handle of a collider. 0 is "none": the collide functions then do what plain ODE does. */
typedef struct dxBatchCollider *dBatchColliderID;

/** How many work-groups a kernel is launched with (GRAPP section 4.2). Never changes a result. */
enum {
  dBatchWorkloadPredicted =
      0,                  /**< predicted from the last pass; one read-back per pass (default) */
  dBatchWorkloadExact = 1 /**< the counter is read back before every launch */
};

/** How workloads and buffer sizes are predicted (GRAPP section 4.1). Never changes a result. */
enum {
  dBatchPredictionPairScaled = 0, /**< Eq. 1: last count * pairs now / pairs then * confidence */
  dBatchPredictionPlain = 1       /**< Eq. 2: last count * confidence */
};

/** Creation parameters. Fill with dBatchColliderParamsInit, then change what you need. */
typedef struct dBatchColliderParams {
  size_t struct_size;   /**< sizeof(dBatchColliderParams), set by dBatchColliderParamsInit */
  const char *device;   /**< as ODE_EXT_DEVICE; NULL: the environment, else GPU, accelerator, CPU.
                                Read during dBatchColliderCreate only. */
  int max_contacts;     /**< contacts kept per pair, 1..64 (default 16) */
  int workload;         /**< dBatchWorkload... */
  int prediction;       /**< dBatchPrediction... */
  int trust_meshes;     /**< nonzero: meshes change only where the program says so through
                                dBatchColliderTriMeshDataUpdate / ...Destroyed; saves hashing every
                                mesh in every pass (default 0) */
  dReal confidence;     /**< factor on predictions, > 0 (default 1.2). Below 1 costs time only */
  dReal open_thickness; /**< [m] how far below an open surface it is solid; 0 (default): the mean
                                edge length of the mesh */
  int work_group_size;  /**< work-items per work-group, 1..device limit; 0 (default): 64 */
  int initial_capacity; /**< entries of each append buffer at the start; 0: default (16384).
                                Buffers grow by themselves */
} dBatchColliderParams;

/** Sets struct_size and the defaults. NULL is ignored. */
ODE_EXT_API void dBatchColliderParamsInit(dBatchColliderParams *params);

/**
 * Creates a collider on an OpenCL 1.2 device and installs it as ODE's trimesh-trimesh collider.
 * Call after dInitODE2. A trimesh-trimesh override of the program's own is replaced; ODE has no
 * way to read it, so it is not restored later.
 * @param params NULL: defaults and environment (ODE_EXT_DEVICE, ODE_EXT_LOG, ODE_EXT_TRACE)
 * @return the collider, owned by the caller, or 0 (see dBatchColliderGetLastErrorMessage)
 */
ODE_EXT_API dBatchColliderID dBatchColliderCreate(const dBatchColliderParams *params);

/**
 * Destroys a collider. After the last one is gone mesh pairs go to ODE's own collider again.
 * Refused (with a message) while the collider's pass is running; 0 is ignored.
 */
ODE_EXT_API void dBatchColliderDestroy(dBatchColliderID collider);

/** The last error of this thread: one sentence, never NULL, "" if there was none. Valid until the
    next call of this library in this thread. */
ODE_EXT_API const char *dBatchColliderGetLastErrorMessage(void);

/**
 * dSpaceCollide, with all mesh pairs computed in one batch before the callbacks are made.
 * A collider of 0 means plain dSpaceCollide. Inside the callback and after the call
 * dCollide(mesh, mesh, ...) answers from the batch, in either argument order and any number of
 * times, until the poses or the meshes change.
 * @return 1 delivered, 0 nothing delivered, -1 error (no callback was made)
 */
ODE_EXT_API int dBatchColliderSpaceCollide(dBatchColliderID collider, dSpaceID space, void *data,
                                           dNearCallback *callback);

/** dSpaceCollide2, batched in the same way. */
ODE_EXT_API int dBatchColliderSpaceCollide2(dBatchColliderID collider, dGeomID g1, dGeomID g2,
                                            void *data, dNearCallback *callback);

/**
 * Collides given mesh pairs without any space. Each geom must be a trimesh.
 * @param pairs           2 * pair_count geoms: pair i is (pairs[2i], pairs[2i+1])
 * @param flags           as dCollide: low 16 bits = contacts per pair at most (>= 1)
 * @param contacts        pair i starts at index i * (flags & 0xffff); only these are written
 * @param skip            byte stride of `contacts`, >= sizeof(dContactGeom)
 * @param contact_counts  pair_count counts, written; may be NULL
 * @return the total number of contacts, or -1
 */
ODE_EXT_API int dBatchColliderCollidePairs(dBatchColliderID collider, const dGeomID *pairs,
                                           int pair_count, int flags, dContactGeom *contacts,
                                           int skip, int *contact_counts);

/**
 * Announces that the vertices of a mesh moved or that it was rebuilt (after the change, and after
 * dGeomTriMeshDataUpdate). Without the announcement the change is seen at the next pass, unless
 * `trust_meshes` is set. collider 0: all colliders.
 */
ODE_EXT_API void dBatchColliderTriMeshDataUpdate(dBatchColliderID collider, dTriMeshDataID data);

/** Announces that a mesh will change in most steps (nonzero) or rarely (0, the default): what pays
    off only over many steps is then not prepared. Contacts do not depend on it. */
ODE_EXT_API void dBatchColliderTriMeshDataSetDeformable(dBatchColliderID collider,
                                                        dTriMeshDataID data, int deformable);

/** Announces that a mesh was or is about to be destroyed; its answers are forgotten. The handle is
    not dereferenced. collider 0: all colliders. */
ODE_EXT_API void dBatchColliderTriMeshDataDestroyed(dBatchColliderID collider, dTriMeshDataID data);

/** Status bits of the last pass. 0: all went well. */
enum {
  dBatchStatusRedone = 1 << 0,       /**< an append buffer was too small; it was grown and the pass
                                           redone: nothing was lost */
  dBatchStatusDeviceFailed = 1 << 1, /**< the device failed; ODE's own collider answers this pass */
  dBatchStatusMeshRefused = 1 << 2,  /**< a mesh has vertices that are not finite; its pairs get no
                                           contacts */
  dBatchStatusGatherSkipped = 1 << 3 /**< the space was known to hold no mesh pair */
};

/** The append buffers, in the order of the pipeline (one between each two steps). */
enum {
  dBatchBufferChunks = 0,   /**< pair step -> vertex step: runs of up to 16 vertices */
  dBatchBufferRays = 1,     /**< vertex step -> ray step */
  dBatchBufferHits = 2,     /**< ray step -> contact step */
  dBatchBufferContacts = 3, /**< contact step -> host */
  dBatchBufferCount = 4
};

/** The timed stages of a pass. */
enum {
  dBatchStageGather = 0,   /**< finding the pairs (ODE's broad phase) and their poses, host */
  dBatchStageMeshes = 1,   /**< hashing, and rebuilding the meshes that changed, host */
  dBatchStagePairStep = 2, /**< kernel, from device events, as are the next three */
  dBatchStageVertexStep = 3,
  dBatchStageRayStep = 4,
  dBatchStageContactStep = 5,
  dBatchStageDevice = 6, /**< first upload to last read-back, host clock */
  dBatchStageExport = 7, /**< storing the answers, host */
  dBatchStagePass = 8,   /**< the whole batch, without ODE's own pass and the callbacks */
  dBatchStageCount = 9
};

/** What the last pass did. */
typedef struct dBatchColliderStats {
  size_t struct_size;        /**< set by the caller to sizeof(dBatchColliderStats) */
  unsigned status;           /**< dBatchStatus... bits of the last pass */
  int redone;                /**< how often the last pass was redone for larger buffers */
  int synchronizations;      /**< waits for the device in the last pass */
  long long pairs;           /**< mesh pairs gathered in the last pass */
  long long pairs_computed;  /**< of those, computed now (the others had a valid answer) */
  long long pairs_colliding; /**< of those gathered, with at least one contact */
  long long pairs_bounded;   /**< of those computed, whose bounding volumes overlap */
  long long predicted[dBatchBufferCount]; /**< entries expected */
  long long actual[dBatchBufferCount];    /**< entries produced */
  long long capacity[dBatchBufferCount];  /**< entries there was room for */
  double ms[dBatchStageCount];            /**< [ms] */
  long long passes;                       /**< passes since creation */
  long long pairs_alone; /**< since creation: pairs asked for that no pass had computed */
  long long pairs_stock; /**< since creation: pairs answered by ODE's own collider */
  int meshes;            /**< meshes known */
  char device[128];      /**< device name, null-terminated */
} dBatchColliderStats;

/** Fills stats (up to stats->struct_size bytes). Refuses an unknown collider with a message and
    zeroes. */
ODE_EXT_API void dBatchColliderGetStats(dBatchColliderID collider, dBatchColliderStats *stats);

/**
 * Describes every OpenCL device in words, one a line, and marks the one that `selection` (as
 * ODE_EXT_DEVICE; NULL: the environment, else the default) chooses, and why. Needs no collider.
 * @return the length of the whole text without its terminator; at most size - 1 bytes are written
 */
ODE_EXT_API int dBatchColliderDescribeDevices(const char *selection, char *text, size_t size);

#ifdef __cplusplus
}
#endif

#endif
