// SPDX-License-Identifier: BSD-3-Clause
// What contacts are of: a vertex, an edge or a facet of each mesh, by numbers that depend on that
// mesh alone. So they tell which contact of a pair is which of those it had in the pass before.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "contacts/contact.h"
#include "search/device_meshes.h"

namespace ode_ext {

enum class FeatureKind : std::uint32_t { kUnknown, kVertex, kEdge, kFacet };
inline constexpr std::uint32_t kFeatureShift = 30;

// The kind in the two highest bits, in the others the number: of the vertex, of the edge (among
// those between facets), of the facet. 0: not known, or the number has no room.
constexpr std::uint32_t to_feature(FeatureKind kind, std::uint64_t number) {
  if (kind == FeatureKind::kUnknown || number >> kFeatureShift != 0) return 0;
  return static_cast<std::uint32_t>(kind) << kFeatureShift | static_cast<std::uint32_t>(number);
}

// Of what the device says (OX_OF) of mesh `mesh`. An edge within a facet is the facet.
std::uint32_t feature_of(const DeviceMeshes& meshes, std::uint32_t mesh, std::uint32_t word);

// The triangles of a mesh at a vertex or an edge that a contact is of, the program's indices,
// ascending; of a facet none. Looks at every triangle of the mesh.
std::vector<std::uint32_t> triangles_at(const MeshTopology& built, std::uint32_t feature);

// Two contacts of a pair may be of the same two features: an edge crosses a facet that is not quite
// flat more than once, two edges come near one another in two regions. The second gets numbers
// beyond those of all features, the third beyond those, and so on in the order of the contacts.
void number_repeats(std::span<Contact> contacts, const Mesh& a, const Mesh& b);

}  // namespace ode_ext
