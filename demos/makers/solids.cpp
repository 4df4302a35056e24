// SPDX-License-Identifier: BSD-3-Clause
#include "makers/solids.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "meshes/bands.h"
#include "meshes/random.h"

namespace falling_objects {
namespace {

constexpr double kPi = std::numbers::pi;

struct OutlinePoint {
  double r, z;
};
using Outline = std::vector<OutlinePoint>;

// Turned about z. The outline has the solid on its left, r to the right and z up: either a loop, or
// it begins and ends on the axis.
TriangleMesh revolve(const Outline& outline, unsigned sides) {
  TriangleMesh mesh;
  std::vector<unsigned> rings;
  for (const auto& [r, z] : outline) {
    rings.push_back(static_cast<unsigned>(mesh.vertex_count()));
    if (r == 0) {
      mesh.add_vertex({0, 0, z});
      continue;
    }
    for (unsigned i = 0; i < sides; ++i) {
      const double angle = 2 * kPi * i / sides;
      mesh.add_vertex({r * std::cos(angle), r * std::sin(angle), z});
    }
  }
  const bool loop = outline.front().r != 0;
  for (std::size_t i = 0; i + (loop ? 0 : 1) < outline.size(); ++i) {
    const std::size_t j = (i + 1) % outline.size();
    if (outline[i].r == 0) {
      add_fan(mesh, rings[j], rings[i], sides, false);
    } else if (outline[j].r == 0) {
      add_fan(mesh, rings[i], rings[j], sides, true);
    } else {
      add_band(mesh, rings[i], rings[j], sides);
    }
  }
  return mesh;
}

// As tall as wide cells, so that no triangle is a sliver.
unsigned rows_for(double height, double radius, unsigned sides) {
  const double side = 2 * kPi * radius / sides;
  return static_cast<unsigned>(std::max(1.0, std::round(height / side)));
}

Outline circle(double ring, double radius, unsigned sides) {
  Outline outline;
  for (unsigned i = 0; i < sides; ++i) {
    const double angle = 2 * kPi * i / sides;
    outline.push_back({ring + radius * std::cos(angle), radius * std::sin(angle)});
  }
  return outline;
}

// From the lower pole to the upper.
Outline half_circle(double radius, unsigned rows) {
  Outline outline{{0, -radius}};
  for (unsigned i = 1; i < rows; ++i) {
    const double angle = kPi * i / rows;
    outline.push_back({radius * std::sin(angle), -radius * std::cos(angle)});
  }
  outline.push_back({0, radius});
  return outline;
}

void append(TriangleMesh& mesh, const TriangleMesh& other) {
  const auto first = static_cast<unsigned>(mesh.vertex_count());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const unsigned index : other.indices) mesh.indices.push_back(first + index);
}

}  // namespace

TriangleMesh make_box(double x, double y, double z, unsigned cells) {
  TriangleMesh mesh;
  // Vertices live on an integer grid, so that neighboring faces find each other's.
  using Cell = std::array<unsigned, 3>;
  std::map<Cell, unsigned> numbers;
  const Point size{x, y, z};
  const auto number = [&](const Cell& cell) {
    const auto [at, is_new] = numbers.try_emplace(cell, 0u);
    if (is_new) {
      Point p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = size[k] * (double(cell[k]) / cells - 0.5);
      at->second = mesh.add_vertex(p);
    }
    return at->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const unsigned end : {0u, cells}) {
      for (unsigned u = 0; u < cells; ++u) {
        for (unsigned v = 0; v < cells; ++v) {
          const auto corner = [&](unsigned du, unsigned dv) {
            Cell cell;
            cell[axis] = end;
            cell[(axis + 1) % 3] = u + du;
            cell[(axis + 2) % 3] = v + dv;
            return number(cell);
          };
          const std::array<unsigned, 4> q{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
          if (end > 0) {
            mesh.add_quad(q[0], q[1], q[2], q[3]);
          } else {
            mesh.add_quad(q[3], q[2], q[1], q[0]);
          }
        }
      }
    }
  }
  return mesh;
}

TriangleMesh make_cylinder(double radius, double height, unsigned sides) {
  const unsigned rows = rows_for(height, radius, sides);
  Outline outline{{0, -height / 2}};
  for (unsigned i = 0; i <= rows; ++i)
    outline.push_back({radius, height * (double(i) / rows - .5)});
  outline.push_back({0, height / 2});
  return revolve(outline, sides);
}

TriangleMesh make_sphere(double radius, unsigned sides) {
  return revolve(half_circle(radius, sides / 2), sides);
}

TriangleMesh make_torus(double ring, double tube, unsigned sides, unsigned tube_sides) {
  return revolve(circle(ring, tube, tube_sides), sides);
}

TriangleMesh make_pipe(double outer, double inner, double height, unsigned sides) {
  const unsigned rows = rows_for(height, outer, sides);
  Outline outline;
  for (unsigned i = 0; i <= rows; ++i) outline.push_back({outer, height * (double(i) / rows - .5)});
  for (unsigned i = 0; i <= rows; ++i) outline.push_back({inner, height * (.5 - double(i) / rows)});
  return revolve(outline, sides);
}

TriangleMesh make_shell(double outer, double inner, unsigned sides) {
  TriangleMesh mesh = make_sphere(outer, sides);
  TriangleMesh cavity = make_sphere(inner, sides);
  turn_inside_out(cavity);
  append(mesh, cavity);
  return mesh;
}

TriangleMesh make_cup(double radius, double height, double wall, unsigned sides) {
  const unsigned rows = rows_for(height, radius, sides);
  const double bottom = -height / 2, floor = bottom + wall, top = height / 2;
  Outline outline{{0, bottom}};
  for (unsigned i = 0; i <= rows; ++i) outline.push_back({radius, bottom + height * i / rows});
  for (unsigned i = 0; i <= rows; ++i)
    outline.push_back({radius - wall, top - (top - floor) * i / rows});
  outline.push_back({0, floor});
  return revolve(outline, sides);
}

TriangleMesh make_rock(double radius, double roughness, unsigned sides, std::uint64_t seed) {
  Random random(seed);
  struct Bump {
    Point direction;
    double phase;
  };
  std::vector<Bump> bumps;
  for (int i = 0; i < 8; ++i) {
    const auto draw = [&] { return random.between(-3, 3); };
    bumps.push_back({{draw(), draw(), draw()}, random.between(0, 2 * kPi)});
  }
  TriangleMesh mesh = make_sphere(1, sides);
  for (std::size_t i = 0; i < mesh.vertices.size(); i += 3) {
    float* v = &mesh.vertices[i];
    double scale = 1;
    for (const auto& [d, phase] : bumps) {
      scale += roughness / 4 * std::sin(d[0] * v[0] + d[1] * v[1] + d[2] * v[2] + phase);
    }
    for (int k = 0; k < 3; ++k) v[k] = static_cast<float>(radius * scale * v[k]);
  }
  return mesh;
}

}  // namespace falling_objects
