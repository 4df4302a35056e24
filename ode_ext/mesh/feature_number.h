// SPDX-License-Identifier: BSD-3-Clause
// The features of a mesh, its vertices, edges and facets, by numbers that depend on it alone.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh_topology.h"

namespace ode_ext {

enum class FeatureKind : std::uint32_t { kUnknown, kVertex, kEdge, kFacet };
inline constexpr std::uint32_t kFeatureShift = 30;

// The kind in the two highest bits, in the others the number: of the vertex, of the edge (among
// those between facets), of the facet. 0: not known, or the number has no room.
constexpr std::uint32_t to_feature(FeatureKind kind, std::uint64_t number) {
  if (kind == FeatureKind::kUnknown || number >> kFeatureShift != 0) return 0;
  return static_cast<std::uint32_t>(kind) << kFeatureShift | static_cast<std::uint32_t>(number);
}

// One with a number beyond those of all features of its kind, once more for each time.
std::uint32_t repeated(const MeshTopology& built, std::uint32_t feature, std::uint64_t times);

// The triangles at a vertex or an edge, repeated or not, the program's indices, ascending; of a
// facet none.
std::vector<std::uint32_t> triangles_at(const MeshTopology& built, std::uint32_t feature);

}  // namespace ode_ext
