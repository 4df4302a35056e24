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
                  settings.max_contacts, settings.max_contacts_deformable, pairs.count,
                  meshes.records(), meshes.chunks(), meshes.vertices(), meshes.edges(),
                  meshes.ring_starts(), meshes.rings(), meshes.triangles(), meshes.meshlets(),
                  meshes.meshlet_nodes(), pairs.objects, pairs.members, pairs.pairs, pairs.found,
                  pairs.ranges, lists.meshlets(), lists.meshlet_pairs(), lists.crossings(),
                  lists.flood_words(), lists.tasks(), lists.rays(), lists.hits(), lists.contacts(),
                  lists.features(), lists.feature_parents(), lists.feature_slots(), lists.regions(),
                  lists.members(), lists.faces(), lists.planes(), lists.edge_planes(),
                  lists.candidates(), args...);
  }

  DeviceMeshes meshes;
  PairBuffers pairs;
  AppendLists lists;
  BatchSettings settings;
};

}  // namespace ode_ext
