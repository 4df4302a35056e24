// SPDX-License-Identifier: BSD-3-Clause
// Solids of one profile: what fills it, and a wall about it.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "support/mesh_makers.h"

namespace ode_ext::test {

using Profile = std::vector<std::array<double, 2>>;  // counter-clockwise

inline double turn(const std::array<double, 2>& a, const std::array<double, 2>& b,
                   const std::array<double, 2>& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

inline bool is_ear(const Profile& profile, const std::vector<unsigned>& left, std::size_t at) {
  const std::size_t n = left.size();
  const auto &a = profile[left[(at + n - 1) % n]], &b = profile[left[at]],
             &c = profile[left[(at + 1) % n]];
  if (turn(a, b, c) <= 0) return false;
  for (const unsigned other : left) {
    const auto& p = profile[other];
    if (p == a || p == b || p == c) continue;
    if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
  }
  return true;
}

// Cut into triangles by clipping ears (Meisters 1975).
inline std::vector<unsigned> triangles_of(const Profile& profile) {
  std::vector<unsigned> left(profile.size()), triangles;
  for (unsigned i = 0; i < left.size(); ++i) left[i] = i;
  while (left.size() > 3) {
    std::size_t at = 0;
    while (at < left.size() && !is_ear(profile, left, at)) ++at;
    const std::size_t n = left.size();
    if (at == n) return {};
    triangles.insert(triangles.end(), {left[(at + n - 1) % n], left[at], left[(at + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
  }
  triangles.insert(triangles.end(), left.begin(), left.end());
  return triangles;
}

// Along z, about 0.
inline TestMesh extruded(const Profile& profile, double length) {
  TestMesh mesh;
  const auto n = static_cast<unsigned>(profile.size());
  for (const double z : {-0.5 * length, 0.5 * length})
    for (const auto& [x, y] : profile)
      for (const double v : {x, y, z}) mesh.vertices.push_back(static_cast<float>(v));
  const auto add = [&](unsigned a, unsigned b, unsigned c) {
    mesh.indices.insert(mesh.indices.end(), {a, b, c});
  };
  for (unsigned i = 0; i < n; ++i) {
    const unsigned j = (i + 1) % n;
    add(i, j, j + n);
    add(i, j + n, i + n);
  }
  const std::vector<unsigned> cap = triangles_of(profile);
  for (std::size_t k = 0; k < cap.size(); k += 3) {
    add(cap[k], cap[k + 2], cap[k + 1]);
    add(cap[k] + n, cap[k + 1] + n, cap[k + 2] + n);
  }
  return mesh;
}

// A wall about a hole of this profile.
inline TestMesh hub(const Profile& profile, double radius, double length) {
  TestMesh mesh;
  const auto n = static_cast<unsigned>(profile.size());
  for (const double z : {-0.5 * length, 0.5 * length})
    for (const bool outer : {false, true})
      for (const auto& [x, y] : profile) {
        const double size = outer ? radius / std::hypot(x, y) : 1;
        for (const double v : {size * x, size * y, z})
          mesh.vertices.push_back(static_cast<float>(v));
      }
  for (unsigned i = 0; i < n; ++i) {
    const unsigned j = (i + 1) % n;
    for (const auto& q : {std::array{j, i, 2 * n + i, 2 * n + j},
                          {n + i, n + j, 3 * n + j, 3 * n + i},
                          {i, j, n + j, n + i},
                          {2 * n + j, 2 * n + i, 3 * n + i, 3 * n + j}})
      mesh.indices.insert(mesh.indices.end(), {q[0], q[1], q[2], q[0], q[2], q[3]});
  }
  return mesh;
}

inline Profile polygon(int corners, double radius) {
  Profile profile;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    profile.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return profile;
}

}  // namespace ode_ext::test
