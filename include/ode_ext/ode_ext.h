/* SPDX-License-Identifier: BSD-3-Clause */
/**
 * @file ode_ext.h
 * A batched trimesh-trimesh collider for the Open Dynamics Engine.
 *
 * All mesh pairs of a dSpaceCollide pass are gathered, collided together on an OpenCL device by
 * casting rays from the vertices of each mesh that are in the other (Lehericey, Gouranton, Arnaldi,
 * "GPU Ray-Traced Collision Detection: Fine Pipeline Reorganization", GRAPP 2015), and answered
 * from the near callback the program already has: its dCollide(mesh, mesh, ...) reads the batch.
 *
 *     dBatchColliderID collider = dBatchColliderCreate(NULL);       // after dInitODE2
 *     dBatchColliderSpaceCollide(collider, space, data, &near);  // was: dSpaceCollide(space, ...)
 *     dBatchColliderDestroy(collider);                              // before dCloseODE
 *
 * Contacts follow ODE: `pos` in world coordinates [m], `normal` a unit vector into g1, moving g1 by
 * depth * normal [m] clears the contact; `side1` / `side2` are the triangles of g1 / g2.
 *
 * An answer to a limit of K contacts is the first K of the pair's: the deepest first, then what
 * spreads best; of a deformable mesh the deepest, unless max_contacts_deformable is set.
 * CONTACTS_UNIMPORTANT (stop as soon as there are enough, for ODE's own collider) changes nothing:
 * the contacts are there when dCollide asks, and the same are returned.
 *
 * A contact of a vertex stands for all triangles that meet there, one of an edge for those at the
 * edge, one of a facet for one triangle; `side1` / `side2` name one of them. A program that has
 * set a dTriTriMergeCallback of a geom is asked for an index instead, when dCollide is answered, in
 * the calling thread: the triangles in ascending order, merge(geom, first, second), then
 * merge(geom, that answer, third) and so on.
 * The last answer, whatever it is, becomes the side. ODE's own collider calls it alike, for
 * contacts at one place; where there is no callback it gives -1, this library a triangle.
 * What a callback throws is caught: it becomes the last error and the callback counts as not made.
 *
 * ODE asks dTriCallback for other pairs only, never for two meshes. With params.triangle_callbacks
 * it is: a contact is left out where the callback of either geom, callback(geom, other, triangle),
 * returns 0 for each triangle that the contact stands for; triangles refused are merged with none.
 * The deepest of what remains comes first, the rest keeps its order. The contacts of a pair are
 * chosen before: ask for a larger max_contacts where much is refused. While ODE's own collider
 * stands in for a device that fails, it is not asked. dTriArrayCallback is never called for two
 * meshes, here as in ODE.
 *
 * Threads: one pass per collider at a time. Different colliders may run in different threads as far
 * as ODE itself allows it (each thread its own space and geoms; Debian's ODE shares one global mesh
 * cache, so no two threads may be inside ODE's own mesh colliders at once). Meshes of tens of
 * thousands of triangles are made by as many threads as there are processors, which are gone when
 * the call returns.
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

/** Creation parameters. Fill with dBatchColliderParamsInit, then change what you need. A later
    version may add some at the end: a program that was built before gets their defaults. */
typedef struct dBatchColliderParams {
  size_t struct_size; /**< sizeof(dBatchColliderParams), set by dBatchColliderParamsInit */
  const char *device; /**< as ODE_EXT_DEVICE: "platform:type:name", any part of it empty, platform
                             and name by a part of theirs in either case, type gpu, accelerator, cpu
                             or other; or a word in one of the names; or a number. NULL: the
                             environment, else the first that works of GPU, accelerator, CPU. Read
                             during dBatchColliderCreate only, as is `config` */
  int max_contacts;   /**< contacts kept per pair, 1..64 (default 16) */
  int max_contacts_deformable; /**< contacts kept per pair with a deformable mesh, 1..64; 0
                                      (default): all of them */
  dReal open_thickness;        /**< [m] how far vertices of an open mesh look for a surface behind
                                      them, and how thick sheets are; 0 (default): the mean edge
                                      length of the mesh. A closed body may be as deep behind an
                                      open surface as it goes itself */
  int trust_meshes;            /**< nonzero: meshes change only where the program says so through
                           dBatchColliderTriMeshDataUpdate / ...Destroyed; saves comparing every
                           mesh in every pass with what it was (default 0) */
  int triangle_callbacks; /**< nonzero: a mesh's dTriCallback may refuse contacts of mesh pairs (see
                                 above); 0 (default): as in ODE it is not asked */
  const char *config; /**< what serves the paper and tuning, "rays=full,organization=monolithic";
                                 what is not named keeps its default, as all does with NULL. The
                                 settings: dBatchConfigName, and `ode_ext-info --settings` */
} dBatchColliderParams;

