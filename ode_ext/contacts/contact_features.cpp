// SPDX-License-Identifier: BSD-3-Clause
#include "contacts/contact_features.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "mesh/ray_cast.h"

namespace ode_ext {
namespace {

// `triangle` is an index into built.triangles.
std::uint32_t facet_of(const MeshTopology& built, std::uint32_t triangle) {
  return to_feature(FeatureKind::kFacet, built.facets.empty() ? triangle : built.facets[triangle]);
}

}  // namespace

std::uint32_t feature_of(const DeviceMeshes& meshes, std::uint32_t mesh, std::uint32_t word) {
  const MeshTopology& built = *meshes.mesh(mesh).topology;
  const MeshRange& place = meshes.range(mesh);
  const std::uint32_t index = word & ((1u << OX_OF_SHIFT) - 1);
  switch (word >> OX_OF_SHIFT) {
    case OX_OF_VERTEX:
      return to_feature(FeatureKind::kVertex, index - place.vertex_first);
    case OX_OF_EDGE:
      return to_feature(FeatureKind::kEdge, index - place.edge_first);
    default:
      return facet_of(built, index - place.triangle_first);
  }
}

void number_repeats(std::span<Contact> contacts, const Mesh& a, const Mesh& b) {
  if (contacts.size() < 2) return;
  std::vector<std::pair<std::array<std::uint32_t, 2>, std::size_t>> order(contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) order[i] = {contacts[i].features, i};
  std::sort(order.begin(), order.end());
  std::uint64_t times = 0;
  for (std::size_t k = 1; k < order.size(); ++k) {
    const auto& [features, i] = order[k];
    times = features == order[k - 1].first ? times + 1 : 0;
    if (times != 0)
      contacts[i].features = {repeated(*a.topology, features[0], times),
                              repeated(*b.topology, features[1], times)};
  }
}

}  // namespace ode_ext
