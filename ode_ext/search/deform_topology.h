// SPDX-License-Identifier: BSD-3-Clause
// What the deform step needs to know of a mesh's triangles, however its vertices lie.
#pragma once

#include <cstdint>
#include <vector>

#include "abi/deform.h"
#include "mesh/mesh_topology.h"

namespace ode_ext {

// Where it lies in the words of all meshes; see ox_move.
struct DeformTopology {
  std::uint32_t corner_first = 0;
  std::uint32_t incident_first = 0;
};

// Appends to `words` what belongs to `mesh`.
DeformTopology append_topology(const MeshTopology& mesh, std::vector<ox_u32>& words);

}  // namespace ode_ext
