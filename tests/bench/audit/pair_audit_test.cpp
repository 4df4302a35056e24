// SPDX-License-Identifier: BSD-3-Clause
#include "bench/audit/pair_audit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "bench/audit/kind_pair.h"
#include "bench/audit/kinds.h"
#include "support/region_cases.h"

namespace ode_ext::audit {
namespace {

using namespace test;

dContactGeom contact_at(const Point& p, double depth = 0) {
  dContactGeom contact{};
  for (std::size_t k = 0; k < 3; ++k) contact.pos[k] = p[k];
  contact.normal[2] = 1;
  contact.depth = depth;
  return contact;
}

const Shape& cube() {
  static const Shape shape(make_cube(1));
  return shape;
}

PosedPair pair_of(const TestPose& a, const TestPose& b = {}) { return {Approach::kDeep, a, b}; }

TEST(PairTruth, CallsAContactBetweenSeparateMeshesFalse) {
  const PairTruth truth(cube(), cube(), pair_of(at(0.1, 0.2, 1.01)));
  EXPECT_FALSE(truth.colliding());
  const dContactGeom contact = contact_at({0, 0, 0.5});
  EXPECT_EQ(truth.judge({&contact, 1}, 16).false_contacts, 1);
  EXPECT_EQ(truth.judge({}, 16).errors(), 0);
}

TEST(PairTruth, CallsACollidingPairWithoutAContactMissed) {
  const PairTruth truth(cube(), cube(), pair_of(at(0.1, 0.2, 0.9)));
  EXPECT_TRUE(truth.intersecting());
  EXPECT_EQ(truth.judge({}, 16).missed, 1);
  EXPECT_EQ(truth.judge({}, 16).missed_contained, 0);
  const dContactGeom contact = contact_at({0, 0, 0.45});
  EXPECT_EQ(truth.judge({&contact, 1}, 16).errors(), 0);
}

TEST(PairTruth, SeesOneMeshInsideTheOtherWhicheverItIsUnlessTheOuterIsOpen) {
  const Shape large(make_cube(3)), open(make_kinds().back().mesh), small(make_cube(0.1));
  for (const bool exchanged : {false, true}) {
    const PairTruth truth(exchanged ? large : cube(), exchanged ? cube() : large, pair_of({}));
    EXPECT_FALSE(truth.intersecting());
    EXPECT_TRUE(truth.contained());
    EXPECT_EQ(truth.judge({}, 16).missed_contained, 1);
  }
  EXPECT_TRUE(PairTruth(open, large, pair_of({})).contained());
  const PairTruth in_bowl(small, open, pair_of({}));
  EXPECT_FALSE(in_bowl.colliding());
  const dContactGeom contact = contact_at({});
  EXPECT_EQ(in_bowl.judge({&contact, 1}, 16).false_contacts, 1);
}

TEST(PairTruth, CountsWrongAnswersOnTheEdgeApart) {
  for (const double gap : {-2e-6, 2e-6}) {
    const PairTruth truth(cube(), cube(), pair_of(at(0.1, 0.2, 1 + gap)));
    const dContactGeom contact = contact_at({0, 0, 0.5});
    const Answers answers = gap < 0 ? truth.judge({}, 16) : truth.judge({&contact, 1}, 16);
    EXPECT_EQ(answers.on_edge, 1);
    EXPECT_EQ(answers.errors(), 0);
  }
}

TEST(PairTruth, SeesRegionsWithoutAContactAndAllowsForTheLimit) {
  const auto cases = region_cases();
  const auto comb = std::find_if(cases.begin(), cases.end(),
                                 [](const RegionCase& c) { return c.name == "CombOfFiveOnABar"; });
  ASSERT_NE(comb, cases.end());
  const Shape a(comb->a), b(comb->b);
  const PairTruth truth(a, b, pair_of(comb->pose_a, comb->pose_b));
  ASSERT_EQ(truth.regions(), 5u);
  const dContactGeom middle = contact_at({});  // of the third tooth, which is over the origin
  EXPECT_EQ(truth.judge({&middle, 1}, 16).bare, 4);
  EXPECT_EQ(truth.judge({&middle, 1}, 2).bare, 1);  // two of five can have one
  EXPECT_EQ(truth.judge({&middle, 1}, 2).bare_beyond, 3);
  EXPECT_EQ(truth.judge({}, 16).missed, 1);
  EXPECT_EQ(truth.judge({}, 16).bare, 0);  // that is said already
}

TEST(Shape, RefusesAClosedMeshWhoseTrianglesDoNotShareVertices) {
  EXPECT_THROW(Shape(unshared(make_cube(1))), std::invalid_argument);
}

// The lower edge of a tetrahedron, 0.4 m long and 2e-6 m deep, beside a cube that is 0.05 m deep.
TEST(PairTruth, CountsRegionsThatANudgeRemovesApart) {
  const TestMesh roof = make_tetrahedron(0.4);
  const double below = -roof.vertex(2)[2];
  const Shape both(merged(moved(roof, {0.5, 0, 0}), moved(make_cube(0.1), {-0.5, 0, -below})));
  const Shape ground(moved(make_plate(6, 1, 1), {0, 0, -0.5}));
  const dContactGeom contact = contact_at({-0.5, 0, 0});
  for (const double depth : {2e-6, 2e-4}) {
    const PairTruth truth(both, ground, pair_of(at(0, 0, below - depth)));
    ASSERT_EQ(truth.regions(), 2u);
    const Answers answers = truth.judge({&contact, 1}, 16);
    EXPECT_EQ(answers.bare_slight, depth == 2e-6);
    EXPECT_EQ(answers.bare, depth == 2e-4);
  }
}

TEST(MeshKinds, AreClosedButForTheTerrainAndTheBowlAndOfTheSizesSaid) {
  const auto kinds = make_kinds();
  EXPECT_EQ(kinds.front().mesh.triangle_count(), 12);
  for (const Kind& kind : kinds) {
    const oracle::Mesh solid(kind.mesh.vertices, kind.mesh.indices);
    EXPECT_EQ(solid.closed(), kind.name != "terrain" && kind.name != "bowl") << kind.name;
    EXPECT_GT(mesh_size(kind.mesh), 0.7) << kind.name;
    EXPECT_LT(mesh_size(kind.mesh), 1.7) << kind.name;
    if (kind.name == "boulder") {
      EXPECT_EQ(kind.mesh.triangle_count(), 69312);
    }
    if (!solid.closed()) continue;
    // Outwards: the volume is positive.
    double volume = 0;
    for (const auto& t : solid.triangles()) volume += dot(t[0], cross(t[1], t[2])) / 6;
    EXPECT_GT(volume, 0) << kind.name;
  }
}

TEST(KindPair, PosesMeshesTheSameEveryTimeAndOneOfTwentyInsideTheOther) {
  const OdeWorld world;
  const Body needle(make_kinds()[1].mesh), star(make_kinds()[5].mesh), bowl(make_kinds()[9].mesh);
  const KindPair pair(needle, star, 7), again(needle, star, 7), open(bowl, bowl, 7),
      half_open(bowl, star, 7);
  int contained = 0;
  for (int i = 0; i < 200; ++i) {
    EXPECT_EQ(pair.posed(i).a.position, again.posed(i).a.position);
    contained += pair.posed(i).approach == Approach::kContained;
    EXPECT_NE(open.posed(i).approach, Approach::kContained);
  }
  EXPECT_EQ(contained, 10);
  EXPECT_NE(pair.posed(1).a.position, pair.posed(3).a.position);

  Trial trial;
  trial.poses = 200;
  for (const KindPair* kinds : {&pair, &half_open}) {
    const auto tallies = kinds->run(trial, [](const Miss&) {});
    const Tally& inside = tallies[static_cast<std::size_t>(Approach::kContained)];
    EXPECT_EQ(inside.pairs, 10);
    EXPECT_EQ(inside.contained, 10);
    EXPECT_EQ(inside.intersecting, 0);
    for (const Approach approach : {Approach::kShallow, Approach::kDeep}) {
      const Tally& tally = tallies[static_cast<std::size_t>(approach)];
      EXPECT_GT(tally.intersecting, tally.pairs / 10) << name_of(approach);
      EXPECT_GE(tally.regions, tally.intersecting) << name_of(approach);
    }
  }
}

}  // namespace
}  // namespace ode_ext::audit
