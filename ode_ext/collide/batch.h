// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "collide/batch_report.h"
#include "collide/pass_memory.h"
#include "collide/workload.h"
#include "search/scene.h"

namespace ode_ext {

// Pairs that are collided together, as long as that takes.
struct Batch {
  const Scene& scene;
  PassMemory* memory;  // of the same space; null: a call outside of any pass
  BatchReport& report;
  Workload workload;
  std::size_t tile_pairs = memory != nullptr ? memory->tile_pairs : 0;  // before the batch
  // What is among its objects: deformable meshes, and closed ones alone, of which a flood leaves
  // nothing to the vertex step (flood.cl).
  bool deforms = any_object([](const Mesh& mesh) { return mesh.deformable; });
  bool floods_all = !any_object([](const Mesh& mesh) { return !mesh.closed(); });

  bool remembers() const { return memory != nullptr && memory->temporal != nullptr; }

  template <class Predicate>
  bool any_object(Predicate is_such) const {
    return std::any_of(
        scene.objects.begin(), scene.objects.end(),
        [&](const Scene::Object& object) { return is_such(*scene.meshes[object.mesh]); });
  }
};

}  // namespace ode_ext
