// SPDX-License-Identifier: BSD-3-Clause
#include "support/oracle_meshes.h"

#include <numbers>

namespace ode_ext::oracle {
namespace {

constexpr double kPi = std::numbers::pi;

struct Draft {
  std::vector<float> vertices;
  std::vector<unsigned> indices;

  void add(double x, double y, double z) {
    for (const double c : {x, y, z}) vertices.push_back(static_cast<float>(c));
  }
  void add_quad(unsigned a, unsigned b, unsigned c, unsigned d) {
    indices.insert(indices.end(), {a, b, c, a, c, d});
  }
  Mesh finish() const { return Mesh(vertices, indices); }
};

}  // namespace

Mesh make_box(Vector half) {
  Draft box;
  for (unsigned i = 0; i < 8; ++i) {
    box.add(i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 4 ? half.z : -half.z);
  }
  box.add_quad(0, 2, 3, 1);
  box.add_quad(4, 5, 7, 6);
  box.add_quad(0, 1, 5, 4);
  box.add_quad(2, 6, 7, 3);
  box.add_quad(0, 4, 6, 2);
  box.add_quad(1, 3, 7, 5);
  return box.finish();
}

Mesh make_sphere(double radius, unsigned rings, unsigned sides) {
  Draft sphere;
  for (unsigned i = 1; i < rings; ++i) {
    const double latitude = kPi * i / rings - kPi / 2;
    for (unsigned j = 0; j < sides; ++j) {
      const double longitude = 2 * kPi * j / sides;
      sphere.add(radius * std::cos(latitude) * std::cos(longitude),
                 radius * std::cos(latitude) * std::sin(longitude), radius * std::sin(latitude));
    }
  }
  const unsigned south = (rings - 1) * sides, north = south + 1;
  sphere.add(0, 0, -radius);
  sphere.add(0, 0, radius);
  for (unsigned j = 0; j < sides; ++j) {
    const unsigned next = (j + 1) % sides, top = (rings - 2) * sides;
    sphere.indices.insert(sphere.indices.end(), {next, j, south, top + j, top + next, north});
    for (unsigned i = 0; i + 2 < rings; ++i) {
      sphere.add_quad(i * sides + j, i * sides + next, (i + 1) * sides + next, (i + 1) * sides + j);
    }
  }
  return sphere.finish();
}

// A flat quad lies deepest at its middle: a half-angle inside the arc in both directions.
double sphere_sag(double radius, unsigned rings, unsigned sides) {
  return radius * (1 - std::cos(kPi / rings / 2) * std::cos(kPi / sides));
}

Mesh make_torus(double ring_radius, double tube_radius, unsigned rings, unsigned sides) {
  Draft torus;
  for (unsigned i = 0; i < rings; ++i) {
    const double u = 2 * kPi * i / rings;
    for (unsigned j = 0; j < sides; ++j) {
      const double v = 2 * kPi * j / sides;
      const double r = ring_radius + tube_radius * std::cos(v);
      torus.add(r * std::cos(u), r * std::sin(u), tube_radius * std::sin(v));
    }
  }
  for (unsigned i = 0; i < rings; ++i) {
    for (unsigned j = 0; j < sides; ++j) {
      const unsigned next_i = (i + 1) % rings, next_j = (j + 1) % sides;
      torus.add_quad(i * sides + j, next_i * sides + j, next_i * sides + next_j,
                     i * sides + next_j);
    }
  }
  return torus.finish();
}

}  // namespace ode_ext::oracle
