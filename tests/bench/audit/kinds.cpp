// SPDX-License-Identifier: BSD-3-Clause
#include "bench/audit/kinds.h"

#include <cmath>
#include <numbers>

namespace ode_ext::audit {
namespace {

using namespace test;

template <typename Map>
TestMesh mapped(TestMesh mesh, const Map& map) {
  for (std::size_t i = 0; i < mesh.vertices.size(); i += 3) {
    const Point p = map(mesh.vertex(i / 3));
    for (std::size_t k = 0; k < 3; ++k) mesh.vertices[i + k] = static_cast<float>(p[k]);
  }
  return mesh;
}

// Its far end is a fifth as thick as the near one.
TestMesh needle() {
  const double length = 1.4;
  return mapped(make_rod(length, 0.08), [&](const Point& p) {
    const double thickness = 0.6 - 0.8 * p[0] / length;
    return Point{p[0], thickness * p[1], thickness * p[2]};
  });
}

TestMesh bumpy_torus(int around, int across) {
  const double ring = 0.4, tube = 0.15;
  return mapped(make_torus(ring, tube, around, across), [&](const Point& p) {
    const Point middle = ring * unit({p[0], p[1], 0});
    const double bump = 0.2 * std::sin(5 * std::atan2(p[1], p[0])) * std::cos(14 * p[2]);
    return middle + (1 + bump) * (p - middle);
  });
}

// Spikes and dents: no line from the middle meets it twice.
TestMesh star() {
  return mapped(make_icosphere(1, 3), [](const Point& p) {
    return (0.36 + 0.2 * std::sin(6 * p[0]) * std::cos(5 * p[1] + 1) * std::cos(6 * p[2])) * p;
  });
}

TestMesh boulder() {
  return mapped(make_cube(1, 76), [](const Point& corner) {
    const Point p = unit(corner);
    const double hills = std::sin(5 * p[0] + 1) * std::sin(6 * p[1]) * std::cos(5 * p[2]);
    const double grit = std::sin(41 * p[0]) * std::sin(37 * p[1]) * std::sin(43 * p[2]);
    return (0.5 + 0.05 * hills + 0.004 * grit) * p;
  });
}

TestMesh terrain() {
  return mapped(make_sheet(1.6, 30), [](const Point& p) {
    return Point{p[0], p[1], 0.12 * std::sin(4 * p[0] + 0.5) * std::cos(5 * p[1])};
  });
}

// The squares of a sheet become the circles of a ball, from a pole to a little beyond the equator.
TestMesh bowl() {
  return mapped(make_sheet(1, 16), [](const Point& p) {
    const double angle = 0.55 * std::numbers::pi * largest_component(p) / 0.5;
    const Point around = unit(p);
    return 0.45 * Point{std::sin(angle) * around[0], std::sin(angle) * around[1], -std::cos(angle)};
  });
}

}  // namespace

std::vector<Kind> make_kinds() {
  return {{"cube", make_cube(0.8)},
          {"needle", needle()},
          {"u_beam", make_comb(2, 0.25, 0.6, 0.25)},
          {"plate", make_plate(1, 0.03, 6)},
          {"ring", bumpy_torus(12, 8)},
          {"star", star()},
          {"torus", bumpy_torus(72, 36)},
          {"boulder", boulder()},
          {"terrain", terrain()},
          {"bowl", bowl()}};
}

}  // namespace ode_ext::audit
