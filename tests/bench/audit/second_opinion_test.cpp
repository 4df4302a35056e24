// SPDX-License-Identifier: BSD-3-Clause
// The audit stands on FCL's word; CGAL's exact predicates say the same.
#include <gtest/gtest.h>

#include "bench/audit/kinds.h"
#include "bench/audit/pair_poses.h"
#include "support/cgal_oracle.h"
#include "support/fcl_oracle.h"

namespace ode_ext::audit {
namespace {

using namespace test;

// All but the meshes of thousands of triangles, which take long and ask nothing else.
std::vector<Kind> small_kinds() {
  std::vector<Kind> kinds = make_kinds();
  std::erase_if(kinds, [](const Kind& kind) { return kind.mesh.triangle_count() > 2000; });
  return kinds;
}

TEST(SecondOpinion, CgalAgreesWithFclOnAllKindsInRandomPoses) {
  const std::vector<Kind> kinds = small_kinds();
  ASSERT_EQ(kinds.size(), 8u);
  Random random(5);
  int intersecting = 0, apart = 0, fragile = 0;
  for (const Kind& a : kinds) {
    for (const Kind& b : kinds) {
      for (int i = 0; i < 8; ++i) {
        const PosedPair pair = (i % 2 == 0 ? shallow_pair : deep_pair)(a.mesh, b.mesh, random);
        const OracleAnswer fcl = surfaces_intersect_robustly(a.mesh, pair.a, b.mesh, pair.b);
        const bool cgal = surfaces_intersect_exactly(a.mesh, pair.a, b.mesh, pair.b);
        fragile += fcl == OracleAnswer::Fragile;
        (cgal ? intersecting : apart) += 1;
        if (fcl == OracleAnswer::Fragile) continue;
        EXPECT_EQ(fcl == OracleAnswer::Intersect, cgal) << a.name << ", " << b.name << ", " << i;
      }
    }
  }
  EXPECT_GT(intersecting, 256);
  EXPECT_GT(apart, 64);
  EXPECT_LT(fragile, 5);
}

// Just where FCL's answer changes, found by bisection: CGAL's changes within rounding of it.
TEST(SecondOpinion, CgalAgreesWithFclOnWhereTouchingBegins) {
  const std::vector<Kind> kinds = small_kinds();
  Random random(6);
  for (const Kind& a : kinds) {
    for (const Kind& b : kinds) {
      PosedPair pair = shallow_pair(a.mesh, b.mesh, random);
      const Point away = unit(pair.a.position - pair.b.position);
      const auto at_distance = [&](double distance) {
        TestPose pose = pair.a;
        pose.position = pair.b.position + distance * away;
        return pose;
      };
      const FclSurface fa(a.mesh), fb(b.mesh);
      double in = 0, out = 3;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (in + out);
        (surfaces_intersect(fa, at_distance(middle), fb, pair.b) ? in : out) = middle;
      }
      if (in == 0) continue;  // never met: an open mesh around the other
      const double rounding = 1e-12;
      EXPECT_TRUE(surfaces_intersect_exactly(a.mesh, at_distance(out - rounding), b.mesh, pair.b))
          << a.name << ", " << b.name;
      EXPECT_FALSE(surfaces_intersect_exactly(a.mesh, at_distance(out + rounding), b.mesh, pair.b))
          << a.name << ", " << b.name;
    }
  }
}

}  // namespace
}  // namespace ode_ext::audit
