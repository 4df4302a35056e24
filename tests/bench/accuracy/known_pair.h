// SPDX-License-Identifier: BSD-3-Clause
// Pairs of convex meshes whose least separation of each other is known.
#pragma once

#include <vector>

#include "support/convex_solid.h"
#include "support/ode_world.h"

namespace ode_ext::accuracy {

inline constexpr double kWrongAngle = 5;  // [degrees] a normal farther off is wrong

bool is_askew(const dContactGeom& contact, const test::Point& truth);

struct KnownPair {
  test::GeomPair geoms;
  test::Point direction;  // unit, world: the separation of the first geom
  double depth;           // [m]
};

std::vector<test::GeomPair> geoms_of(const std::vector<KnownPair>& pairs);

// A mesh that is placed often, and the polyhedron it is.
struct Body {
  Body(test::OdeWorld& world, const test::TestMesh& shape)
      : mesh(world.mesh(shape)), solid(shape) {}
  const test::OdeMesh& mesh;
  test::ConvexSolid solid;
};

// `a` over `b`, separated along `out`. For every other pair (`b_first`) the geoms are exchanged
// and the direction with them, so that neither order is favoured.
KnownPair make_known_pair(test::OdeWorld& world, const Body& a, const test::TestPose& pa,
                          const Body& b, const test::TestPose& pb, const test::WayOut& out,
                          bool b_first);

// Whether the claimed separation is the least, by all separating axes: within 1e-4 of the depth and
// a hundredth of a degree. Float vertices are off by 1e-7 of the size.
bool is_shortest(const test::WayOut& claimed, const Body& a, const test::TestPose& pa,
                 const Body& b, const test::TestPose& pb);

}  // namespace ode_ext::accuracy
