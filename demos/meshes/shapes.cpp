// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/shapes.h"

#include <cmath>
#include <map>
#include <numbers>

#include "meshes/bands.h"

namespace falling_objects {
namespace {

constexpr double kPi = std::numbers::pi;

}  // namespace

// 2 * 11 sides * 41 rings = 902: 40 bands of quads and two fans of triangles.
TriangleMesh make_horseshoe() {
  constexpr unsigned kSides = 11, kCapRings = 4, kRings = 41;
  constexpr double kBend = 0.34, kTube = 0.13, kHalfAngle = 2.0;  // [m], [m], [rad]
  TriangleMesh mesh;
  // A point at `angle` along the arc, `beyond` it along the tangent, `radius` from the centre line.
  const auto point = [&](double angle, double beyond, double radius, double around) {
    const double r = kBend + radius * std::cos(around);
    return Point{r * std::cos(angle) - beyond * std::sin(angle),
                 r * std::sin(angle) + beyond * std::cos(angle), -radius * std::sin(around)};
  };
  for (unsigned ring = 0; ring < kRings; ++ring) {
    // The first and last rings round the ends off, the others follow the arc.
    const double at = ring;
    const double last = kRings - 1;
    const double first_arc = kCapRings, last_arc = last - kCapRings;
    double angle = kHalfAngle, latitude = 0;
    if (at < first_arc) {
      angle = -kHalfAngle;
      latitude = -(first_arc - at) / (kCapRings + 1.0) * kPi / 2;
    } else if (at > last_arc) {
      latitude = (at - last_arc) / (kCapRings + 1.0) * kPi / 2;
    } else {
      angle = kHalfAngle * (2 * (at - first_arc) / (last_arc - first_arc) - 1);
    }
    for (unsigned side = 0; side < kSides; ++side) {
      mesh.add_vertex(point(angle, kTube * std::sin(latitude), kTube * std::cos(latitude),
                            2 * kPi * side / kSides));
    }
  }
  const unsigned south = mesh.add_vertex(point(-kHalfAngle, -kTube, 0, 0));
  const unsigned north = mesh.add_vertex(point(kHalfAngle, kTube, 0, 0));
  for (unsigned ring = 0; ring + 1 < kRings; ++ring) {
    add_band(mesh, ring * kSides, (ring + 1) * kSides, kSides);
  }
  add_fan(mesh, 0, south, kSides, false);
  add_fan(mesh, (kRings - 1) * kSides, north, kSides, true);
  normalise(mesh, kShapeRadius);
  return mesh;
}

// 2 * 71 rings * 15 sides = 2,130.
TriangleMesh make_bumpy_torus() {
  constexpr unsigned kRings = 71, kSides = 15;
  constexpr double kRing = 0.32, kTube = 0.13, kBump = 0.022;  // [m]
  TriangleMesh mesh;
  for (unsigned ring = 0; ring < kRings; ++ring) {
    const double u = 2 * kPi * ring / kRings;
    for (unsigned side = 0; side < kSides; ++side) {
      const double v = 2 * kPi * side / kSides;
      const double tube = kTube + kBump * std::cos(7 * u) * std::cos(2 * v);
      const double r = kRing + tube * std::cos(v);
      mesh.add_vertex({r * std::cos(u), r * std::sin(u), -tube * std::sin(v)});
    }
  }
  for (unsigned ring = 0; ring < kRings; ++ring) {
    add_band(mesh, ring * kSides, (ring + 1) % kRings * kSides, kSides);
  }
  normalise(mesh, kShapeRadius);
  return mesh;
}

// Six arms, each with four flat sides of 4 x 16 quads and a cap of 4 x 4:
// 6 * (4 * 64 + 16) quads = 3,264 triangles.
TriangleMesh make_jack() {
  constexpr int kAcross = 4, kAlong = 16;
  constexpr double kHalfWidth = 0.10, kReach = 0.48;  // [m]
  TriangleMesh mesh;
  // Vertices live on an integer grid, so that neighbouring faces find each other's vertices.
  std::map<std::array<int, 3>, unsigned> numbers;
  const auto place = [&](int i) {
    constexpr int kCore = kAcross / 2;
    if (std::abs(i) <= kCore) return kHalfWidth * i / kCore;
    const double beyond = static_cast<double>(std::abs(i) - kCore) / kAlong;
    return std::copysign(kHalfWidth + beyond * (kReach - kHalfWidth), i);
  };
  const auto number = [&](const std::array<int, 3>& cell) {
    const auto [at, is_new] = numbers.try_emplace(cell, 0u);
    if (is_new) at->second = mesh.add_vertex({place(cell[0]), place(cell[1]), place(cell[2])});
    return at->second;
  };
  // A flat face of `nu` x `nv` quads; eu x ev points outwards.
  const auto face = [&](std::array<int, 3> origin, std::array<int, 3> eu, std::array<int, 3> ev,
                        int nu, int nv) {
    const auto at = [&](int u, int v) {
      return number({origin[0] + u * eu[0] + v * ev[0], origin[1] + u * eu[1] + v * ev[1],
                     origin[2] + u * eu[2] + v * ev[2]});
    };
    for (int u = 0; u < nu; ++u) {
      for (int v = 0; v < nv; ++v)
        mesh.add_quad(at(u, v), at(u + 1, v), at(u + 1, v + 1), at(u, v + 1));
    }
  };
  constexpr int kCore = kAcross / 2, kEnd = kCore + kAlong;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int sign : {-1, 1}) {
      // Right-handed frame (p, q, r), r along the arm.
      std::array<int, 3> p{}, q{}, r{};
      r[axis] = sign;
      p[(axis + 1) % 3] = 1;
      q[(axis + 2) % 3] = sign;
      const auto corner = [&](int a, int b, int c) {
        return std::array<int, 3>{a * p[0] + b * q[0] + c * r[0], a * p[1] + b * q[1] + c * r[1],
                                  a * p[2] + b * q[2] + c * r[2]};
      };
      const auto minus = [](std::array<int, 3> e) { return std::array{-e[0], -e[1], -e[2]}; };
      face(corner(-kCore, -kCore, kEnd), p, q, kAcross, kAcross);
      face(corner(kCore, -kCore, kCore), q, r, kAcross, kAlong);
      face(corner(kCore, kCore, kCore), minus(p), r, kAcross, kAlong);
      face(corner(-kCore, kCore, kCore), minus(q), r, kAcross, kAlong);
      face(corner(-kCore, -kCore, kCore), p, r, kAcross, kAlong);
    }
  }
  normalise(mesh, kShapeRadius);
  return mesh;
}

