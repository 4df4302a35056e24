// SPDX-License-Identifier: BSD-3-Clause
// The kernels of kernels/paper/, of a program built with them (kProgramOption).
#pragma once

#include <array>

#include "opencl/launch.h"
#include "opencl/program.h"
#include "paper/temporal_cache.h"
#include "search/batch_data.h"

namespace ode_ext::paper {

inline constexpr const char* kProgramOption = "-DOX_PAPER";

// The place of the first chunk of each pair among those of all pairs, on the device.
struct DensePlaces {
  const Buffer& first;
  cl_uint chunks;  // of all pairs
};

class Kernels {
 public:
  explicit Kernels(Program& program)
      : chunk_tasks(program, "chunk_tasks"),
        vertex_rays(program, "vertex_rays"),
        rays_iterative(program, "rays_iterative"),
        rays_full(program, "rays_full"),
        rays_basic(program, "rays_basic"),
        monolithic(program, "monolithic") {}

  // dense: a task for every chunk of every pair, at its own place.
  void list_chunks(Launch per_pair, const BatchData& data, const TemporalCache& temporal,
                   bool dense, const DensePlaces& places) {
    data.launch(chunk_tasks, per_pair, temporal.links(), temporal.pass(),
                data.settings.displacement_limit, temporal.poses(), temporal.directory(),
                cl_uint{dense}, places.first);
  }
  // `category`: one of the lists of chunks.
  void choose_vertices(List category, Launch per_vertex, const BatchData& data,
                       const TemporalCache& temporal, const Buffer& works) {
    data.launch(vertex_rays, per_vertex, static_cast<cl_uint>(category),
                data.settings.displacement_limit, temporal.before(), temporal.now(), works);
  }
  // `rays`: one of the three.
  void cast(Kernel& rays, Launch per_ray, const BatchData& data, const TemporalCache& temporal,
            const Buffer& works) {
    data.launch(rays, per_ray, data.settings.walk_limit, temporal.now(), works);
  }
  // Of tasks that are dense.
  void run_monolithic(Launch per_vertex, const BatchData& data, const TemporalCache& temporal,
                      const DensePlaces& places, const Buffer& works) {
    data.launch(monolithic, per_vertex, places.chunks, data.settings.displacement_limit,
                data.settings.walk_limit, temporal.before(), temporal.now(), works);
  }

  Kernel chunk_tasks, vertex_rays, rays_iterative, rays_full, rays_basic, monolithic;
};

}  // namespace ode_ext::paper
