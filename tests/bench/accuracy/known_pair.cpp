// SPDX-License-Identifier: BSD-3-Clause
#include "bench/accuracy/known_pair.h"

#include <cmath>

#include "bench/accuracy/measures.h"

namespace ode_ext::accuracy {

using test::operator*;

bool is_askew(const dContactGeom& contact, const test::Point& truth) {
  return exceeds(degrees_between(test::normal(contact), truth), kWrongAngle);
}

std::vector<test::GeomPair> geoms_of(const std::vector<KnownPair>& pairs) {
  std::vector<test::GeomPair> geoms;
  for (const KnownPair& pair : pairs) geoms.push_back(pair.geoms);
  return geoms;
}

KnownPair make_known_pair(test::OdeWorld& world, const Body& a, const test::TestPose& pa,
                          const Body& b, const test::TestPose& pb, const test::WayOut& out,
                          bool b_first) {
  const dGeomID ga = world.geom(a.mesh, pa), gb = world.geom(b.mesh, pb);
  if (b_first) return {{gb, ga}, -1 * out.direction, out.depth};
  return {{ga, gb}, out.direction, out.depth};
}

bool is_shortest(const test::WayOut& claimed, const Body& a, const test::TestPose& pa,
                 const Body& b, const test::TestPose& pb) {
  const test::WayOut shortest = shortest_way_out(a.solid, pa, b.solid, pb);
  return std::fabs(shortest.depth - claimed.depth) < 1e-4 * claimed.depth &&
         degrees_between(shortest.direction, claimed.direction) < 0.01;
}

}  // namespace ode_ext::accuracy