/** The settings of params.config, numbered from 0: what one is called, its values
    ("full|iterative", or a range in words), its default, and what it does, a sentence.
    By default rays are cast of vertices inside, where crossings of edges tell which these are; with
    any other choice of rays, deformable_target, organization, misprediction, edges or count_work
    those of all vertices, as in the paper. README, "Modes", says how little that changes; workload,
    prediction and all numbers change no byte unless mispredictions are not redone.
    @return constant text, or NULL past the last */
ODE_EXT_API const char *dBatchConfigName(int index);
ODE_EXT_API const char *dBatchConfigValues(int index);  /**< its values */
ODE_EXT_API const char *dBatchConfigDefault(int index); /**< its default */
ODE_EXT_API const char *dBatchConfigMeaning(int index); /**< what it does */

/** @return 0 if dBatchColliderCreate would take this text as params.config, else -1, and the last
    error says what is wrong with it. NULL is no text, though dBatchColliderCreate takes it for
    defaults. A device may still refuse a work_group_size. */
ODE_EXT_API int dBatchConfigCheck(const char *config);

/** Sets struct_size and the defaults of a struct of that size: that of the header that the program
    was compiled with. NULL is ignored. */
ODE_EXT_API void dBatchColliderParamsInitSize(dBatchColliderParams *params, size_t struct_size);

/** Sets struct_size and the defaults. NULL is ignored. */
static inline void dBatchColliderParamsInit(dBatchColliderParams *params) {
  dBatchColliderParamsInitSize(params, sizeof(dBatchColliderParams));
}

/**
 * Creates a collider on an OpenCL 1.2 device and installs it as ODE's trimesh-trimesh collider.
 * Call after dInitODE2. A trimesh-trimesh override of the program's own is replaced; ODE has no
 * way to read it, so it is not restored later.
 * @param params NULL: defaults and environment (ODE_EXT_DEVICE, ODE_EXT_LOG, ODE_EXT_TRACE,
 *   ODE_EXT_CAPTURE)
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
 * @return 1 delivered; 0 nothing delivered, no callback was made (misprediction=backtrack);
 *         -1 error, no callback was made
 */
ODE_EXT_API int dBatchColliderSpaceCollide(dBatchColliderID collider, dSpaceID space, void *data,
                                           dNearCallback *callback);

/** dSpaceCollide2, batched in the same way. */
ODE_EXT_API int dBatchColliderSpaceCollide2(dBatchColliderID collider, dGeomID g1, dGeomID g2,
                                            void *data, dNearCallback *callback);

/**
 * Collides given mesh pairs without any space. Each geom must be a trimesh.
 * @param pairs           2 * pair_count geoms: pair i is (pairs[2i], pairs[2i+1])
 * @param flags           as dCollide: low 16 bits = contacts per pair at most (>= 1);
 *                        CONTACTS_UNIMPORTANT is allowed and changes nothing
 * @param contacts        pair i starts at index i * (flags & 0xffff); only these are written
 * @param skip            byte stride of `contacts`, >= sizeof(dContactGeom)
 * @param contact_counts  pair_count counts, written; may be NULL
 * @return the total number of contacts, or -1
 */
ODE_EXT_API int dBatchColliderCollidePairs(dBatchColliderID collider, const dGeomID *pairs,
                                           int pair_count, int flags, dContactGeom *contacts,
                                           int skip, int *contact_counts);

/** What a contact is of in a mesh: the two highest bits of a feature of its id. */
enum {
  dBatchFeatureNone = 0,   /**< not known; then all of the feature is 0 */
  dBatchFeatureVertex = 1, /**< a vertex */
  dBatchFeatureEdge = 2,   /**< an edge at which the surface bends, or ends */
  dBatchFeatureFacet = 3,  /**< a flat piece of surface, however many triangles it is cut into; of
                                a deformable mesh a triangle */
  dBatchFeatureShift = 30 /**< kind == feature >> dBatchFeatureShift; the bits below are a number */
};

