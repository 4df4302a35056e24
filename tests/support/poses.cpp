// SPDX-License-Identifier: BSD-3-Clause
// Poses and random numbers of mesh_makers.h.
#include <cmath>
#include <numbers>

#include "support/mesh_makers.h"

namespace ode_ext::test {
namespace {

// Rodrigues' formula with sine and cosine of the angle given; the axis is unit.
std::array<double, 9> rotation_about(const Point& n, double s, double c) {
  std::array<double, 9> r{};
  const double k = 1 - c;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) r[3 * i + j] = k * n[i] * n[j] + (i == j ? c : 0);
  }
  r[1] -= s * n[2], r[2] += s * n[1], r[3] += s * n[2];
  r[5] -= s * n[0], r[6] -= s * n[1], r[7] += s * n[0];
  return r;
}

}  // namespace

Point rotate(const TestPose& pose, const Point& v) {
  const auto& r = pose.rotation;
  return {r[0] * v[0] + r[1] * v[1] + r[2] * v[2], r[3] * v[0] + r[4] * v[1] + r[5] * v[2],
          r[6] * v[0] + r[7] * v[1] + r[8] * v[2]};
}

Point rotate_back(const TestPose& pose, const Point& v) {
  const auto& r = pose.rotation;
  return {r[0] * v[0] + r[3] * v[1] + r[6] * v[2], r[1] * v[0] + r[4] * v[1] + r[7] * v[2],
          r[2] * v[0] + r[5] * v[1] + r[8] * v[2]};
}

Point to_world(const TestPose& pose, const Point& local) {
  return rotate(pose, local) + pose.position;
}

Point to_local(const TestPose& pose, const Point& world) {
  return rotate_back(pose, world - pose.position);
}

TestPose at(double x, double y, double z) { return {.position = {x, y, z}}; }

TestPose turned(const Point& axis, double angle, const Point& position) {
  return {position, rotation_about(unit(axis), std::sin(angle), std::cos(angle))};
}

TestPose composed(const TestPose& outer, const TestPose& inner) {
  TestPose pose{.position = to_world(outer, inner.position)};
  for (std::size_t j = 0; j < 3; ++j) {
    const Point column =
        rotate(outer, {inner.rotation[j], inner.rotation[3 + j], inner.rotation[6 + j]});
    for (std::size_t i = 0; i < 3; ++i) pose.rotation[3 * i + j] = column[i];
  }
  return pose;
}

std::uint64_t Random::next() {
  std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

double Random::uniform(double lo, double hi) {
  return lo + (hi - lo) * (static_cast<double>(next() >> 11) * 0x1p-53);
}

int Random::below(int n) { return static_cast<int>(next() % static_cast<std::uint64_t>(n)); }

Point Random::direction() {
  const double z = uniform(-1, 1), a = uniform(0, 2 * std::numbers::pi);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(a), r * std::sin(a), z};
}

TestPose Random::pose(double half_extent) {
  // Shoemake 1992: a uniform unit quaternion.
  const double u = uniform(0, 1), a = uniform(0, 2 * std::numbers::pi),
               b = uniform(0, 2 * std::numbers::pi);
  const double p = std::sqrt(1 - u), q = std::sqrt(u);
  const double w = q * std::cos(b);
  const Point v{p * std::sin(a), p * std::cos(a), q * std::sin(b)};
  const double half_sine = length(v);
  const auto rotation = rotation_about(unit(v), 2 * half_sine * w, w * w - half_sine * half_sine);
  const double x = uniform(-half_extent, half_extent), y = uniform(-half_extent, half_extent);
  return {{x, y, uniform(-half_extent, half_extent)}, rotation};
}

}  // namespace ode_ext::test
