// SPDX-License-Identifier: BSD-3-Clause
#include "search/deform_topology.h"

#include <vector>

namespace ode_ext {

std::size_t incident_words(const MeshTopology& mesh) { return 3 * mesh.triangles.size(); }

std::size_t count_topology_words(const MeshTopology& mesh) {
  if (mesh.triangles.empty()) return 0;
  return incident_words(mesh) + mesh.vertex_count + 1 + 3 * mesh.triangles.size();
}

// The triangles are in the program's order, and so are the corners at a vertex: sums over them do
// not depend on how the mesh was built.
void append_topology(const MeshTopology& mesh, MappedRecords<ox_u32>& words) {
  if (mesh.triangles.empty()) return;
  std::vector<ox_u32> starts(mesh.vertex_count + 1);
  for (const Triangle& triangle : mesh.triangles)
    for (const std::uint32_t vertex : triangle) {
      words.push_back(vertex);
      ++starts[vertex + 1];
    }
  for (std::size_t v = 1; v < starts.size(); ++v) starts[v] += starts[v - 1];
  for (const ox_u32 start : starts) words.push_back(start);

  std::vector<ox_u32> corners(starts.back());
  for (ox_u32 t = 0; t < mesh.triangles.size(); ++t)
    for (ox_u32 corner = 0; corner < 3; ++corner)
      corners[starts[mesh.triangles[t][corner]]++] = t << 2 | corner;
  for (const ox_u32 corner : corners) words.push_back(corner);
}

}  // namespace ode_ext
