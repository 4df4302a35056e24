// SPDX-License-Identifier: BSD-3-Clause
#include "contacts/pairs.h"

#include <algorithm>
#include <iterator>
#include <numbers>
#include <utility>

namespace contacts {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Placed place(Mesh mesh, double x, double y, double z) {
  return {std::move(mesh), {x, y, z, 0}, {1, 0, 0, 0}};
}

// Further turned about an axis of the world, about the body's own middle.
Placed turn(Placed placed, double x, double y, double z, double degrees) {
  dQuaternion by, before;
  std::copy(std::begin(placed.turn), std::end(placed.turn), before);
  dQFromAxisAndAngle(by, x, y, z, degrees * kDegree);
  dQMultiply0(placed.turn, by, before);
  return placed;
}

// Lying on a long edge.
Placed rod(double x, double y, double z) {
  return turn(place(make_box(1, 0.1, 0.1), x, y, z), 1, 0, 0, 45);
}

constexpr double kRodHeight = 0.1 * std::numbers::sqrt2;

constexpr Pair kPairs[] = {
    {"cube-on-cube", "a cube on a cube, pushed aside and turned, 2 cm deep",
     [] { return turn(place(make_box(1, 1, 1), 0.35, 0.2, 0.98), 0, 0, 1, 25); },
     [] { return place(make_box(1, 1, 1), 0, 0, 0); }, 0.02},
    {"crossed-rods", "square rods across each other, edge on edge, 1 cm deep",
     [] { return turn(rod(0.05, 0.02, kRodHeight - 0.01), 0, 0, 1, 70); },
     [] { return rod(0, 0, 0); }, 0.01},
    {"plate-in-rim", "a plate 1 cm thick, its lower side 2 cm below the top of a block",
     [] { return turn(place(make_box(0.4, 0.2, 0.01), 0.22, 0, 0.085), 0, 0, 1, 10); },
     [] { return place(make_box(0.2, 0.2, 0.2), 0, 0, 0); }, 0.02},
    {"contained-cube", "a cube wholly inside a larger one, nearest to its top",
     [] { return turn(place(make_box(0.3, 0.3, 0.3), 0.05, -0.05, 0.3), 0, 0, 1, 20); },
     [] { return place(make_box(1, 1, 1), 0, 0, 0); }, 0.35},
    {"beam-on-ridges", "a beam across three ridges of an open terrain, 2 cm deep",
     [] { return turn(place(make_box(2.4, 0.3, 0.2), 0, 0.1, 0.38), 0, 0, 1, 12); },
     [] { return place(make_ridges(3, 3, 0.3), 0, 0, 0); }, 0.02},
    {"comb-on-bar", "a comb of five teeth on a bar, 2 cm deep: five regions of overlap",
     [] { return turn(place(make_comb(5, 0.2, 0.4), 0, 0, 0.38), 0, 0, 1, 3); },
     [] { return place(make_box(2.4, 0.1, 0.2), 0, 0, -0.1); }, 0.02},
};

}  // namespace

std::span<const Pair> all_pairs() { return kPairs; }

}  // namespace contacts
