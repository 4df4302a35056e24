/* SPDX-License-Identifier: BSD-3-Clause */
#include "preload/find_ode.h"

#include <dlfcn.h>
#include <link.h>
#include <stdlib.h>
#include <string.h>

/* The preload exports it as well, and must not take its own for the one sought. */
static const char kSought[] = "dSpaceCollide";

static void* found_in; /* as dlopen gives it */

static struct link_map* object_of(const void* address) {
  Dl_info info;
  struct link_map* object = NULL;
  if (dladdr1(address, &info, (void**)&object, RTLD_DL_LINKMAP) == 0) return NULL;
  return object;
}

static struct link_map* own_object(void) { return object_of(&found_in); }

static void* open_object(const char* name) {
  return dlopen(*name == '\0' ? NULL : name, RTLD_LAZY | RTLD_NOLOAD);
}

/* In the scope of a handle, but not in this library. */
static void* sought_in(void* handle, const char* name) {
  void* function = handle == NULL ? NULL : dlsym(handle, name);
  return function != NULL && object_of(function) != own_object() ? function : NULL;
}

/* The object that defines what an object of this name would find, or NULL. */
static struct link_map* ode_of(const char* name) {
  void* handle = open_object(name);
  void* function = sought_in(handle, kSought);
  struct link_map* object = function == NULL ? NULL : object_of(function);
  if (handle != NULL) dlclose(handle);
  return object;
}

typedef struct {
  char** names;
  size_t count;
} Names;

static int add_name(struct dl_phdr_info* info, size_t size, void* data) {
  (void)size;
  Names* names = data;
  char** more = realloc(names->names, (names->count + 1) * sizeof(*more));
  if (more == NULL) return 1;
  names->names = more;
  char* name = strdup(info->dlpi_name);
  if (name == NULL) return 1;
  names->names[names->count++] = name;
  return 0;
}

const char* ode_ext_find_ode(const void* caller) {
  const struct link_map* calling = object_of(caller);
  struct link_map* ode = calling == NULL ? NULL : ode_of(calling->l_name);
  /* Names first: what dlopen needs is locked while objects are listed. */
  Names names = {NULL, 0};
  if (ode == NULL) dl_iterate_phdr(&add_name, &names);
  for (size_t i = 0; i < names.count; ++i) {
    if (ode == NULL) ode = ode_of(names.names[i]);
    free(names.names[i]);
  }
  free(names.names);
  if (ode != NULL) found_in = open_object(ode->l_name);
  return found_in == NULL ? NULL : ode->l_name;
}

void* ode_ext_find_function(const char* name) { return sought_in(found_in, name); }

int ode_ext_ode_is_in_program(void) {
  const struct link_map* ode = ode_of("");
  return ode != NULL && *ode->l_name == '\0';
}

char* ode_ext_own_directory(void) {
  const char* path = own_object()->l_name;
  const char* slash = strrchr(path, '/');
  return strndup(path, slash == NULL ? 0 : (size_t)(slash - path) + 1);
}
