/* SPDX-License-Identifier: BSD-3-Clause */
#include "preload/find_ode.h"

#include <dlfcn.h>
#include <link.h>
#include <stdlib.h>
#include <string.h>

/* The preload exports it as well, and must not take its own for the one sought. */
static const char kSought[] = "dSpaceCollide";

static struct link_map* object_of(const void* address) {
  Dl_info info;
  struct link_map* object = NULL;
  if (dladdr1(address, &info, (void**)&object, RTLD_DL_LINKMAP) == 0) return NULL;
  return object;
}

static struct link_map* own_object(void) { return object_of(kSought); }

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

static FoundOde found_in(const struct link_map* ode) {
  FoundOde found = {NULL, NULL};
  if (ode != NULL && (found.handle = open_object(ode->l_name)) != NULL) found.path = ode->l_name;
  return found;
}

FoundOde ode_ext_find_ode(const void* caller) {
  const struct link_map* calling = object_of(caller);
  void* of_all = dlsym(RTLD_NEXT, kSought);
  struct link_map* ode = of_all == NULL ? NULL : object_of(of_all);
  if (ode == NULL && calling != NULL) ode = ode_of(calling->l_name);
  /* Names first: what dlopen needs is locked while objects are listed. */
  Names names = {NULL, 0};
  if (ode == NULL) dl_iterate_phdr(&add_name, &names);
  for (size_t i = 0; i < names.count; ++i) {
    if (ode == NULL) ode = ode_of(names.names[i]);
    free(names.names[i]);
  }
  free(names.names);
  return found_in(ode);
}

FoundOde ode_ext_find_ode_in_program(void) {
  const struct link_map* ode = ode_of("");
  return found_in(ode != NULL && *ode->l_name == '\0' ? ode : NULL);
}

void* ode_ext_find_function(const FoundOde* ode, const char* name) {
  return sought_in(ode->handle, name);
}

typedef struct {
  uintptr_t address;
  Extent extent;
} Sought;

static int take_extent(struct dl_phdr_info* info, size_t size, void* data) {
  (void)size;
  Sought* sought = data;
  uintptr_t begin = UINTPTR_MAX, end = 0;
  for (size_t i = 0; i < info->dlpi_phnum; ++i) {
    const ElfW(Phdr)* segment = &info->dlpi_phdr[i];
    if (segment->p_type != PT_LOAD) continue;
    const uintptr_t first = info->dlpi_addr + segment->p_vaddr;
    if (first < begin) begin = first;
    if (first + segment->p_memsz > end) end = first + segment->p_memsz;
  }
  if (sought->address < begin || sought->address >= end) return 0;
  sought->extent = (Extent){begin, end - begin};
  return 1;
}

Extent ode_ext_extent_around(const void* address) {
  const size_t page = 4096;
  Sought sought = {(uintptr_t)address, {(uintptr_t)address / page * page, page}};
  dl_iterate_phdr(&take_extent, &sought);
  return sought.extent;
}

char* ode_ext_own_directory(void) {
  const char* path = own_object()->l_name;
  const char* slash = strrchr(path, '/');
  return strndup(path, slash == NULL ? 0 : (size_t)(slash - path) + 1);
}
