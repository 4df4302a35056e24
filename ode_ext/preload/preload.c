/* SPDX-License-Identifier: BSD-3-Clause */
/* Stands in front of a program's ODE (LD_PRELOAD): passes with meshes go to the library, which is
   loaded for the first of them, in the precision of that ODE. All else goes straight on. */
#include <dlfcn.h>
#include <limits.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "preload/core.h"
#include "preload/originals.h"
#include "preload/redirect.h"
#include "preload/statistics.h"

#define EXPORTED __attribute__((visibility("default")))

static const dxPreloadCore* _Atomic core;
static Ode* _Atomic core_ode; /* that it collides the meshes of: the first in which two can meet */
/* Mesh geoms that may be alive: where there are not two, nothing is to be done. */
static atomic_long mesh_geoms;

/* What is, and what the program goes on with. */
static void say(const char* text, const char* more, const char* goes_on) {
  const char* level = getenv("ODE_EXT_LOG");
  if (level == NULL || strcmp(level, "off") != 0)
    fprintf(stderr, "ode_ext: %s%s; %s\n", text, more, goes_on);
}

static void say_not_collided(const char* text, const char* more) {
  say(text, more, "the program goes on with ODE's own collider");
}

/* For the library: not a function that was redirected. */
static void* find_function(const char* name) {
  return strcmp(name, "dSpaceCollide") == 0 ? (void*)core_ode->dSpaceCollide
                                            : ode_ext_find_function(&core_ode->found, name);
}

static const char* precision_of(const Ode* ode) {
  __typeof__(&dCheckConfiguration) has =
      (__typeof__(has))ode_ext_find_function(&ode->found, "dCheckConfiguration");
  if (has != NULL && has("ODE_double_precision")) return "double";
  if (has != NULL && has("ODE_single_precision")) return "single";
  return NULL;
}

static int uses_ode_ext(void) { return dlsym(RTLD_DEFAULT, "dBatchColliderCreate") != NULL; }

static void load_core_of(Ode* ode) {
  core_ode = ode;
  if (uses_ode_ext()) {
    say("this program uses ode_ext by itself", "",
        "it goes on with that, and of the options of ode_ext-run only --device, --log, --trace and "
        "--capture count");
    return;
  }
  const char* precision = precision_of(ode);
  if (precision == NULL) {
    say_not_collided("this ODE does not tell its precision", "");
    return;
  }
  char *directory = ode_ext_own_directory(), *path = NULL;
  if (directory == NULL || asprintf(&path, "%slibode_ext_preload_%s.so", directory, precision) < 0)
    path = NULL;
  void* library = path == NULL ? NULL : dlopen(path, RTLD_NOW | RTLD_LOCAL);
  if (library == NULL) {
    say_not_collided(path == NULL ? "memory is short" : dlerror(), "");
  } else {
    const char* missing = NULL;
    dxPreloadCoreFn* start = (dxPreloadCoreFn*)dlsym(library, "ode_ext_preload_core");
    core = start(&find_function, &missing);
    if (core == NULL) say_not_collided("this ODE has no ", missing);
  }
  free(path);
  free(directory);
}

/* The library if it is loaded, for this ODE. */
static const dxPreloadCore* core_of(const Ode* ode) { return ode == core_ode ? core : NULL; }

/* The library, or NULL where it cannot be. */
static const dxPreloadCore* loaded_core_of(Ode* ode) {
  static pthread_mutex_t one_at_a_time = PTHREAD_MUTEX_INITIALIZER;
  static atomic_bool is_tried, is_second_said;
  if (!is_tried) {
    pthread_mutex_lock(&one_at_a_time);
    if (!is_tried) load_core_of(ode);
    is_tried = true;
    pthread_mutex_unlock(&one_at_a_time);
  }
  if (ode != core_ode && core != NULL && !atomic_exchange(&is_second_said, true))
    say("this process has another ODE: ", ode->found.path,
        "its meshes go on with its own collider, and those of the first with ode_ext");
  return core_of(ode);
}

static int may_meshes_meet(const Ode* ode) {
  return mesh_geoms >= 2 && !ode->are_meshes_the_programs;
}

static int is_mesh(const Ode* ode, dGeomID geom) {
  return ode->class_of != NULL && ode->class_of(geom) == dTriMeshClass;
}

#define ODE_OF_CALLER() ode_of(__builtin_return_address(0))

/* --- passes --------------------------------------------------------------------------------- */

static int collide(Ode* ode, dGeomID first, dGeomID second, void* data, dNearCallback* callback) {
  if (!may_meshes_meet(ode) || callback == NULL || loaded_core_of(ode) == NULL) return 0;
  return core->collide(first, second, data, callback);
}

static void collide_space(Ode* ode, dSpaceID space, void* data, dNearCallback* callback) {
  PASS_TIMER;
  if (space == NULL || !collide(ode, (dGeomID)space, NULL, data, callback))
    ode->dSpaceCollide(space, data, callback);
}

EXPORTED void dSpaceCollide(dSpaceID space, void* data, dNearCallback* callback) {
  collide_space(ODE_OF_CALLER(), space, data, callback);
}

EXPORTED void dSpaceCollide2(dGeomID first, dGeomID second, void* data, dNearCallback* callback) {
  Ode* ode = ODE_OF_CALLER();
  PASS_TIMER;
  if (first == NULL || second == NULL || !collide(ode, first, second, data, callback))
    ode->dSpaceCollide2(first, second, data, callback);
}

