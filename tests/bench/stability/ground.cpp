// SPDX-License-Identifier: BSD-3-Clause
#include "bench/stability/ground.h"

#include <cmath>

namespace ode_ext::stability {
namespace {

// Of a cell, in x and in y. From a quarter on, a triangle can turn over.
constexpr double kJitter = 0.24;

}  // namespace

Shape regular_slab(const GroundSize& size) {
  return box_shape({size.size, size.size, size.thickness}, size.cells);
}

Shape irregular_slab(const GroundSize& size, Random& random) {
  Shape shape = regular_slab(size);
  std::vector<float>& v = shape.mesh.vertices;
  const double reach = kJitter * size.size / size.cells;
  const double rim = size.size / 2 * (1 - 1e-6);  // rounded to float
  for (std::size_t i = 0; i < v.size(); i += 3) {
    if (v[i + 2] < 0 || std::abs(v[i]) > rim || std::abs(v[i + 1]) > rim) continue;
    for (std::size_t k = 0; k < 2; ++k) {
      v[i + k] = static_cast<float>(v[i + k] + random.uniform(-reach, reach));
    }
  }
  return shape;
}

Shape open_sheet(const GroundSize& size) {
  return {moved(make_sheet(size.size, size.cells), {0, 0, size.thickness / 2}),
          Point{size.size, size.size, size.thickness}};
}

}  // namespace ode_ext::stability
