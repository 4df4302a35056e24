/* SPDX-License-Identifier: BSD-3-Clause */
/* Stands in front of a program's ODE (LD_PRELOAD): passes with meshes go to the library, which is
   loaded for the first of them, in the precision of that ODE. All else goes straight on. */
#include <dlfcn.h>
#include <ode/ode.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "preload/core.h"
#include "preload/find_ode.h"
#include "preload/redirect.h"
#include "preload/statistics.h"

#define EXPORTED __attribute__((visibility("default")))

/* The program's own. */
typedef struct {
#define INTERPOSED(name) __typeof__(&name) name;
#include "preload/interposed.h"
  __typeof__(&dGeomGetClass) class_of;
} Ode;

static Ode the_ode;
static const Ode* _Atomic ode; /* once it is found */
static const char* ode_path;
static const dxPreloadCore* _Atomic core;
static atomic_bool core_is_tried;
/* Mesh geoms that may be alive: where there are not two, nothing is to be done. */
static atomic_long mesh_geoms;

static void say(const char* text, const char* of, const char* more) {
  const char* level = getenv("ODE_EXT_LOG");
  if (level == NULL || strcmp(level, "off") != 0)
    fprintf(stderr, "ode_ext: %s%s%s; the program goes on with ODE's own collider\n", text, of,
            more);
}

static void find_ode(const void* caller) {
  static pthread_mutex_t one_at_a_time = PTHREAD_MUTEX_INITIALIZER;
  pthread_mutex_lock(&one_at_a_time);
  if (ode == NULL && (ode_path = ode_ext_find_ode(caller)) != NULL) {
#define INTERPOSED(name) the_ode.name = (__typeof__(the_ode.name))ode_ext_find_function(#name);
#include "preload/interposed.h"
    the_ode.class_of = (__typeof__(the_ode.class_of))ode_ext_find_function("dGeomGetClass");
    ode = &the_ode;
  }
  pthread_mutex_unlock(&one_at_a_time);
  if (ode == NULL) { /* whoever called had no ODE either */
    fputs("ode_ext: a function of ODE was called, and there is no ODE in this process\n", stderr);
    abort();
  }
}

/* The program's ODE, whoever called. */
#define ORIGINAL(name) (*original(__builtin_return_address(0))->name)
static inline const Ode* original(const void* caller) {
  if (ode == NULL) find_ode(caller);
  return ode;
}

/* For the library: it is not to find a function that was redirected. */
static void* find_function(const char* name) {
  return strcmp(name, "dSpaceCollide") == 0 ? (void*)the_ode.dSpaceCollide
                                            : ode_ext_find_function(name);
}

static void load_core(void) {
  if (dlsym(RTLD_DEFAULT, "dBatchColliderCreate") != NULL) {
    say("this program uses ode_ext by itself", "", "");
    return;
  }
  __typeof__(&dCheckConfiguration) configured =
      (__typeof__(configured))ode_ext_find_function("dCheckConfiguration");
  const char* precision = NULL;
  if (configured != NULL && configured("ODE_double_precision")) precision = "double";
  if (configured != NULL && configured("ODE_single_precision")) precision = "single";
  if (precision == NULL) {
    say("this ODE does not tell its precision", "", "");
    return;
  }
  char *directory = ode_ext_own_directory(), *path = NULL;
  if (directory == NULL || asprintf(&path, "%slibode_ext_preload_%s.so", directory, precision) < 0)
    path = NULL;
  void* library = path == NULL ? NULL : dlopen(path, RTLD_NOW | RTLD_LOCAL);
  if (library == NULL) {
    say(path == NULL ? "memory is short" : dlerror(), "", "");
  } else {
    const char* missing = NULL;
    dxPreloadCoreFn* start = (dxPreloadCoreFn*)dlsym(library, "ode_ext_preload_core");
    core = start(&find_function, &missing);
    if (core == NULL) say("this ODE has no ", missing, "");
  }
  free(path);
  free(directory);
}

/* The library, or NULL where it cannot be. */
static const dxPreloadCore* loaded_core(void) {
  static pthread_once_t once = PTHREAD_ONCE_INIT;
  if (!core_is_tried) {
    pthread_once(&once, &load_core);
    core_is_tried = true;
  }
  return core;
}

static int may_meshes_meet(void) { return mesh_geoms >= 2; }

static int is_mesh(dGeomID geom) {
  return the_ode.class_of != NULL && the_ode.class_of(geom) == dTriMeshClass;
}

/* --- passes --------------------------------------------------------------------------------- */

static int collide(dGeomID first, dGeomID second, void* data, dNearCallback* callback) {
  if (!may_meshes_meet() || callback == NULL || loaded_core() == NULL) return 0;
  return core->collide(first, second, data, callback);
}

static void collide_space(const Ode* original_ode, dSpaceID space, void* data,
                          dNearCallback* callback) {
  PASS_TIMER;
  if (space == NULL || !collide((dGeomID)space, NULL, data, callback))
    original_ode->dSpaceCollide(space, data, callback);
}

EXPORTED void dSpaceCollide(dSpaceID space, void* data, dNearCallback* callback) {
  collide_space(original(__builtin_return_address(0)), space, data, callback);
}

EXPORTED void dSpaceCollide2(dGeomID first, dGeomID second, void* data, dNearCallback* callback) {
  const Ode* original_ode = original(__builtin_return_address(0));
  PASS_TIMER;
  if (first == NULL || second == NULL || !collide(first, second, data, callback))
    original_ode->dSpaceCollide2(first, second, data, callback);
}

