// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace ode_ext {

using Triangle = std::array<std::uint32_t, 3>;  // indices of vertices

// Of triangles, vertices and edges: none.
inline constexpr std::uint32_t kNone = 0xffffffffu;

}  // namespace ode_ext
