// SPDX-License-Identifier: BSD-3-Clause
#include "makers/swept.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "meshes/bands.h"

namespace falling_objects {
namespace {

constexpr double kPi = std::numbers::pi;

struct PathPoint {
  double x, z;
  double heading;     // of the path, from x towards z [rad]
  double shrink = 1;  // of the wire here
};

void add_rings(TriangleMesh& mesh, const std::vector<PathPoint>& path, double radius,
               unsigned sides) {
  for (const PathPoint& p : path) {
    for (unsigned i = 0; i < sides; ++i) {
      // y and the normal of the path in its plane, which are right-handed with its heading.
      const double angle = 2 * kPi * i / sides, r = radius * p.shrink;
      const double aside = r * std::cos(angle), up = r * std::sin(angle);
      mesh.add_vertex({p.x - up * std::sin(p.heading), aside, p.z + up * std::cos(p.heading)});
    }
  }
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const auto ring = static_cast<unsigned>(i) * sides;
    add_band(mesh, ring, ring + sides, sides);
  }
}

// As long as the wire's sides are wide.
unsigned pieces(double length, double wire, unsigned sides) {
  return static_cast<unsigned>(std::max(1.0, std::ceil(length / (2 * kPi * wire / sides))));
}

// Appends points after the first of an arc about (x, z), and of a straight way.
void add_arc(std::vector<PathPoint>& path, double x, double z, double radius, double from,
             double angle, unsigned count) {
  for (unsigned i = 1; i <= count; ++i) {
    const double at = from + angle * i / count;
    const double heading = at + std::copysign(kPi / 2, angle);
    path.push_back({x + radius * std::cos(at), z + radius * std::sin(at), heading});
  }
}

void add_line(std::vector<PathPoint>& path, double length, unsigned count) {
  const PathPoint from = path.back();
  for (unsigned i = 1; i <= count; ++i) {
    const double way = length * i / count;
    path.push_back({from.x + way * std::cos(from.heading), from.z + way * std::sin(from.heading),
                    from.heading});
  }
}

}  // namespace

TriangleMesh make_link(double length, double width, double wire, unsigned sides) {
  const double bend = width / 2 + wire;    // radius of the middle of the wire
  const double straight = length - width;  // between the two half circles
  const unsigned round = pieces(kPi * bend, wire, sides);
  const unsigned along = pieces(straight, wire, sides);
  std::vector<PathPoint> path{{bend, -straight / 2, kPi / 2}};
  add_line(path, straight, along);
  add_arc(path, 0, straight / 2, bend, 0, kPi, round);
  add_line(path, straight, along);
  add_arc(path, 0, -straight / 2, bend, kPi, kPi, round);
  path.pop_back();  // the first again
  TriangleMesh mesh;
  add_rings(mesh, path, wire, sides);
  add_band(mesh, static_cast<unsigned>(path.size() - 1) * sides, 0, sides);
  return mesh;
}

TriangleMesh make_hook(double radius, double shank, double tip, double wire, unsigned sides) {
  std::vector<PathPoint> path{{-radius, shank, -kPi / 2}};
  add_line(path, shank, pieces(shank, wire, sides));
  add_arc(path, 0, 0, radius, kPi, kPi, pieces(kPi * radius, wire, sides));
  if (tip > 0) add_line(path, tip, pieces(tip, wire, sides));

  const unsigned cap = std::max(2u, sides / 4);
  const auto ball = [&](const PathPoint& end, double latitude) {
    const double way = wire * std::sin(latitude);
    return PathPoint{end.x + way * std::cos(end.heading), end.z + way * std::sin(end.heading),
                     end.heading, std::cos(latitude)};
  };
  std::vector<PathPoint> whole;
  for (unsigned i = cap - 1; i > 0; --i) whole.push_back(ball(path.front(), -kPi / 2 * i / cap));
  whole.insert(whole.end(), path.begin(), path.end());
  for (unsigned i = 1; i < cap; ++i) whole.push_back(ball(path.back(), kPi / 2 * i / cap));
  TriangleMesh mesh;
  add_rings(mesh, whole, wire, sides);
  const auto pole = [&](const PathPoint& end, double latitude) {
    const PathPoint p = ball(end, latitude);
    return mesh.add_vertex({p.x, 0, p.z});
  };
  add_fan(mesh, 0, pole(path.front(), -kPi / 2), sides, false);
  add_fan(mesh, static_cast<unsigned>(whole.size() - 1) * sides, pole(path.back(), kPi / 2), sides,
          true);
  return mesh;
}

}  // namespace falling_objects
