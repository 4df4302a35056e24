// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/show/coats.h"

#include <algorithm>
#include <array>
#include <set>

namespace falling_objects {
namespace {

// For each vertex the meshlets that meet there.
std::vector<std::set<int>> meshlets_at(const IndexedMesh& mesh, const std::vector<int>& meshlets) {
  std::vector<std::set<int>> at(mesh.positions.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (meshlets[i / 3] >= 0) at[mesh.triangles[i]].insert(meshlets[i / 3]);
  }
  return at;
}

}  // namespace

std::vector<std::vector<unsigned>> coats_of(const IndexedMesh& mesh,
                                            const std::vector<int>& meshlets) {
  const int count = 1 + *std::max_element(meshlets.begin(), meshlets.end());
  std::vector<std::set<int>> neighbors(static_cast<std::size_t>(count));
  for (const std::set<int>& meeting : meshlets_at(mesh, meshlets)) {
    for (const int m : meeting) {
      neighbors[static_cast<std::size_t>(m)].insert(meeting.begin(), meeting.end());
    }
  }
  // Each takes the first color that none of those before it beside it has, from its own on.
  std::vector<std::size_t> colors(neighbors.size());
  for (std::size_t m = 0; m < colors.size(); ++m) {
    std::array<bool, kCoats> taken{};
    for (const int other : neighbors[m]) {
      const auto o = static_cast<std::size_t>(other);
      if (o < m) taken[colors[o]] = true;
    }
    colors[m] = m % kCoats;
    for (std::size_t i = 0; i < kCoats && taken[colors[m]]; ++i) {
      colors[m] = (colors[m] + 1) % kCoats;
    }
  }
  std::vector<std::vector<unsigned>> coats(kCoats);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const int m = meshlets[i / 3];
    coats[m < 0 ? 0 : colors[static_cast<std::size_t>(m)]].push_back(mesh.triangles[i]);
  }
  return coats;
}

}  // namespace falling_objects