/**
 * Of which feature of each mesh a contact is. A contact at a vertex is of the vertex and a facet,
 * one where an edge crosses a facet of the edge and the facet, one between two edges of both edges.
 * While the same features touch it has the same id, wherever the geoms go; no two contacts of a
 * pair have one id. Which features touch may change though little moves: of two faces that lie on
 * one another the plane of either may be taken, so that all contacts of theirs get other ids, and a
 * corner that hardly touches may be an edge's. A program that starts from the forces of the step
 * before takes those of the nearest contact where an id is new. Numbers are given within each mesh
 * when the collider first meets it, and stay until the mesh changes (a deformable mesh: until its
 * triangles do, or vertices of it meet or part). They depend on that mesh alone: not on other
 * meshes, on threads, or on the process.
 */
typedef struct dBatchContactId {
  unsigned feature1; /**< of the mesh of g1: exchanged arguments exchange the two */
  unsigned feature2; /**< of the mesh of g2 */
} dBatchContactId;

/**
 * Writes the ids of contacts that dCollide or dBatchColliderCollidePairs returned, to warm-start a
 * solver or to tell new contacts from old. The contacts may be of several pairs, in any order, and
 * others may be missing; those of a pair together and in the order in which they came are the
 * fastest. They are known by g1, g2, pos, normal and depth (those in one place by side1 and side2
 * too) as long as the collider knows the pair's answer: until the pair is collided anew or eight
 * passes have not met it, and where no passes are made at least until the next question. No
 * callback is made, and geoms may be gone. The id is none, both features dBatchFeatureNone, where a
 * contact was changed, came from ODE's own collider, is not of two meshes, or names a
 * dGeomTransform. A collider of 0 knows none.
 * @param contacts  `count` contacts
 * @param skip      byte stride of `contacts`, >= sizeof(dContactGeom); of dContact its size, with
 *                  contacts = &first->geom
 * @param ids       count ids, written
 * @return how many are known, or -1
 */
ODE_EXT_API int dBatchColliderGetContactIds(dBatchColliderID collider, const dContactGeom *contacts,
                                            int count, int skip, dBatchContactId *ids);

/** How two meshes overlap in a region. */
enum {
  dBatchOverlapNone = 0,        /**< not known */
  dBatchOverlapCrossing = 1,    /**< their surfaces cross */
  dBatchOverlapFirstInside = 2, /**< nothing crosses: a part of the mesh of g1, or all of it, is
                                     inside that of g2, or behind its faces if it is open */
  dBatchOverlapSecondInside = 3 /**< a part of the mesh of g2 is inside that of g1 */
};

/** In which region of overlap a contact is: what two meshes have in common may be of several
    pieces, each of which has a contact as far as max_contacts allows. */
typedef struct dBatchContactRegion {
  int region;  /**< number within the pair: 0 is that of the first of the pair's contacts, the
                    deepest, 1 that of the first in another, and so on, those among them that a
                    callback of the program refused; -1: not known. In the next pass a region may
                    have another number */
  int overlap; /**< dBatchOverlap...; exchanged arguments exchange the two that are inside */
} dBatchContactRegion;

/**
 * Writes the regions of contacts, to draw or to count in how many places bodies touch, and to tell
 * what is wholly inside something from what is partly so. Contacts are known as those that
 * dBatchColliderGetContactIds knows, and as long; costs nothing unless it is called. With
 * config "edges=off" crossings are not looked for, and all overlaps are dBatchOverlapNone.
 * @param contacts  `count` contacts
 * @param skip      byte stride of `contacts`, >= sizeof(dContactGeom)
 * @param regions   count regions, written
 * @return how many are known, or -1
 */
ODE_EXT_API int dBatchColliderGetContactRegions(dBatchColliderID collider,
                                                const dContactGeom *contacts, int count, int skip,
                                                dBatchContactRegion *regions);

/**
 * Writes into which meshlet, a cluster of up to 16 neighboring triangles that are collided at a
 * time, each triangle of a mesh was put, to draw them. The mesh is known from its first pass or
 * question on, as it was when last met, until it is announced to have changed or to be deformable,
 * or no pass meets it for a long time; the handle is not dereferenced. A collider of 0 knows none.
 * @param triangle_count  of the mesh: dGeomTriMeshGetTriangleCount of a geom of it
 * @param meshlets        triangle_count numbers from 0, written: neighbors have numbers near
 *                        one another. -1: not known, or two of the triangle's corners are in one
 *                        place
 * @return how many meshlets there are, 0 if the mesh is not known or has another number of
 *         triangles, or -1
 */