static atomic_bool have_met;

__attribute__((cold)) static void meet(Ode* ode, dGeomID first, dGeomID second) {
  if (have_met || first == NULL || second == NULL || !is_mesh(ode, first) || !is_mesh(ode, second))
    return;
  if (loaded_core_of(ode) != NULL) core->meet();
  have_met = true;
}

/* In a pass ODE asks the library by itself. What is met before any pass has to bring it in. */
EXPORTED int dCollide(dGeomID first, dGeomID second, int flags, dContactGeom* contacts, int skip) {
  Ode* ode = ODE_OF_CALLER();
  if (may_meshes_meet(ode) && !have_met) meet(ode, first, second);
  return ode->dCollide(first, second, flags, contacts, skip);
}

EXPORTED void dSetColliderOverride(int first, int second, dColliderFn* collider) {
  Ode* ode = ODE_OF_CALLER();
  ode->dSetColliderOverride(first, second, collider);
  if (first != dTriMeshClass || second != dTriMeshClass || uses_ode_ext()) return;
  if (!atomic_exchange(&ode->are_meshes_the_programs, true))
    say("this program sets a collider of its own for two meshes", "", "they go on with that");
}

/* --- what lives ----------------------------------------------------------------------------- */

/* ODE forgets who collides meshes, if it was not initialized before; nothing tells whether it was.
   So what the program collided once by itself stays the program's. */
static void initialized(const Ode* ode) {
  if (core_of(ode) != NULL && !ode->are_meshes_the_programs) core->initialized();
}

EXPORTED void dInitODE(void) {
  const Ode* ode = ODE_OF_CALLER();
  ode->dInitODE();
  initialized(ode);
}

EXPORTED int dInitODE2(unsigned flags) {
  const Ode* ode = ODE_OF_CALLER();
  const int result = ode->dInitODE2(flags);
  initialized(ode);
  return result;
}

EXPORTED dGeomID dCreateTriMesh(dSpaceID space, dTriMeshDataID data, dTriCallback* callback,
                                dTriArrayCallback* array_callback, dTriRayCallback* ray_callback) {
  ++mesh_geoms;
  return ODE_OF_CALLER()->dCreateTriMesh(space, data, callback, array_callback, ray_callback);
}

/* A space may destroy its geoms by itself, so there may be fewer than are counted. */
EXPORTED void dGeomDestroy(dGeomID geom) {
  const Ode* ode = ODE_OF_CALLER();
  if (mesh_geoms > 0 && geom != NULL && is_mesh(ode, geom)) --mesh_geoms;
  ode->dGeomDestroy(geom);
}

static void changed(const Ode* ode, dTriMeshDataID data) {
  if (core_of(ode) != NULL && data != NULL) core->mesh_changed(data);
}

#define BUILD(name, parameters, arguments) \
  EXPORTED void name parameters {          \
    const Ode* ode = ODE_OF_CALLER();      \
    ode->name arguments;                   \
    changed(ode, data);                    \
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
  const Ode* ode = ODE_OF_CALLER();
  ode->dGeomTriMeshDataDestroy(data);
  if (core_of(ode) != NULL && data != NULL) core->mesh_destroyed(data);
}

/* --- an ODE within the program -------------------------------------------------------------- */

static Ode* ode_of_program;

/* A space with itself is its interior. */
static void collide_interior(dSpaceID space, void* data, dNearCallback* callback) {
  ode_of_program->dSpaceCollide2((dGeomID)space, (dGeomID)space, data, callback);
}

/* Not dSpaceCollide, which here is the program's. */
static void collide_redirected(dSpaceID space, void* data, dNearCallback* callback) {
  collide_space(ode_of_program, space, data, callback);
}

/* Calls within a program do not go through the dynamic linker. Of an ODE that is linked into it and
   exported (-rdynamic) passes are redirected, and pass by pass the rest follows. */
__attribute__((constructor)) static void redirect_program(void) {
  ode_of_program = ode_ext_ode_of_program();
  if (ode_of_program == NULL) return;
  void* pass = (void*)ode_of_program->dSpaceCollide;
  if (ode_of_program->dSpaceCollide2 == NULL ||
      !ode_ext_redirect(pass, (void*)&collide_redirected)) {
    say_not_collided(
        "ODE is linked into the program itself, whose calls cannot be seen from outside", "");
    return;
  }
  ode_of_program->dSpaceCollide = &collide_interior;
  const char* trust = getenv("ODE_EXT_TRUST_MESHES");
  if (trust != NULL && *trust != '\0' && strcmp(trust, "0") != 0) {
    unsetenv("ODE_EXT_TRUST_MESHES");
    say("ODE is linked into the program itself, and changes of its meshes cannot be seen", "",
        "ODE_EXT_TRUST_MESHES has no effect");
  }
  mesh_geoms = LONG_MAX / 2; /* they are not seen, nor do those that are destroyed count */
}

/* --- the end -------------------------------------------------------------------------------- */

void print_core_statistics(void) {
  if (core != NULL)
    core->print_statistics();
  else if (core_ode == NULL)
    fputs("ode_ext: no two meshes were there to meet: nothing was loaded\n", stderr);
}

const char* found_ode_path(void) {
  const Ode* ode = core_ode != NULL ? core_ode : ode_ext_first_ode();
  return ode == NULL ? NULL : ode->found.path;
}
