// SPDX-License-Identifier: BSD-3-Clause
// Every mesh pair that a collide pass can lead to.
#pragma once

#include <ode/ode.h>

#include <cstddef>
#include <span>
#include <vector>

#include "search/scene.h"

namespace ode_ext {

// A mesh geom, and the outermost geom transform that it sits in, or itself.
struct PlacedGeom {
  dGeomID geom;
  dGeomID holder;
};

// Where dCollide will see it: composed with the arithmetic of ODE's dCollideTransform, so that it
// is that pose bit for bit.
Pose pose_of(const PlacedGeom& placed);

struct GatheredPair {
  PlacedGeom first, second;
};

// What a pass starts from: a space (second is 0), or two geoms.
struct PassRoot {
  dGeomID first = nullptr;
  dGeomID second = nullptr;
  bool operator==(const PassRoot&) const = default;
};

// Some order of them.
struct RootLess {
  bool operator()(const PassRoot& a, const PassRoot& b) const {
    const std::less<> less;
    return a.first != b.first ? less(a.first, b.first) : less(a.second, b.second);
  }
};

// False if there are not two meshes below the root. Spaces that cannot be listed (ODE's quadtrees)
// may hold any.
bool may_hold_mesh_pair(const PassRoot& root);

// Runs ODE's own broad phase, with all its filters, over the root and over everything the program
// could recurse into: across each pair of geoms that is reported with a space among them, and
// inside each contained space. A pair that several ways lead to comes several times. Never enters a
// sweep-and-prune space of `traversed`: its traversal keeps scratch lists in the space. `expected`:
// about how many pairs there are, to have room for them at once.
std::vector<GatheredPair> gather_pairs(const PassRoot& root, std::span<const PassRoot> traversed,
                                       std::size_t expected);

}  // namespace ode_ext