ODE_EXT_API int dBatchColliderGetMeshlets(dBatchColliderID collider, dTriMeshDataID data,
                                          int triangle_count, int *meshlets);

/**
 * Announces that the vertices of a mesh moved or that it was rebuilt (after the change, and after
 * dGeomTriMeshDataUpdate). Without the announcement the change is seen at the next pass, or the
 * next dCollide of the mesh by a thread that is in no pass, which reads the meshes that it is asked
 * of; within the callbacks of a pass only if the mesh is of other arrays now. With `trust_meshes`
 * it is not seen at all. All colliders are told, since any may be asked about the mesh: collider is
 * one that lives, or 0.
 */
ODE_EXT_API void dBatchColliderTriMeshDataUpdate(dBatchColliderID collider, dTriMeshDataID data);

/**
 * Announces that the vertices of a mesh move in most passes (nonzero) or rarely (0, the default).
 * A deformable mesh keeps what depends on its triangles alone while they stay the same; the rest
 * (normals, exits, bounds, BVH) is made anew on the device in every pass in which vertices moved.
 * Its normals are rounded otherwise than those of a rigid mesh, so contacts may differ in their
 * last bits. An open deformable mesh is a sheet with two sides: it pushes back from either. A
 * smaller mesh is on the side on which its middle is, where what it meets of the sheet faces about
 * one way; else each vertex leaves by the nearer side (docs/meshes.md).
 * ODE takes the bounding box of a mesh when it is built, and never again: build a mesh that will
 * move with two vertices at the corners of a box that holds every shape it can take, put them back,
 * and call dGeomTriMeshDataUpdate (dBatchStatusMeshLeftBox says when that box was too small).
 * The mark is of the collider alone, or with 0 of all that live: one that is created later is to be
 * told again. It goes by the handle: announce it with dBatchColliderTriMeshDataDestroyed when the
 * mesh is destroyed, or another that gets its address has it too.
 */
ODE_EXT_API void dBatchColliderTriMeshDataSetDeformable(dBatchColliderID collider,
                                                        dTriMeshDataID data, int deformable);

/** Announces that a mesh was or is about to be destroyed; its answers are forgotten. The handle is
    not dereferenced. All colliders are told, as of an update. */
ODE_EXT_API void dBatchColliderTriMeshDataDestroyed(dBatchColliderID collider, dTriMeshDataID data);

/** Status bits of the last pass. 0: all went well. */
enum {
  dBatchStatusRedone = 1 << 0,        /**< an append buffer was too small; it was grown and the pass
                                           redone: nothing was lost */
  dBatchStatusDeviceFailed = 1 << 1,  /**< the device failed, and ODE's own collider answers this
                                           pass; or it has no room for a pair by itself, and ODE's
                                           collider answers for that one: it is tried again some
                                           sixty passes later */
  dBatchStatusMeshRefused = 1 << 2,   /**< a mesh has a vertex that is not finite, or farther than
                                           2^36 m (6.9e10) from its origin, or is less than 2^-30 m
                                           (9.3e-10) across; its pairs get no contacts */
  dBatchStatusGatherSkipped = 1 << 3, /**< the space was known to hold no mesh pair */
  dBatchStatusMeshLeftBox = 1 << 4,   /**< a mesh has vertices outside of the box that ODE knows of
                                           it: pairs may go unnoticed by ODE's broad phase. Seen of
                                           meshes that it does report a pair of */
  dBatchStatusMissed = 1 << 5,        /**< misprediction=ignore: something was lost */
  dBatchStatusBacktracked = 1 << 6,   /**< misprediction=backtrack: nothing was delivered */
  dBatchStatusPoseRefused = 1 << 7    /**< a mesh's position is not finite, or beyond 1e36 m, or its
                                           matrix is off a rotation by more than 0.001 (else it
                                           is taken for the rotation it means); its pairs get no
                                           contacts */
};

/** @return the dBatchStatus... bits of the last pass, or -1 */
ODE_EXT_API int dBatchColliderGetStatus(dBatchColliderID collider);

/** @return the name of the collider's device, valid until the collider is destroyed, or NULL */
ODE_EXT_API const char *dBatchColliderGetDeviceName(dBatchColliderID collider);

/** What is timed in a pass, in the order of the pipeline. A version may add values between these;
    none is given another meaning. */
