// SPDX-License-Identifier: BSD-3-Clause
// What the deform step needs to know of a mesh's triangles, however its vertices lie.
#pragma once

#include <cstddef>

#include "abi/deform.h"
#include "mesh/mesh_topology.h"
#include "opencl/mapped_records.h"

namespace ode_ext {

// How many words that takes of a deformable mesh: the vertices of each triangle, and from
// `incident_words` on the corners at each vertex; see ox_move. None of one without triangles.
std::size_t count_topology_words(const MeshTopology& mesh);
std::size_t incident_words(const MeshTopology& mesh);

void append_topology(const MeshTopology& mesh, MappedRecords<ox_u32>& words);

}  // namespace ode_ext
