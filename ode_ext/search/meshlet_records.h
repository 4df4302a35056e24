// SPDX-License-Identifier: BSD-3-Clause
// Meshlets as the device wants them.
#pragma once

#include <cstdint>

#include "abi/types.h"
#include "mesh/mesh.h"
#include "opencl/mapped_records.h"

namespace ode_ext {

// Where the parts of a mesh start among those of all meshes.
struct MeshRange {
  std::uint32_t vertex_first, triangle_first, edge_first;
  std::uint32_t topology_first;  // of what the deform step needs to know of it
};

// Appends those of a mesh. The deform step makes of a deformable one's what depends on where its
// vertices are.
void append_meshlets(const Mesh& mesh, const MeshRange& range, MappedRecords<ox_meshlet>& records);

}  // namespace ode_ext
