// SPDX-License-Identifier: BSD-3-Clause
#include "makers/thread.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "meshes/bands.h"

namespace falling_objects {
namespace {

constexpr double kPi = std::numbers::pi;

// Shares of a pitch: the bolt's crest is this wide, and each flank; its root is the rest.
constexpr double kCrest = 0.25, kFlank = 0.2;
constexpr double kPlain = 0.1;  // what is plain beyond the ends of the thread

struct ProfilePoint {
  double along;  // [pitch]
  double radius;
};

Point on_circle(double radius, unsigned i, unsigned sides, double z) {
  const double angle = 2 * kPi * i / sides;
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

// Joins all of a chain of vertices, counter-clockwise around what it is seen from, to one.
void add_fan_of(TriangleMesh& mesh, unsigned apex, const std::vector<unsigned>& chain) {
  for (std::size_t k = 0; k + 1 < chain.size(); ++k)
    mesh.add_triangle(apex, chain[k], chain[k + 1]);
}

// A thread from the ring of `sides` vertices at `lower` to that at `upper`, of which the first
// vertices are on the x axis. Up to its second point the profile is level with the rings, and from
// its end on. Vertices follow the helix: edges of the profile are edges of the mesh. Either end
// narrows down to a point, a side away.
void add_thread(TriangleMesh& mesh, const std::vector<ProfilePoint>& profile, const Thread& thread,
                double start, unsigned lower, unsigned upper) {
  const auto per_turn = static_cast<unsigned>(profile.size());
  const unsigned rows = per_turn * thread.turns;
  const unsigned sides = thread.sides;
  const auto add = [&](double radius, unsigned i, double along) {
    return mesh.add_vertex(on_circle(radius, i, sides, start + thread.pitch * along));
  };
  std::vector<std::vector<unsigned>> columns(sides);
  for (unsigned i = 0; i < sides; ++i) {
    // The first column has the last turn of the one before it, too.
    const unsigned count = i == 0 ? rows + per_turn : rows;
    for (unsigned j = 0; j <= count; ++j) {
      const ProfilePoint& p = profile[j % per_turn];
      columns[i].push_back(add(p.radius, i, p.along + j / per_turn + double(i) / sides));
    }
  }
  const auto at = [&](unsigned i, unsigned j) {
    return i == sides ? columns[0][j + per_turn] : columns[i][j];
  };
  for (unsigned i = 0; i < sides; ++i) {
    for (unsigned j = 0; j < rows; ++j)
      mesh.add_quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  }
  const double middle = (profile[1].along + 1) / 2;
  const double side = 1.0 / sides;
  const unsigned last = sides - 1;
  const unsigned low = add(profile[0].radius, last, middle - side);
  const unsigned high = add(profile[0].radius, 1, thread.turns + middle + side);
  for (unsigned i = 0; i + 2 < sides; ++i) {
    add_fan_of(mesh, at(i, 0), {lower + i, lower + i + 1, at(i + 1, 0)});
    const unsigned k = i + 2;
    add_fan_of(mesh, at(k + 1, rows), {upper + (k + 1) % sides, upper + k, at(k, rows)});
  }
  // Beside either point, and where it joins the whole turn of the first column.
  add_fan_of(mesh, at(last - 1, 0), {lower + last - 1, lower + last, low, at(last, 0)});
  std::vector<unsigned> around{lower + last, lower};
  for (unsigned j = 0; j <= per_turn; ++j) around.push_back(at(0, j));
  around.push_back(at(last, 0));
  add_fan_of(mesh, low, around);
  add_fan_of(mesh, at(2, rows), {upper + 2, upper + 1, high, at(1, rows)});
  around = {upper + 1, upper};
  for (unsigned j = rows + per_turn + 1; j > rows; --j) around.push_back(columns[0][j - 1]);
  around.push_back(at(1, rows));
  add_fan_of(mesh, high, around);
}

unsigned add_circle(TriangleMesh& mesh, double radius, double z, unsigned sides) {
  const auto first = static_cast<unsigned>(mesh.vertex_count());
  for (unsigned i = 0; i < sides; ++i) mesh.add_vertex(on_circle(radius, i, sides, z));
  return first;
}

// `radius` from the middle to a corner.
unsigned add_hexagon(TriangleMesh& mesh, double radius, double z, unsigned sides) {
  const auto first = static_cast<unsigned>(mesh.vertex_count());
  for (unsigned i = 0; i < sides; ++i) {
    const double in_side = std::fmod(2 * kPi * i / sides, kPi / 3) - kPi / 6;
    mesh.add_vertex(on_circle(radius * std::cos(kPi / 6) / std::cos(in_side), i, sides, z));
  }
  return first;
}

}  // namespace

TriangleMesh make_bolt(const Thread& thread, double head_radius, double head_height) {
  // From a root on, so that the ends are level with the plain cylinder.
  constexpr double kRoot = 1 - kCrest - 2 * kFlank;
  const std::vector<ProfilePoint> profile{{0, thread.minor},
                                          {kRoot, thread.minor},
                                          {kRoot + kFlank, thread.major},
                                          {kRoot + kFlank + kCrest, thread.major}};
  const double start = (kCrest / 2 + kFlank) * thread.pitch;
  const double top = start + (thread.turns + 1 + kPlain) * thread.pitch;
  const unsigned sides = thread.sides;
  TriangleMesh mesh;
  const unsigned lower = add_circle(mesh, thread.minor, 0, sides);
  const unsigned upper = add_circle(mesh, thread.minor, top, sides);
  add_thread(mesh, profile, thread, start, lower, upper);
  add_fan(mesh, upper, mesh.add_vertex({0, 0, top}), sides, true);
  unsigned lowest = lower;
  if (head_height > 0) {
    lowest = add_hexagon(mesh, head_radius, -head_height, sides);
    const unsigned shoulder = add_hexagon(mesh, head_radius, 0, sides);
    add_band(mesh, lowest, shoulder, sides);
    add_band(mesh, shoulder, lower, sides);
  }
  add_fan(mesh, lowest, mesh.add_vertex({0, 0, -head_height}), sides, false);
  return mesh;
}

TriangleMesh make_nut(const Thread& thread, double clearance, double radius) {
  // Flanks are those of the bolt, moved along z by the clearance and cut off that much further out.
  const double moved = clearance / thread.pitch;
  const double cut = kFlank * clearance / (thread.major - thread.minor);
  const double half_groove = kCrest / 2 + moved - cut;
  const double outer = thread.major + clearance, inner = thread.minor + clearance;
  const std::vector<ProfilePoint> profile{
      {0, outer}, {2 * half_groove, outer}, {2 * half_groove + kFlank, inner}, {1 - kFlank, inner}};
  const double start = -half_groove * thread.pitch;
  const double bottom = start - kPlain * thread.pitch;
  const double top = start + (thread.turns + 1 + kPlain) * thread.pitch;
  const unsigned sides = thread.sides;
  TriangleMesh mesh;
  const unsigned lower = add_circle(mesh, outer, bottom, sides);
  const unsigned upper = add_circle(mesh, outer, top, sides);
  add_thread(mesh, profile, thread, start, lower, upper);
  turn_inside_out(mesh);
  const unsigned outside_lower = add_hexagon(mesh, radius, bottom, sides);
  const unsigned outside_upper = add_hexagon(mesh, radius, top, sides);
  add_band(mesh, outside_lower, outside_upper, sides);
  add_band(mesh, outside_upper, upper, sides);
  add_band(mesh, lower, outside_lower, sides);
  return mesh;
}

}  // namespace falling_objects