// An outline of 91 vertices, extruded in 8 layers; each flat side is a fan and 5 bands:
// 2 * 91 * 8 + 2 * (91 + 2 * 91 * 5) = 3,458.
TriangleMesh make_gear() {
  constexpr unsigned kTeeth = 7, kPerTooth = 13, kOutline = kTeeth * kPerTooth;
  constexpr unsigned kLayers = 8, kRings = 6;
  constexpr double kRoot = 0.30, kTip = 0.48, kHalfHeight = 0.11;  // [m]
  // One tooth: five vertices along the straight tip, two more down each straight flank, the rest
  // in the gap. Each is (position along the pitch, height between root and tip).
  constexpr std::array<std::array<double, 2>, kPerTooth> kProfile{{{0.00, 0},
                                                                   {0.09, 0},
                                                                   {0.18, 0},
                                                                   {0.2167, 0.3333},
                                                                   {0.2533, 0.6667},
                                                                   {0.29, 1},
                                                                   {0.395, 1},
                                                                   {0.50, 1},
                                                                   {0.605, 1},
                                                                   {0.71, 1},
                                                                   {0.7467, 0.6667},
                                                                   {0.7833, 0.3333},
                                                                   {0.82, 0}}};
  TriangleMesh mesh;
  const auto ring = [&](double scale, double z) {
    const auto first = static_cast<unsigned>(mesh.vertex_count());
    for (unsigned i = 0; i < kOutline; ++i) {
      const auto& [along, height] = kProfile[i % kPerTooth];
      const double angle = 2 * kPi * (i / kPerTooth + along) / kTeeth;
      const double r = scale * (kRoot + height * (kTip - kRoot));
      mesh.add_vertex({r * std::cos(angle), r * std::sin(angle), z});
    }
    return first;
  };
  std::vector<unsigned> rings;
  for (unsigned i = 1; i < kRings; ++i) rings.push_back(ring(double(i) / kRings, -kHalfHeight));
  for (unsigned i = 0; i <= kLayers; ++i) {
    rings.push_back(ring(1, kHalfHeight * (2.0 * i / kLayers - 1)));
  }
  for (unsigned i = kRings - 1; i > 0; --i) rings.push_back(ring(double(i) / kRings, kHalfHeight));
  for (std::size_t i = 0; i + 1 < rings.size(); ++i)
    add_band(mesh, rings[i], rings[i + 1], kOutline);
  add_fan(mesh, rings.front(), mesh.add_vertex({0, 0, -kHalfHeight}), kOutline, false);
  add_fan(mesh, rings.back(), mesh.add_vertex({0, 0, kHalfHeight}), kOutline, true);
  normalise(mesh, kShapeRadius);
  return mesh;
}

std::vector<NamedMesh> make_shapes() {
  return {{"horseshoe", make_horseshoe()},
          {"bumpy torus", make_bumpy_torus()},
          {"jack", make_jack()},
          {"gear", make_gear()}};
}

}  // namespace falling_objects
