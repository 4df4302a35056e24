// SPDX-License-Identifier: BSD-3-Clause
#include "reference/reference_hits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ode_ext::test {
namespace {

constexpr double kTight = 1e-12;  // a few operations on doubles of order one

long count(const std::vector<ReferenceHit>& hits, int side, HitKind kind) {
  return std::count_if(hits.begin(), hits.end(), [&](const ReferenceHit& hit) {
    return hit.side == side && hit.kind == kind;
  });
}

TEST(ReferenceHits, AreNoneForMeshesApart) {
  const TestMesh cube = make_cube(1);
  EXPECT_TRUE(reference_hits(cube, at(0, 0, 0), cube, at(1.5, 0, 0)).empty());
  EXPECT_EQ(reference_rays(cube, at(0, 0, 0), cube, at(1.5, 0, 0)).size(), 16u);
}

// The small cube's rays reach its own far corner (2 sqrt 3) before the wall of the large one
// (from 1 to -3 along each axis: 4 sqrt 3), so they are fallbacks that prove it inside.
TEST(ReferenceHits, OfACubeInsideALargerOneAreFallbacks) {
  const auto hits = reference_hits(make_cube(2), at(0, 0, 0), make_cube(6), at(0, 0, 0));
  EXPECT_EQ(count(hits, 0, HitKind::Fallback), 8);
  EXPECT_EQ(hits.size(), 8u);
  for (const ReferenceHit& hit : hits) {
    EXPECT_NEAR(hit.t, 4 * std::sqrt(3.0), kTight);
    EXPECT_NEAR(hit.depth, 4, kTight);
    EXPECT_NEAR(hit.exit, 2 * std::sqrt(3.0), kTight);
  }
}

// A cube of 2 whose lower 0.1 is in a block: the four lower corners are inside, their rays leave
// the block through its top after 0.1 * sqrt 3.
TEST(ReferenceHits, OfACubeOnABlockAreItsFourLowerCorners) {
  const TestPose upper = at(0, 0, 1.9);
  const auto hits = reference_hits(make_cube(2), upper, make_box({6, 6, 2}), at(0, 0, 0));
  EXPECT_EQ(count(hits, 0, HitKind::Contact), 4);
  EXPECT_EQ(hits.size(), 4u);
  for (const ReferenceHit& hit : hits) {
    EXPECT_NEAR(hit.position[2], 0.9, kTight);
    EXPECT_NEAR(hit.t, 0.1 * std::sqrt(3.0), kTight);
    EXPECT_NEAR(hit.depth, 0.1, kTight);
    EXPECT_LT(distance(hit.normal, {0, 0, 1}), kTight);  // up, into the cube
    EXPECT_NEAR(hit.exit, 2 * std::sqrt(3.0), kTight);
    EXPECT_TRUE(hit.triangle >= 0 && hit.triangle < 12);
  }
}

TEST(ReferenceHits, AreTheSameWithTheMeshesSwappedUpToSideAndNormal) {
  Random random(3);
  const TestMesh a = make_torus(1, 0.4, 12, 8), b = make_icosphere(0.8, 2);
  const TestPose pa = random.pose(0.5), pb = random.pose(0.5);
  const auto hits = reference_hits(a, pa, b, pb), swapped = reference_hits(b, pb, a, pa);
  ASSERT_EQ(hits.size(), swapped.size());
  ASSERT_GT(hits.size(), 0u);
  for (const ReferenceHit& hit : hits) {
    EXPECT_TRUE(std::any_of(swapped.begin(), swapped.end(), [&](const ReferenceHit& other) {
      return other.side == 1 - hit.side && other.vertex == hit.vertex && other.kind == hit.kind &&
             other.triangle == hit.triangle && other.depth == hit.depth &&
             other.normal == -1 * hit.normal;
    }));
  }
}

// Spheres of radius 1 with centres 1.8 apart overlap by 0.2. A vertex at distance r from the other
// centre is 1 - r deep; its face's plane is that far away up to the facets' sagitta, 1 - cos of
// half an edge's angle (edges of 3 subdivisions span at most 0.16 rad).
TEST(ReferenceHits, OfSphereInSphereHaveTheDepthOfTheLens) {
  const TestMesh ball = make_icosphere(1, 3);
  const Point centre{1.8, 0, 0};
  const auto hits = reference_hits(ball, at(0, 0, 0), ball, at(1.8, 0, 0));
  ASSERT_GT(count(hits, 0, HitKind::Contact), 0);
  EXPECT_EQ(count(hits, 0, HitKind::Fallback), 0);
  const double sagitta = 1 - std::cos(0.08);
  double deepest = 0;
  for (const ReferenceHit& hit : hits) {
    const double radius = distance(hit.position, hit.side == 0 ? centre : Point{});
    ASSERT_LT(radius, 1);
    // Measured along the facet's normal the separation may be longer than along the radius: the ray
    // leaves up to the lens' half width (acos 0.9 = 0.45 rad) to the side.
    EXPECT_GE(hit.depth, 1 - radius - 2 * sagitta);
    EXPECT_LE(hit.depth, 0.2 + kTight);
    EXPECT_LT(hit.normal[0], -std::cos(0.45 + 0.16)) << "into the left sphere";
    deepest = std::max(deepest, hit.depth);
  }
  EXPECT_GT(deepest, 0.2 - 2 * sagitta - 0.16 * 0.16 / 2);
}

// Every vertex inside by the analytic sphere, well away from its facets, has a hit, and no other.
TEST(ReferenceHits, FindExactlyTheVerticesInsideAConvexMesh) {
  const TestMesh ball = make_icosphere(1, 3), torus = make_torus(1, 0.4, 24, 16);
  Random random(11);
  const double sagitta = 1 - std::cos(0.16);
  int inside = 0;
  for (int i = 0; i < 20; ++i) {
    const TestPose pose = random.pose(1);
    for (const ReferenceHit& ray : reference_rays(torus, pose, ball, at(0, 0, 0))) {
      if (ray.side == 1) continue;
      const double radius = length(ray.position);
      if (radius < 1 - sagitta) {
        EXPECT_NE(ray.kind, HitKind::None);
        ++inside;
      } else if (radius > 1) {
        EXPECT_EQ(ray.kind, HitKind::None);
      }
    }
  }
  EXPECT_GT(inside, 1000);
}

// Aligned equal boxes: each corner in contact lies on the other's side faces, its ray meets them at
// t = 0 as front faces and then leaves through the back face of the overlap.
TEST(ReferenceHits, OfAlignedEqualBoxesAreTheCornersOfTheOverlap) {
  const TestMesh cube = make_cube(2);
  const auto hits = reference_hits(cube, at(0, 0, 1.5), cube, at(0, 0, 0));
  EXPECT_EQ(count(hits, 0, HitKind::Contact), 4);
  EXPECT_EQ(count(hits, 1, HitKind::Contact), 4);
  for (const ReferenceHit& hit : hits) {
    if (hit.kind != HitKind::Contact) continue;
    EXPECT_NEAR(hit.depth, 0.5, kTight);
    EXPECT_LT(distance(hit.normal, {0, 0, 1}), kTight);
  }
}

TEST(ReferenceHits, OfACopyAtTheSamePoseCrossTheWholeCube) {
  const TestMesh cube = make_cube(2);
  const auto hits = reference_hits(cube, at(0, 0, 0), cube, at(0, 0, 0));
  EXPECT_EQ(hits.size(), 16u);
  for (const ReferenceHit& hit : hits) {
    EXPECT_EQ(hit.kind, HitKind::Contact);
    EXPECT_NEAR(hit.depth, 2, kTight);
  }
}

// A small box standing exactly on a larger one: the corners' rays point away from the block.
TEST(ReferenceHits, OfTouchingBoxesHaveDepthZero) {
  const auto hits = reference_hits(make_cube(2), at(0, 0, 2), make_box({6, 6, 2}), at(0, 0, 0));
  EXPECT_EQ(count(hits, 0, HitKind::Touching), 4);
  EXPECT_EQ(hits.size(), 4u);
  for (const ReferenceHit& hit : hits) {
    EXPECT_EQ(hit.depth, 0);
    EXPECT_LT(distance(hit.normal, {0, 0, 1}), kTight);
  }
}

// A plate 0.2 thick sunk 1 below the top of a block: rays from both of its faces leave the plate
// long before they leave the block.
TEST(ReferenceHits, OfAThinPlateInABlockAreFallbacks) {
  const auto hits = reference_hits(make_plate(2, 0.2, 4), at(0, 0, 1), make_cube(4), at(0, 0, 0));
  EXPECT_EQ(count(hits, 0, HitKind::Fallback), static_cast<long>(hits.size()));
  EXPECT_EQ(hits.size(), 50u);  // all of its vertices, 5 x 5 on two faces
  for (const ReferenceHit& hit : hits) EXPECT_GT(hit.t, hit.exit);
}

// The lower corners' rays go up and inwards and meet the sheet's underside: below by 0.1.
TEST(ReferenceHits, OfACubeDippedIntoAnOpenSheetHaveTheSheetsNormal) {
  const auto hits = reference_hits(make_cube(2), at(0, 0, 0.9), make_sheet(8, 4), at(0, 0, 0));
  EXPECT_EQ(count(hits, 0, HitKind::Contact), 4);
  for (const ReferenceHit& hit : hits) {
    if (hit.side == 1) continue;
    EXPECT_NEAR(hit.depth, 0.1, 1e-7);  // 0.9 - 1 in exact doubles
    EXPECT_LT(distance(hit.normal, {0, 0, 1}), kTight);
  }
}

TEST(ReferenceHits, OfAnInvertedMeshAreThoseOfTheUprightOne) {
  const TestMesh torus = make_torus(1, 0.4, 12, 8), ball = make_icosphere(0.8, 2);
  const TestPose pose = turned({1, 2, 3}, 1, {0.7, 0.1, 0.2});
  const auto upright = reference_hits(torus, at(0, 0, 0), ball, pose);
  const auto turned_in = reference_hits(inverted(torus), at(0, 0, 0), inverted(ball), pose);
  ASSERT_EQ(upright.size(), turned_in.size());
  ASSERT_GT(upright.size(), 0u);
  for (const ReferenceHit& hit : upright) {
    EXPECT_TRUE(std::any_of(turned_in.begin(), turned_in.end(), [&](const ReferenceHit& other) {
      return other.side == hit.side && other.vertex == hit.vertex && other.kind == hit.kind &&
             other.triangle == hit.triangle && std::fabs(other.depth - hit.depth) < kTight;
    }));
  }
}

TEST(ReferenceHits, DoNotDependOnTheDistanceFromTheOrigin) {
  const TestMesh torus = make_torus(1, 0.4, 12, 8);
  const TestPose pose = turned({1, 2, 3}, 1, {0.75, 0.125, 0.25});
  const auto near = reference_hits(torus, at(0, 0, 0), torus, pose);
  TestPose a = at(1e6, 1e6, 1e6), b = pose;
  b.position = b.position + a.position;
  const auto far = reference_hits(torus, a, torus, b);
  ASSERT_EQ(near.size(), far.size());
  for (std::size_t i = 0; i < near.size(); ++i) EXPECT_EQ(near[i].depth, far[i].depth);
}

// Nearly all rays of meshes in general position are beyond doubt, else there is nothing to compare.
TEST(ReferenceHits, AreRarelyAmbiguousInGeneralPosition) {
  Random random(5);
  const TestMesh a = make_torus(1, 0.4, 24, 16), b = make_icosphere(0.8, 2);
  long ambiguous = 0, all = 0;
  for (int i = 0; i < 20; ++i) {
    for (const auto& ray : reference_rays(a, random.pose(0.7), b, random.pose(0.7))) {
      ambiguous += ray.ambiguous;
      ++all;
    }
  }
  EXPECT_LT(static_cast<double>(ambiguous), 0.002 * static_cast<double>(all)) << ambiguous;
}

// A vertex within rounding of the limit must be marked, wherever the line is drawn exactly.
TEST(ReferenceHits, AreAmbiguousWhereAVertexAllButTouches) {
  const double hair = rounding_bound(4) / 2;
  const auto rays =
      reference_rays(make_cube(2), at(0, 0, 2 - hair), make_box({6, 6, 2}), at(0, 0, 0));
  const auto doubtful = std::count_if(rays.begin(), rays.end(), [](const ReferenceHit& ray) {
    return ray.side == 0 && ray.position[2] < 2 && ray.ambiguous;
  });
  EXPECT_EQ(doubtful, 4);
}

}  // namespace
}  // namespace ode_ext::test
