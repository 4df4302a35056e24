// SPDX-License-Identifier: BSD-3-Clause
#include "bench/accuracy/pressed_pair.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "support/ccd_oracle.h"

namespace ode_ext::accuracy {

using test::operator*;

PressedPair press_together(const Body& a, const Body& b, double share, test::Random& random) {
  const double size_a = mesh_size(a.mesh.mesh()), size_b = mesh_size(b.mesh.mesh());
  PressedPair pair{random.pose(0), random.pose(0), {}, std::min(size_a, size_b)};
  const test::Point direction = random.direction();
  const double wanted = share * pair.size;
  // Far enough: no vertex is farther from its origin than its mesh is large along three axes.
  double near = 0, far = std::sqrt(3.0) * (size_a + size_b);
  for (int halvings = 0; halvings < 60; ++halvings) {
    const double middle = (near + far) / 2;
    pair.pa.position = middle * direction;
    pair.out = shortest_way_out(a.solid, pair.pa, b.solid, pair.pb);
    if (std::fabs(pair.out.depth - wanted) < 1e-3 * wanted) return pair;
    (pair.out.depth > wanted ? near : far) = middle;
  }
  throw std::logic_error("two meshes do not go as deep into each other as asked");
}

bool libccd_differs(const Body& a, const Body& b, const PressedPair& pair) {
  const auto answer = convex_penetration(a.mesh.mesh(), pair.pa, b.mesh.mesh(), pair.pb);
  return !(std::fabs(answer.depth / pair.out.depth - 1) < 0.01);
}

}  // namespace ode_ext::accuracy
