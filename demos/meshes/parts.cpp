// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/parts.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "geometry/mesh_oracle.h"

namespace falling_objects {
namespace {

using ode_ext::oracle::Vector;

// Its vertices are seen from one of them: far from the origin a volume would be a difference of
// large numbers.
struct Part {
  Point origin;
  TriangleMesh mesh;
  std::vector<std::size_t> triangles;  // their numbers in the whole
  double volume = 0, radius = 0;       // [m^3], signed, and [m]
  std::optional<ode_ext::oracle::Mesh> oracle;

  bool contains(const Point& p) {
    const Vector at{p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]};
    if (length(at) > radius) return false;
    if (!oracle) oracle.emplace(mesh.vertices, mesh.indices);
    return oracle->signed_distance(at) * volume < 0;  // inside out it has the other sign
  }
};

// The number of each vertex's part, named by one of its vertices.
std::vector<unsigned> part_of_vertices(const TriangleMesh& mesh) {
  std::vector<unsigned> parent(mesh.vertex_count());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](unsigned v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (std::size_t i = 0; i < mesh.indices.size(); ++i)
    parent[root(mesh.indices[i])] = root(mesh.indices[i - i % 3]);
  for (unsigned v = 0; v < parent.size(); ++v) parent[v] = root(v);
  return parent;
}

std::vector<Part> parts_of(const TriangleMesh& mesh) {
  const std::vector<unsigned> part_of = part_of_vertices(mesh);
  std::map<unsigned, std::size_t> numbers;
  std::vector<Part> parts;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Corners corners = mesh.corners(t);
    const auto [at, is_new] = numbers.try_emplace(part_of[mesh.indices[3 * t]], parts.size());
    if (is_new) parts.emplace_back().origin = corners[0];
    Part& part = parts[at->second];
    part.triangles.push_back(t);
    for (const Point& p : corners) {
      const auto& o = part.origin;
      part.mesh.indices.push_back(part.mesh.add_vertex({p[0] - o[0], p[1] - o[1], p[2] - o[2]}));
    }
  }
  for (Part& part : parts) {
    weld(part.mesh);
    part.volume = signed_volume(part.mesh);
    part.radius = bounding_radius(part.mesh);
  }
  return parts;
}

}  // namespace

void turn_parts_outwards(TriangleMesh& mesh) {
  std::vector<Part> parts = parts_of(mesh);
  const auto is_turned = [](const Part& part) { return part.volume < 0; };
  if (std::none_of(parts.begin(), parts.end(), is_turned)) return;
  const auto outermost_around = [&](Part& part) {
    Part* outermost = &part;
    for (Part& outer : parts)
      if (&outer != outermost && outer.contains(outermost->origin)) outermost = &outer;
    return outermost;
  };
  std::vector<const Part*> turned;
  for (Part& part : parts)
    if (is_turned(*outermost_around(part))) turned.push_back(&part);
  for (const Part* part : turned)
    for (const std::size_t t : part->triangles)
      std::swap(mesh.indices[3 * t + 1], mesh.indices[3 * t + 2]);
}

}  // namespace falling_objects
