// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace view {

// About a sixth of the triangles, of the same vertices, for a mesh that is seen from afar.
std::vector<unsigned> simplify(std::span<const glm::vec3> positions,
                               std::span<const unsigned> triangles);

}  // namespace view
