// SPDX-License-Identifier: BSD-3-Clause
#include "makers/spur_gear.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "meshes/bands.h"

namespace falling_objects {
namespace {

constexpr double kPi = std::numbers::pi;
// Steeper than most gears' 20 degrees: from 12 teeth on no tip gets into the foot of another tooth.
constexpr double kPressureAngle = 25 * kPi / 180;  // [rad]
constexpr double kAddendum = 1, kDedendum = 1.25;  // beyond and below the pitch circle [module]
constexpr double kFoot = 0.15;                     // of the gap that the foot of a tooth takes
constexpr unsigned kOnFlank = 6;                   // vertices from root to tip
constexpr unsigned kLayers = 3;

struct Polar {
  double radius, angle;
};

double involute(double angle) { return std::tan(angle) - angle; }

// Counter-clockwise, tooth by tooth.
std::vector<Polar> make_outline(const SpurGear& gear) {
  const double pitch = gear.module * gear.teeth / 2;
  const double base = pitch * std::cos(kPressureAngle);
  const double tip = pitch + kAddendum * gear.module, root = pitch - kDedendum * gear.module;
  const double half_at_pitch = kPi / (2 * gear.teeth) - gear.backlash / (4 * pitch);
  // Half the angle that a tooth takes at a radius; a little more where it is below the base circle.
  const auto half = [&](double radius) {
    const double pressure = std::acos(base / std::max(radius, base));
    const double angle = half_at_pitch + involute(kPressureAngle) - involute(pressure);
    return radius < base ? angle + kFoot * (kPi / gear.teeth - angle) : angle;
  };
  std::vector<Polar> rising;
  if (root < base) rising.push_back({root, half(root)});
  for (unsigned i = 0; i < kOnFlank; ++i) {
    const double start = std::max(root, base);
    const double radius = start + (tip - start) * i / (kOnFlank - 1);
    rising.push_back({radius, half(radius)});
  }
  std::vector<Polar> outline;
  for (unsigned tooth = 0; tooth < gear.teeth; ++tooth) {
    const double middle = 2 * kPi * tooth / gear.teeth;
    for (const Polar& p : rising) outline.push_back({p.radius, middle - p.angle});
    outline.push_back({tip, middle});
    for (auto p = rising.rbegin(); p != rising.rend(); ++p)
      outline.push_back({p->radius, middle + p->angle});
    outline.push_back({root, middle + kPi / gear.teeth});
  }
  return outline;
}

}  // namespace

TriangleMesh make_spur_gear(const SpurGear& gear) {
  const std::vector<Polar> outline = make_outline(gear);
  const auto count = static_cast<unsigned>(outline.size());
  TriangleMesh mesh;
  const auto add = [&](double radius, double angle, double z) {
    return mesh.add_vertex({radius * std::cos(angle), radius * std::sin(angle), z});
  };
  const auto ring = [&](double z) {
    const auto first = static_cast<unsigned>(mesh.vertex_count());
    for (const auto& [radius, angle] : outline) add(radius, angle, z);
    return first;
  };
  const auto hole = [&](double z) {
    const auto first = static_cast<unsigned>(mesh.vertex_count());
    for (unsigned i = 0; i < count; ++i)
      add(gear.bore, outline.front().angle + 2 * kPi * i / count, z);
    return first;
  };
  const double half = gear.thickness / 2;
  std::vector<unsigned> rings;
  for (unsigned i = 0; i <= kLayers; ++i) rings.push_back(ring(half * (2.0 * i / kLayers - 1)));
  if (gear.bore > 0) {
    rings.push_back(hole(half));
    rings.push_back(hole(-half));
    rings.push_back(rings.front());
  }
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) add_band(mesh, rings[i], rings[i + 1], count);
  if (gear.bore == 0) {
    add_fan(mesh, rings.front(), mesh.add_vertex({0, 0, -half}), count, false);
    add_fan(mesh, rings.back(), mesh.add_vertex({0, 0, half}), count, true);
  }
  return mesh;
}

}  // namespace falling_objects
