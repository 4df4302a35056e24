// SPDX-License-Identifier: BSD-3-Clause
// How deep contacts say convex bodies are, against how deep they are.
#include <gtest/gtest.h>

#include "bench/accuracy/contestant.h"
#include "bench/accuracy/pressed_pair.h"
#include "support/convex_makers.h"

namespace ode_ext::accuracy {
namespace {

// Where a rim of many short edges bites into an edge, no place where the surfaces cross is where
// the bodies are deepest, and a contact made there alone says a sixth of the separation.
TEST(PressedDepth, IsNowhereLessThanHalfTheShortestWayOut) {
  test::OdeWorld world;
  const Body cone(world, test::make_cone(0.5, 1, 16)), cube(world, test::make_cube(1));
  test::Random random(7);
  std::vector<KnownPair> pairs;
  for (int i = 0; i < 300; ++i) {
    const PressedPair p = press_together(cone, cube, 0.1, random);
    pairs.push_back(make_known_pair(world, cone, p.pa, cube, p.pb, p.out, i % 2 == 1));
  }
  BatchOde batch;
  const auto answers = batch.collide(geoms_of(pairs));
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const dContactGeom* deepest = deepest_of(answers[i]);
    ASSERT_NE(deepest, nullptr) << i;
    EXPECT_GT(deepest->depth, 0.5 * pairs[i].depth) << i;
  }
}

}  // namespace
}  // namespace ode_ext::accuracy
