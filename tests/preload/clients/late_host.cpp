// SPDX-License-Identifier: BSD-3-Clause
// A program without ODE that loads a plugin with one, late and for itself alone: as Python its
// modules, or a robot simulator the physics engine that it is told.
#include <dlfcn.h>

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: late_host PLUGIN IDIOM\n");
    return 2;
  }
  void* plugin = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
  using Main = int(int, char**);
  auto* run = plugin == nullptr ? nullptr : reinterpret_cast<Main*>(dlsym(plugin, "idioms_main"));
  if (run == nullptr) {
    std::fprintf(stderr, "late_host: %s\n", dlerror());
    return 1;
  }
  const int status = run(argc - 1, argv + 1);
  dlclose(plugin);
  return status;
}
