// SPDX-License-Identifier: BSD-3-Clause
#include "view/shaded_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace view {
namespace {

const float kSharp = std::cos(glm::radians(40.0F));

glm::vec3 unit(glm::vec3 v) {
  const float length = glm::length(v);
  return length > 0 ? v / length : glm::vec3(0, 0, 1);
}

// Of every corner of every triangle: the triangle's unit normal times its angle there.
std::vector<glm::vec3> corner_normals(std::span<const glm::vec3> positions,
                                      std::span<const unsigned> triangles) {
  std::vector<glm::vec3> normals(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    const std::array<glm::vec3, 3> p{positions[triangles[t]], positions[triangles[t + 1]],
                                     positions[triangles[t + 2]]};
    const glm::vec3 normal = unit(glm::cross(p[1] - p[0], p[2] - p[0]));
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec3 a = unit(p[(k + 1) % 3] - p[k]), b = unit(p[(k + 2) % 3] - p[k]);
      // Not nothing, so that the normal of a sliver still has a direction.
      normals[t + k] = normal * std::max(1e-4F, std::acos(std::clamp(glm::dot(a, b), -1.0F, 1.0F)));
    }
  }
  return normals;
}

}  // namespace

ShadedMesh shade(std::span<const glm::vec3> positions, std::span<const unsigned> triangles) {
  const std::vector<glm::vec3> normals = corner_normals(positions, triangles);
  std::vector<std::vector<std::size_t>> around(positions.size());  // corners at each vertex
  for (std::size_t c = 0; c < triangles.size(); ++c) around[triangles[c]].push_back(c);

  ShadedMesh mesh;
  mesh.triangles.resize(triangles.size());
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const std::size_t first = mesh.vertices.size();  // of this vertex's
    for (const std::size_t corner : around[v]) {
      const glm::vec3 own = unit(normals[corner]);
      glm::vec3 sum(0);
      for (const std::size_t other : around[v]) {
        if (glm::dot(own, unit(normals[other])) >= kSharp) sum += normals[other];
      }
      const glm::vec3 normal = unit(sum);
      std::size_t use = first;
      while (use < mesh.vertices.size() && glm::dot(mesh.vertices[use].normal, normal) < 0.9999F) {
        ++use;
      }
      if (use == mesh.vertices.size()) mesh.vertices.push_back({positions[v], normal});
      mesh.triangles[corner] = static_cast<unsigned>(use);
    }
  }
  return mesh;
}

ShadedMesh shade_smoothly(std::span<const glm::vec3> positions,
                          std::span<const unsigned> triangles) {
  const std::vector<glm::vec3> normals = corner_normals(positions, triangles);
  ShadedMesh mesh;
  for (const glm::vec3& position : positions) mesh.vertices.push_back({position, glm::vec3(0)});
  mesh.triangles.assign(triangles.begin(), triangles.end());
  for (std::size_t c = 0; c < triangles.size(); ++c) {
    mesh.vertices[triangles[c]].normal += normals[c];
  }
  for (ShadedMesh::Vertex& vertex : mesh.vertices) vertex.normal = unit(vertex.normal);
  return mesh;
}

ShadedMesh border_of(std::span<const glm::vec3> positions, std::span<const unsigned> triangles) {
  std::set<std::pair<unsigned, unsigned>> once;  // edges that so far had one triangle
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const unsigned from = triangles[i], to = triangles[i % 3 == 2 ? i - 2 : i + 1];
    if (once.erase({to, from}) == 0) once.emplace(from, to);
  }
  ShadedMesh border;
  for (const auto& [from, to] : once) {
    for (const unsigned end : {from, to}) {
      border.triangles.push_back(static_cast<unsigned>(border.vertices.size()));
      border.vertices.push_back({positions[end], glm::vec3(0, 0, 1)});
    }
  }
  return border;
}

}  // namespace view
