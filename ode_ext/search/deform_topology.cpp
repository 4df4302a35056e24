// SPDX-License-Identifier: BSD-3-Clause
#include "search/deform_topology.h"

#include <algorithm>
#include <cstddef>

namespace ode_ext {
namespace {

// The vertices of each triangle.
void append_corners(const MeshTopology& mesh, std::vector<ox_u32>& words) {
  for (const Triangle& triangle : mesh.triangles)
    words.insert(words.end(), triangle.begin(), triangle.end());
}

// The corners at each vertex. The triangles are in the program's order, and so are the corners:
// sums over them do not depend on how the mesh was built.
void append_incident(const MeshTopology& mesh, std::vector<ox_u32>& words) {
  std::vector<ox_u32> starts(mesh.vertex_count + 1);
  for (const Triangle& triangle : mesh.triangles)
    for (const std::uint32_t vertex : triangle) ++starts[vertex + 1];
  for (std::size_t v = 1; v < starts.size(); ++v) starts[v] += starts[v - 1];
  words.insert(words.end(), starts.begin(), starts.end());

  const std::size_t first = words.size();
  words.resize(first + starts.back());
  for (ox_u32 t = 0; t < mesh.triangles.size(); ++t)
    for (ox_u32 corner = 0; corner < 3; ++corner)
      words[first + starts[mesh.triangles[t][corner]]++] = t << 2 | corner;
}

}  // namespace

DeformTopology append_topology(const MeshTopology& mesh, std::vector<ox_u32>& words) {
  DeformTopology topology;
  topology.corner_first = static_cast<std::uint32_t>(words.size());
  append_corners(mesh, words);
  topology.incident_first = static_cast<std::uint32_t>(words.size());
  append_incident(mesh, words);
  return topology;
}

}  // namespace ode_ext