enum {
  dBatchStageGather = 10,     /**< finding the pairs (ODE's broad phase), host */
  dBatchStageMeshes = 20,     /**< poses; comparing, and rebuilding the meshes that changed, host */
  dBatchStageDeformStep = 30, /**< kernels that follow moved vertices, from device events, as are
                                   the next thirteen */
  dBatchStagePairStep = 40,
  dBatchStageVertexStep = 50,    /**< of all categories */
  dBatchStageIterativeRays = 60, /**< ray step, by algorithm */
  dBatchStageBvhRays = 70,
  dBatchStageBasicRays = 80,
  dBatchStageMonolithic = 90, /**< vertex and ray step in one (organization=monolithic) */
  dBatchStageCull = 100,      /**< crossings of edges: which meshlets can meet the other mesh, */
  dBatchStageMatch = 110,     /**< which of those can meet one another, */
  dBatchStageCross = 120,     /**< where edges cross triangles */
  dBatchStageFlood = 130,     /**< which vertices are inside, by where edges cross */
  dBatchStageAssembly = 140,  /**< of crossings and vertices inside: regions, planes, candidates */
  dBatchStageContactStep = 150, /**< of the candidates the few that are contacts */
  dBatchStageWholeStep = 160,   /**< all of the above from the pair step on, of each pair that
                                     fits, by one work-item: on a processor */
  dBatchStageDevice = 500,      /**< first upload to last read-back, host clock */
  dBatchStageExport = 600,      /**< storing the answers, host */
  dBatchStagePass = 700         /**< the whole batch, without ODE's own pass and the callbacks */
};

/** What is counted. Of an append buffer the entries: add dBatchPredicted or dBatchCapacity to its
    value for what was expected and what there was room for. A version may add values between these;
    none is given another meaning. */
enum {
  /* of the last pass, which may be one that a callback made within another */
  dBatchCounterPairs = 0,          /**< mesh pairs gathered */
  dBatchCounterPairsComputed = 1,  /**< of those, computed now (the others had a valid answer) */
  dBatchCounterPairsColliding = 2, /**< of those gathered, with at least one contact; of pairs that
                                      the program does not ask for, as far as it is still known */
  dBatchCounterPairsBounded = 3,   /**< of those computed, whose bounding volumes overlap */
  dBatchCounterRedone = 20,        /**< how often the pass was redone for larger buffers */
  dBatchCounterSynchronizations = 21, /**< waits for the device */
  dBatchCounterMissed = 40, /**< misprediction=ignore: entries that did not fit, all buffers */
  dBatchCounterIterativeUnproven = 41, /**< iterative rays that were cast in full after all */
  dBatchCounterDropped = 42,       /**< rays=iterative-paper: vertices dropped for want of temporal
                                   data */
  dBatchCounterTemporalPairs = 43, /**< pairs whose temporal data is kept */
  dBatchCounterDeformed = 44,      /**< meshes whose vertices moved since the pass before */
  /* since creation */
  dBatchCounterPasses = 60,     /**< passes */
  dBatchCounterPairsAlone = 61, /**< pairs asked for that no pass had computed */
  dBatchCounterPairsStock = 62, /**< pairs answered by ODE's own collider */
  dBatchCounterMeshes = 63,     /**< meshes known now */
  /* Append buffers of the last pass, in the order of the pipeline. pair step or flood -> vertex
     step: chunks of up to 16 vertices; where rays are of all vertices (as in the paper) by the
     category of their pair, else all in the second */
  dBatchBufferChunksSmall = 1000,      /**< rigid, small displacement */
  dBatchBufferChunksHigh = 1010,       /**< rigid, high displacement; or all */
  dBatchBufferChunksDeformable = 1020, /**< one of the two is deformable */
  /* vertex step -> ray step, by algorithm */
  dBatchBufferRaysIterative = 1030, /**< from the triangle met last */
  dBatchBufferRaysBvh = 1040,       /**< BVH traversal; also what iterative rays hand on */
  dBatchBufferRaysBasic = 1050,     /**< every triangle */
  /* cull -> match -> cross */
  dBatchBufferMeshlets = 1060,     /**< clusters of triangles, each with a subtree of the other
                                      that it can meet */
  dBatchBufferMeshletPairs = 1070, /**< that can meet one another; without loss or redoing those
                                        beyond the capacity are crossed at once */
  /* ray step, cross -> contact step */
  dBatchBufferHits = 1080,      /**< of vertex rays */
  dBatchBufferCrossings = 1090, /**< of edges with triangles */
  /* in flood */
  dBatchBufferFloodWords = 1100, /**< 32-bit words of room for finding the vertices inside */
  dBatchBufferContacts = 1110,   /**< contact step -> host */
  /* to be added to a buffer */
  dBatchActual = 0,    /**< entries produced */
  dBatchPredicted = 1, /**< entries expected */
  dBatchCapacity = 2   /**< entries there was room for at a time: on a processor pairs follow one
                            another in the same room, so of all but contacts there may be more */
};

