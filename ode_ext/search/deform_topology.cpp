// SPDX-License-Identifier: BSD-3-Clause
#include "search/deform_topology.h"

#include <algorithm>
#include <cstddef>

namespace ode_ext {
namespace {

// The vertices of each triangle, in the order of the leaves.
void append_corners(const MeshTopology& mesh, std::vector<ox_u32>& words) {
  for (const std::uint32_t triangle : mesh.leaf_order)
    words.insert(words.end(), mesh.triangles[triangle].begin(), mesh.triangles[triangle].end());
}

// The corners at each vertex. The triangles are in the program's order, and so are the corners:
// sums over them do not depend on how the mesh was built.
void append_incident(const MeshTopology& mesh, std::vector<ox_u32>& words) {
  std::vector<ox_u32> place(mesh.triangles.size());  // in the order of the leaves
  for (std::size_t k = 0; k < place.size(); ++k) place[mesh.leaf_order[k]] = static_cast<ox_u32>(k);

  std::vector<ox_u32> starts(mesh.vertex_count + 1);
  for (const Triangle& triangle : mesh.triangles)
    for (const std::uint32_t vertex : triangle) ++starts[vertex + 1];
  for (std::size_t v = 1; v < starts.size(); ++v) starts[v] += starts[v - 1];
  words.insert(words.end(), starts.begin(), starts.end());

  const std::size_t first = words.size();
  words.resize(first + starts.back());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (ox_u32 corner = 0; corner < 3; ++corner)
      words[first + starts[mesh.triangles[t][corner]]++] = place[t] << 2 | corner;
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