/* In a pass ODE asks the library by itself. What is met before any pass has to bring it in. */
EXPORTED int dCollide(dGeomID first, dGeomID second, int flags, dContactGeom* contacts, int skip) {
  static atomic_bool have_met;
  const Ode* original_ode = original(__builtin_return_address(0));
  if (may_meshes_meet() && !have_met && first != NULL && second != NULL && is_mesh(first) &&
      is_mesh(second)) {
    if (loaded_core() != NULL) core->meet();
    have_met = true;
  }
  return original_ode->dCollide(first, second, flags, contacts, skip);
}

/* --- what lives ----------------------------------------------------------------------------- */

EXPORTED void dInitODE(void) {
  ORIGINAL(dInitODE)();
  if (core != NULL) core->initialized();
}

EXPORTED int dInitODE2(unsigned flags) {
  const int result = ORIGINAL(dInitODE2)(flags);
  if (core != NULL) core->initialized();
  return result;
}

EXPORTED dGeomID dCreateTriMesh(dSpaceID space, dTriMeshDataID data, dTriCallback* callback,
                                dTriArrayCallback* array_callback, dTriRayCallback* ray_callback) {
  ++mesh_geoms;
  return ORIGINAL(dCreateTriMesh)(space, data, callback, array_callback, ray_callback);
}

/* A space may destroy its geoms by itself, so there may be fewer than are counted. */
EXPORTED void dGeomDestroy(dGeomID geom) {
  const Ode* original_ode = original(__builtin_return_address(0));
  if (mesh_geoms > 0 && geom != NULL && is_mesh(geom)) --mesh_geoms;
  original_ode->dGeomDestroy(geom);
}

static void changed(dTriMeshDataID data) {
  if (core != NULL && data != NULL) core->mesh_changed(data);
}

#define BUILD(name, parameters, arguments) \
  EXPORTED void name parameters {          \
    ORIGINAL(name) arguments;              \
    changed(data);                         \
  }

BUILD(dGeomTriMeshDataBuildSingle,
      (dTriMeshDataID data, const void* vertices, int vertex_stride, int vertex_count,
       const void* indices, int index_count, int triangle_stride),
      (data, vertices, vertex_stride, vertex_count, indices, index_count, triangle_stride))
BUILD(dGeomTriMeshDataBuildSingle1,
      (dTriMeshDataID data, const void* vertices, int vertex_stride, int vertex_count,
       const void* indices, int index_count, int triangle_stride, const void* normals),
      (data, vertices, vertex_stride, vertex_count, indices, index_count, triangle_stride, normals))
BUILD(dGeomTriMeshDataBuildDouble,
      (dTriMeshDataID data, const void* vertices, int vertex_stride, int vertex_count,
       const void* indices, int index_count, int triangle_stride),
      (data, vertices, vertex_stride, vertex_count, indices, index_count, triangle_stride))
BUILD(dGeomTriMeshDataBuildDouble1,
      (dTriMeshDataID data, const void* vertices, int vertex_stride, int vertex_count,
       const void* indices, int index_count, int triangle_stride, const void* normals),
      (data, vertices, vertex_stride, vertex_count, indices, index_count, triangle_stride, normals))
BUILD(dGeomTriMeshDataBuildSimple,
      (dTriMeshDataID data, const dReal* vertices, int vertex_count, const dTriIndex* indices,
       int index_count),
      (data, vertices, vertex_count, indices, index_count))
BUILD(dGeomTriMeshDataBuildSimple1,
      (dTriMeshDataID data, const dReal* vertices, int vertex_count, const dTriIndex* indices,
       int index_count, const int* normals),
      (data, vertices, vertex_count, indices, index_count, normals))
BUILD(dGeomTriMeshDataUpdate, (dTriMeshDataID data), (data))

EXPORTED void dGeomTriMeshDataDestroy(dTriMeshDataID data) {
  ORIGINAL(dGeomTriMeshDataDestroy)(data);
  if (core != NULL && data != NULL) core->mesh_destroyed(data);
}

/* --- an ODE within the program -------------------------------------------------------------- */

/* A space with itself is its interior. */
static void collide_interior(dSpaceID space, void* data, dNearCallback* callback) {
  the_ode.dSpaceCollide2((dGeomID)space, (dGeomID)space, data, callback);
}

/* Not dSpaceCollide, which here is the program's. */
static void collide_redirected(dSpaceID space, void* data, dNearCallback* callback) {
  collide_space(&the_ode, space, data, callback);
}

/* Calls within a program do not go through the dynamic linker. Of an ODE that is linked into it and
   exported (-rdynamic) passes are redirected, and pass by pass the rest follows. */
__attribute__((constructor)) static void redirect_program(void) {
  if (!ode_ext_ode_is_in_program()) return;
  find_ode(NULL);
  void* pass = (void*)the_ode.dSpaceCollide;
  if (the_ode.dSpaceCollide2 == NULL || !ode_ext_redirect(pass, (void*)&collide_redirected)) {
    say("ODE is linked into the program itself, whose calls cannot be seen from outside", "", "");
    return;
  }
  the_ode.dSpaceCollide = &collide_interior;
  mesh_geoms = 2; /* they are not seen */
}

/* --- the end -------------------------------------------------------------------------------- */

void print_core_statistics(void) {
  if (core != NULL)
    core->print_statistics();
  else if (!core_is_tried)
    fputs("ode_ext: no two meshes were there to meet: nothing was loaded\n", stderr);
}

const char* found_ode_path(void) { return ode == NULL ? NULL : ode_path; }
