// SPDX-License-Identifier: BSD-3-Clause
// What the kernels of a batch work on.
#pragma once

#include "opencl/launch.h"
#include "opencl/program.h"
#include "search/append_lists.h"
#include "search/batch_settings.h"
#include "search/device_meshes.h"
#include "search/pair_buffers.h"

namespace ode_ext {

struct BatchData {
  explicit BatchData(Program& program)
      : meshes(program), pairs(program.device()), lists(program.device()) {}

  // A kernel whose first parameters are OX_SCENE_PARAMETERS (kernels/lib/scene.h).
  template <class... Args>
  void launch(Kernel& kernel, Launch size, const Args&... args) const {
    kernel.launch(size.groups, size.local, lists.counters(), lists.lists(), settings.modes,
                  pairs.count, pairs.pairs, pairs.found, meshes.records(), meshes.chunks(),
                  meshes.vertices(), meshes.edges(), meshes.ring_starts(), meshes.rings(),
                  meshes.facets(), meshes.triangles(), meshes.meshlets(), meshes.meshlet_nodes(),
                  args...);
  }

  DeviceMeshes meshes;
  PairBuffers pairs;
  AppendLists lists;
  BatchSettings settings;
};

}  // namespace ode_ext
