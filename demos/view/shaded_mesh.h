// SPDX-License-Identifier: BSD-3-Clause
// A triangle mesh with the normals that it is lit by: rounded where it bends a little, sharp where
// it bends much.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace view {

struct ShadedMesh {
  struct Vertex {
    glm::vec3 position, normal;
  };
  std::vector<Vertex> vertices;
  std::vector<unsigned> triangles;  // three vertices each
};

// Vertices are split at edges that bend by more than 40 degrees. A normal is the sum of those of
// the triangles around, each by its angle.
ShadedMesh shade(std::span<const glm::vec3> positions, std::span<const unsigned> triangles);

// One normal a vertex: for surfaces that bend all the time.
ShadedMesh shade_smoothly(std::span<const glm::vec3> positions,
                          std::span<const unsigned> triangles);

// Of a surface that has a border, the edges of it: two vertices each.
ShadedMesh border_of(std::span<const glm::vec3> positions, std::span<const unsigned> triangles);

}  // namespace view
