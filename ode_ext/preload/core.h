/* SPDX-License-Identifier: BSD-3-Clause */
/* What the preload asks of the library, which is loaded only when a program lets meshes meet. The
   preload knows no precision; the library is there in either, in an object of its own. */
#ifndef ODE_EXT_PRELOAD_CORE_H
#define ODE_EXT_PRELOAD_CORE_H

#include <ode/ode.h>

#ifdef __cplusplus
extern "C" {
#endif

/* NOLINTBEGIN(modernize-*): C. */
typedef struct dxPreloadCore {
  /* A pass, of a space where `second` is NULL, else of two geoms. 0: ODE is to make it, nothing was
     done. */
  int (*collide)(dGeomID first, dGeomID second, void* data, dNearCallback* callback);
  /* Before two meshes meet in dCollide for the first time. */
  void (*meet)(void);
  /* After dInitODE, which forgets who collides meshes. */
  void (*initialized)(void);
  void (*mesh_changed)(dTriMeshDataID data);
  void (*mesh_destroyed)(dTriMeshDataID data);
  /* At the end of the program, to stderr. */
  void (*print_statistics)(void);
} dxPreloadCore;

/* Exported by either object. `find` gives a function of the program's ODE, or NULL.
   Returns NULL where that ODE lacks one, and names it. */
typedef const dxPreloadCore* dxPreloadCoreFn(void* (*find)(const char* name), const char** missing);
dxPreloadCoreFn ode_ext_preload_core;

/* Exported too, for ode_ext-run, in whose process there is no ODE: what is wrong with a
   dBatchColliderParams.config, valid until the next call; NULL: nothing. */
typedef const char* dxPreloadConfigFaultFn(const char* config);
dxPreloadConfigFaultFn ode_ext_preload_config_fault;
/* NOLINTEND(modernize-*) */

#ifdef __cplusplus
}
#endif

#endif
