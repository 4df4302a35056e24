// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace view {

// Triangles in place of those of a mesh, between the same vertices.
struct Level {
  std::vector<unsigned> triangles;
  float error;  // how far from the mesh they are, about, in its unit
};

// The mesh itself, and ever fewer triangles for ever smaller pictures of it.
std::vector<Level> levels_of(std::span<const glm::vec3> positions,
                             std::span<const unsigned> triangles);

}  // namespace view
