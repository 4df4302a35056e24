// SPDX-License-Identifier: BSD-3-Clause
// A bowl without thickness.
#pragma once

#include <cmath>
#include <numbers>

#include "support/mesh_makers.h"

namespace ode_ext::test {

// Half of a ball of 0.3 m about 0, its rim at the top, in one layer.
inline TestMesh make_bowl(int rows, int around) {
  TestMesh mesh{{0, 0, -0.3f}, {}};
  for (int row = 1; row <= rows; ++row)
    for (int i = 0; i < around; ++i) {
      const double down = 0.5 * std::numbers::pi * row / rows;
      const double angle = 2 * std::numbers::pi * i / around;
      for (const double x :
           {std::sin(down) * std::cos(angle), std::sin(down) * std::sin(angle), -std::cos(down)})
        mesh.vertices.push_back(static_cast<float>(0.3 * x));
    }
  const auto at = [&](int row, int i) {
    return static_cast<unsigned>(1 + (row - 1) * around + i % around);
  };
  for (int i = 0; i < around; ++i) {
    mesh.indices.insert(mesh.indices.end(), {0, at(1, i + 1), at(1, i)});
    for (int row = 1; row < rows; ++row)
      mesh.indices.insert(mesh.indices.end(), {at(row, i), at(row + 1, i + 1), at(row + 1, i),
                                               at(row, i), at(row, i + 1), at(row + 1, i + 1)});
  }
  return mesh;
}

}  // namespace ode_ext::test
