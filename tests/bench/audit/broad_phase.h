// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ode/ode.h>

#include <algorithm>
#include <set>
#include <utility>

namespace ode_ext::audit {

using Pair = std::pair<dGeomID, dGeomID>;
using Pairs = std::set<Pair>;

inline Pair in_order(dGeomID a, dGeomID b) { return std::minmax(a, b); }

// The broad phase is ODE's own: nothing of the collider decides which pairs are looked at.
inline Pairs broad_phase(dSpaceID space) {
  Pairs pairs;
  dSpaceCollide(space, &pairs, [](void* data, dGeomID a, dGeomID b) {
    static_cast<Pairs*>(data)->insert(in_order(a, b));
  });
  return pairs;
}

}  // namespace ode_ext::audit
