// SPDX-License-Identifier: BSD-3-Clause
// Vectors of the penetration oracle, which shares nothing with the library it judges.
#pragma once

#include <array>
#include <cmath>

namespace ode_ext::oracle {

struct Vector {
  double x = 0, y = 0, z = 0;

  bool operator==(const Vector&) const = default;
  auto operator<=>(const Vector&) const = default;
};

inline Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector operator*(double s, Vector a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector cross(Vector a, Vector b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vector a) { return std::sqrt(dot(a, a)); }
// The zero vector stays zero.
inline Vector unit(Vector a) {
  const double l = length(a);
  return l > 0 ? (1 / l) * a : a;
}

// Where a mesh is: world = rotation * local + position.
struct Pose {
  std::array<Vector, 3> rows{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  // of the rotation
  Vector position;                                                // [m]

  Vector to_world(Vector p) const {
    return Vector{dot(rows[0], p), dot(rows[1], p), dot(rows[2], p)} + position;
  }
  Vector to_local(Vector world) const {
    const Vector p = world - position;
    return p.x * rows[0] + p.y * rows[1] + p.z * rows[2];
  }
};

}  // namespace ode_ext::oracle