/** The work of a kernel with count_work=on, in units of about one box test: a node visited and
    an entry of a task 1 each, a vertex looked at and a triangle tested 2 each. In lockstep a group
    of work-items takes as long as its longest, and one branch after the other where they take
    different ones. */
enum {
  dBatchWorkItems = 0,      /**< work-items that had input */
  dBatchWorkUnits = 1,      /**< what they did, all together */
  dBatchWorkLockstep32 = 2, /**< what groups of 32 in lockstep are busy for, times 32 */
  dBatchWorkLockstep64 = 3  /**< the same for groups of 64 */
};

/** @return what a stage (dBatchStage...) of the last pass took [ms], or -1 */
ODE_EXT_API double dBatchColliderGetTime(dBatchColliderID collider, int stage);

/** @param counter  a dBatchCounter..., or a dBatchBuffer... + dBatchPredicted, ...
    @return the count, or -1 */
ODE_EXT_API long long dBatchColliderGetCount(dBatchColliderID collider, int counter);

/** @param stage     the vertex step, one of the three of rays, or monolithic
    @param quantity  dBatchWork...
    @return of the last pass, 0 without count_work=on, or -1 */
ODE_EXT_API long long dBatchColliderGetWork(dBatchColliderID collider, int stage, int quantity);

/** @return the name of a stage, "gather", or of a counter, "predicted_hits"; constant; NULL where
    there is none */
ODE_EXT_API const char *dBatchStageName(int stage);
ODE_EXT_API const char *dBatchCounterName(int counter); /**< likewise of a counter */

/** Walks over all that this version has: for (s = dBatchStageNext(-1); s >= 0; s =
    dBatchStageNext(s)). @return the least value above the one given, -1 after the last */
ODE_EXT_API int dBatchStageNext(int stage);
ODE_EXT_API int dBatchCounterNext(int counter); /**< likewise of counters */

/** What is known of a device. */
enum {
  dBatchDevicePlatform = 0, /**< texts: */
  dBatchDeviceName = 10,
  dBatchDeviceVendor = 20,
  dBatchDeviceType = 30, /**< "gpu", "accelerator", "cpu" or "other" */
  dBatchDeviceDriver = 40,
  dBatchDeviceVersion = 50, /**< of OpenCL */
  dBatchDeviceProblem = 60, /**< why no collider can use it: a sentence's end; "": none known */
  dBatchDeviceComputeUnits = 1000, /**< numbers: */
  dBatchDeviceMemory = 1010,       /**< [bytes] */
  dBatchDeviceLargestBuffer = 1020 /**< [bytes] */
};

/** Looks which OpenCL devices there are. The functions below tell of what the calling thread's last
    call found. Needs no collider. @return how many there are, or -1 */
ODE_EXT_API int dBatchDeviceCount(void);

/** @param device  0 to dBatchDeviceCount() - 1, the number that ODE_EXT_DEVICE takes
    @return a text of a device, valid until this thread's next dBatchDeviceCount; or NULL */
ODE_EXT_API const char *dBatchDeviceGetText(int device, int property);

/** @return a number of a device, or -1 */
ODE_EXT_API long long dBatchDeviceGetNumber(int device, int property);

/** @param selection  as ODE_EXT_DEVICE; NULL: the environment, else the default
    @return the device that a collider would be created on, or -1: the last error says why none */
ODE_EXT_API int dBatchDeviceChoose(const char *selection);

/**
 * Describes every OpenCL device in words, one a line, and marks the one that `selection` (as
 * ODE_EXT_DEVICE; NULL: the environment, else the default) chooses, and why. Needs no collider.
 * @return the length of the whole text without its terminator, at most size - 1 bytes of which are
 *         written; -1 and an empty text: see dBatchColliderGetLastErrorMessage
 */
ODE_EXT_API int dBatchColliderDescribeDevices(const char *selection, char *text, size_t size);

#ifdef __cplusplus
}
#endif

#endif
