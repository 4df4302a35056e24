// SPDX-License-Identifier: BSD-3-Clause
#include "bench/stability/shape.h"

namespace ode_ext::stability {

Shape box_shape(const Point& extents, int n) { return {make_box(extents, n, n, 1), extents}; }

Shape solid_shape(const TestMesh& mesh) {
  return {moved(mesh, -1 * centre_of_mass(mesh)), std::nullopt};
}

// Every triangle makes a tetrahedron with the origin, of signed volume.
Point centre_of_mass(const TestMesh& mesh) {
  double volume = 0;
  Point moment{};
  for (std::size_t t = 0; t < mesh.indices.size() / 3; ++t) {
    const Point a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
    const double v = dot(a, cross(b, c)) / 6;
    volume += v;
    moment = moment + (v / 4) * (a + b + c);
  }
  return (1 / volume) * moment;
}

}  // namespace ode_ext::stability
