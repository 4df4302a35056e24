// SPDX-License-Identifier: BSD-3-Clause
// kernels/deform_step.cl, deform_meshlets.cl, deform_exits.cl: new positions -> all that depends on
// them.
#pragma once

#include <cstdint>
#include <vector>

#include "abi/deform.h"
#include "mesh/vec.h"
#include "opencl/buffer.h"
#include "opencl/launch.h"
#include "opencl/program.h"

namespace ode_ext {

class DeviceMeshes;

// A mesh whose vertices moved, or one that moved in the last pass and rests now.
struct MeshMove {
  ox_move record{};
  bool rests = false;
};

class DeformStep {
 public:
  explicit DeformStep(Program& program);

  // Follows all moves; `positions` are those of the vertices of all that do not rest, one mesh
  // after the other. Enqueues only: `positions` must stay until Device::finish().
  void run(const std::vector<MeshMove>& moves, const std::vector<Vec3f>& positions,
           const DeviceMeshes& meshes);
  // Every kernel once with nothing to do.
  void warm_up(Launch wide, const DeviceMeshes& meshes);
  double take_milliseconds();

 private:
  // The items of a launch, and where in starts_ it says which are of which move.
  struct Items {
    cl_uint starts_first;
    std::size_t count;
  };
  struct Work {
    Items triangles, vertices, exits, chunks, meshlets, meshlet_nodes, rest;
  };

  Work plan(const std::vector<MeshMove>& moves);
  template <class CountOf>
  Items append_starts(const std::vector<MeshMove>& moves, CountOf count_of);
  // `wide` in place of what the items need.
  void launch(const Work& work, const DeviceMeshes& meshes, const Launch* wide = nullptr);

  Kernel triangles_, vertices_, exits_, chunks_, meshlets_, meshlet_nodes_, meshes_, rest_;
  Buffer moves_, starts_, positions_, measures_;
  std::size_t local_;  // work-items per group
  std::vector<ox_move> host_moves_;
  std::vector<ox_u32> host_starts_;
};

}  // namespace ode_ext
