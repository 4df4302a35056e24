// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/feature_number.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace ode_ext {
namespace {

// How many numbers there are of a kind, at most.
std::uint64_t count_of(const MeshTopology& built, std::uint32_t feature) {
  switch (static_cast<FeatureKind>(feature >> kFeatureShift)) {
    case FeatureKind::kVertex:
      return built.vertex_count;
    case FeatureKind::kEdge:
      return built.edges.size();
    default:
      return built.triangles.size();
  }
}

std::uint32_t number_of(std::uint32_t feature) { return feature & ((1u << kFeatureShift) - 1); }

}  // namespace

std::uint32_t repeated(const MeshTopology& built, std::uint32_t feature, std::uint64_t times) {
  return to_feature(static_cast<FeatureKind>(feature >> kFeatureShift),
                    number_of(feature) + times * count_of(built, feature));
}

std::vector<std::uint32_t> triangles_at(const MeshTopology& built, std::uint32_t feature) {
  const auto kind = static_cast<FeatureKind>(feature >> kFeatureShift);
  if (kind != FeatureKind::kVertex && kind != FeatureKind::kEdge) return {};
  // Of one that repeats, as number_repeats gives it.
  const auto number = static_cast<std::uint32_t>(number_of(feature) % count_of(built, feature));
  std::array<std::uint32_t, 2> corners{number, number};
  if (kind == FeatureKind::kEdge) corners = built.edges[number].vertices;
  std::vector<std::uint32_t> triangles;
  const VertexTriangles& at = built.vertex_triangles.of(built.vertex_count, built.triangles);
  for (const std::uint32_t t : at.of(corners[0])) {
    const Triangle& triangle = built.triangles[t];
    if (std::find(triangle.begin(), triangle.end(), corners[1]) != triangle.end())
      triangles.push_back(built.source_triangle[t]);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

}  // namespace ode_ext
