// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/deform.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesh/measures.h"
#include "mesh/orientation.h"
#include "mesh/weld.h"

namespace ode_ext {
namespace {

// A search takes about as much longer as meshlets are larger. Those that have come apart so far are
// worth to be made anew, once for each such change.
constexpr double kMostSpread = 4;

bool is_collapsed(const SourceTriangles& source, std::size_t first) {
  return source[first] == source[first + 1] || source[first + 1] == source[first + 2] ||
         source[first + 2] == source[first];
}

// Whether the same triangles collapse, and corners of one vertex are at one place. Floats that
// compare equal have the same bits but for the sign of 0, as in weld().
bool follows(const std::vector<std::uint32_t>& vertex_of, const SourceTriangles& source,
             std::vector<Vec3f>& vertices) {
  for (std::size_t i = 0; i + 2 < source.size(); i += 3) {
    if (is_collapsed(source, i) != (vertex_of[i] == kNone)) return false;
    if (vertex_of[i] == kNone) continue;
    for (std::size_t k = i; k < i + 3; ++k) vertices[vertex_of[k]] = source[k] + Vec3f{};
  }
  for (std::size_t k = 0; k < source.size(); ++k)
    if (vertex_of[k] != kNone && vertices[vertex_of[k]] != source[k]) return false;
  return true;
}

}  // namespace

std::shared_ptr<const Mesh> deformed(const std::shared_ptr<const MeshTopology>& topology,
                                     const SourceTriangles& source, float open_thickness) {
  if (topology->corner_vertex.size() != source.size()) return nullptr;
  Mesh shape;
  shape.source = source;
  shape.deformable = true;
  shape.open_thickness = open_thickness;
  shape.content_hash = hash_soup(source);
  shape.shape_hash = shape.content_hash;
  shape.finite = is_finite(source);
  if (!shape.finite) return std::make_shared<const Mesh>(std::move(shape));

  shape.vertices.resize(topology->vertex_count);
  if (topology->reoriented || !follows(topology->corner_vertex, source, shape.vertices) ||
      !are_apart(shape.vertices))
    return nullptr;
  // Built anew, a mesh is turned where its volume is negative.
  const double volume = signed_volume(shape.vertices, topology->triangles);
  if (topology->closed && (volume < 0 || (volume == 0 && topology->inverted))) return nullptr;
  const double spread = meshlet_spread(topology->meshlets, shape.vertices, topology->triangles);
  if (spread > kMostSpread * topology->spread) return nullptr;
  shape.topology = topology;
  shape.box = box_of(shape.vertices);
  shape.radius = half_diagonal(shape.box);
  shape.mean_edge = mean_side(shape.vertices, topology->triangles);
  return std::make_shared<const Mesh>(std::move(shape));
}

}  // namespace ode_ext
