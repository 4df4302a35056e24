// SPDX-License-Identifier: BSD-3-Clause
#include "cloth/cloth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cloth/sheet.h"
#include "scene_file/gravity.h"

namespace falling_objects {
namespace {

constexpr double kStep = 1.0 / 60;  // [s]

Cloth make_cloth(double height) {
  Cloth cloth(32, 0.8);  // as fine as the scene's
  for (Vector& p : cloth.positions()) p.z += height;
  return cloth;
}

// What a collider would find of a level plane: every vertex that is on its way through it.
std::vector<ClothContact> on_plane(const Cloth& cloth, double height, Vector velocity = {}) {
  std::vector<ClothContact> planes;
  for (std::uint32_t v = 0; v < cloth.positions().size(); ++v) {
    if (cloth.free_flight(v, kStep).z >= height) continue;
    ClothContact plane;
    plane.vertex = v;
    plane.normal = {0, 0, 1};
    plane.offset = height;
    plane.velocity = velocity;
    plane.friction = 0.5;
    planes.push_back(plane);
  }
  return planes;
}

// Longest and shortest edge of a triangle, as shares of their lengths at rest.
std::pair<double, double> strains(const Cloth& cloth) {
  double shortest = 1, longest = 1;
  for (std::size_t t = 0; t < cloth.triangles().size(); t += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const unsigned a = cloth.triangles()[t + k], b = cloth.triangles()[t + (k + 1) % 3];
      const unsigned apart = std::max(a, b) - std::min(a, b);
      const bool diagonal = apart == cloth.side() + 1;
      const double rest = cloth.spacing() * (diagonal ? std::sqrt(2.0) : 1.0);
      const double ratio = length(cloth.positions()[a] - cloth.positions()[b]) / rest;
      shortest = std::min(shortest, ratio);
      longest = std::max(longest, ratio);
    }
  }
  return {shortest, longest};
}

TEST(Cloth, HasThePapersNumberOfTriangles) {
  const Cloth sheet(kSheetQuads, kSheetSize);
  EXPECT_EQ(sheet.triangles().size(), 3u * 8192u);
  EXPECT_EQ(sheet.positions().size(), 65u * 65u);
  EXPECT_EQ(*std::max_element(sheet.triangles().begin(), sheet.triangles().end()), 65u * 65u - 1);
}

// Both start at rest; the drag takes v * t * 6/s of the fall, less than 6 % in the first 50 ms.
TEST(Cloth, FallsAsAnythingFallsBeforeTheAirHoldsIt) {
  Cloth cloth = make_cloth(0);
  const double t = 3 * kStep;
  for (int i = 0; i < 3; ++i) cloth.step(kStep, {});
  const double fall = 0.5 * kGravity * t * t;
  for (const Vector& p : cloth.positions()) {
    EXPECT_NEAR(p.z, -fall, 0.12 * fall);
    EXPECT_LT(p.z, -0.8 * fall);
  }
  EXPECT_NEAR(strains(cloth).second, 1, 1e-9);
}

TEST(Cloth, FallsByTheGravityOfItsWorld) {
  Cloth cloth(8, 0.8, {1.5, 0, -0.5});
  const Vector begin = cloth.positions()[0];
  for (int i = 0; i < 3; ++i) cloth.step(kStep, {});
  const Vector way = cloth.positions()[0] - begin;
  const double t = 3 * kStep;
  EXPECT_NEAR(way.x, 0.5 * 1.5 * t * t, 0.12 * 0.5 * 1.5 * t * t);
  EXPECT_NEAR(way.z, way.x * -0.5 / 1.5, 1e-12);
  EXPECT_NEAR(way.y, 0, 1e-12);
}

TEST(Cloth, FallsThroughAirAtAConstantSpeedInTheEnd) {
  Cloth cloth = make_cloth(0);
  for (int i = 0; i < 120; ++i) cloth.step(kStep, {});
  const double before = cloth.positions()[0].z;
  cloth.step(kStep, {});
  const double first = before - cloth.positions()[0].z;
  for (int i = 0; i < 60; ++i) cloth.step(kStep, {});
  const double later = cloth.positions()[0].z;
  cloth.step(kStep, {});
  EXPECT_NEAR(later - cloth.positions()[0].z, first, 1e-6);
  EXPECT_NEAR(first / kStep, 1.6, 0.1);
}

TEST(Cloth, KeepsItsEdgesWhileItHangsByTwoCorners) {
  Cloth cloth = make_cloth(2);
  cloth.pin(0);
  cloth.pin(cloth.side() - 1);
  for (int i = 0; i < 300; ++i) cloth.step(kStep, {});
  EXPECT_LT(cloth.fastest(kStep), 0.02);
  EXPECT_LT(cloth.positions().back().z, 2 - 0.7);
  // The whole weight hangs by one link at either corner: there, and only there, it gives way.
  const auto [shortest, longest] = strains(cloth);
  EXPECT_LT(longest, 1.35);
  EXPECT_GT(shortest, 0.9);
}

TEST(Cloth, KeepsItsEdgesWhileItHangsByOneSide) {
  Cloth cloth = make_cloth(2);
  for (std::size_t i = 0; i < cloth.side(); ++i) cloth.pin(i);
  for (int i = 0; i < 300; ++i) cloth.step(kStep, {});
  EXPECT_LT(cloth.fastest(kStep), 0.02);
  const auto [shortest, longest] = strains(cloth);
  EXPECT_LT(longest, 1.05);
  EXPECT_GT(shortest, 0.95);
}

TEST(Cloth, ComesToRestOnAPlaneAndNotBelowIt) {
  Cloth cloth = make_cloth(0.5);
  for (int i = 0; i < 120; ++i) {
    std::vector<ClothContact> planes = on_plane(cloth, 0.1);
    cloth.step(kStep, planes);
    for (const Vector& p : cloth.positions()) ASSERT_GE(p.z, 0.1 - 1e-9);
  }
  EXPECT_EQ(cloth.fastest(kStep), 0);
  EXPECT_NEAR(cloth.positions()[cloth.middle()].z, 0.1, 1e-9);
}

TEST(Cloth, LeavesAPlaneThatFallsAwayFromIt) {
  Cloth cloth = make_cloth(0.1);
  for (int i = 0; i < 30; ++i) {
    std::vector<ClothContact> planes = on_plane(cloth, 0.1);
    cloth.step(kStep, planes);
  }
  ASSERT_EQ(cloth.fastest(kStep), 0);
  for (int i = 0; i < 30; ++i) cloth.step(kStep, {});
  EXPECT_LT(cloth.positions()[0].z, -0.2);
}

// Contacts that contradict each other from step to step, as those of neighbouring faces do.
TEST(Cloth, StopsSwingingBetweenTwoPlanesAndFallsWhenBothAreGone) {
  Cloth cloth = make_cloth(0.1);
  const auto tilted = [&](int step) {
    std::vector<ClothContact> planes = on_plane(cloth, 0.1);
    for (ClothContact& plane : planes) {
      plane.normal = unit(Vector{step % 2 == 0 ? 1.0 : -1.0, 0, 1});
      plane.offset = dot(plane.normal, cloth.positions()[plane.vertex]) + 0.005;
    }
    return planes;
  };
  double fastest_at_first = 0;
  for (int i = 0; i < 120; ++i) {
    std::vector<ClothContact> planes = tilted(i);
    cloth.step(kStep, planes);
    if (i < 5) fastest_at_first = std::max(fastest_at_first, cloth.fastest(kStep));
  }
  EXPECT_GT(fastest_at_first, 0.1);
  ASSERT_LT(cloth.fastest(kStep), 0.05);
  const double height = cloth.positions()[0].z;
  for (int i = 0; i < 30; ++i) cloth.step(kStep, {});
  EXPECT_LT(cloth.positions()[0].z, height - 0.2);
}

TEST(Cloth, IsLiftedSlowlyAndNotThrownByAPlaneItIsBelow) {
  Cloth cloth = make_cloth(-0.02);
  double highest = -1;
  for (int i = 0; i < 60; ++i) {
    std::vector<ClothContact> planes = on_plane(cloth, 0);
    const double before = cloth.positions()[0].z;
    cloth.step(kStep, planes);
    EXPECT_LT(cloth.positions()[0].z - before, 0.51 * kStep);
    highest = std::max(highest, cloth.positions()[0].z);
  }
  EXPECT_NEAR(highest, 0, 1e-9);
}

TEST(Cloth, GivesAPlaneTheMomentumThatGravityGaveIt) {
  Cloth cloth = make_cloth(0);
  const double mass = cloth.vertex_mass() * static_cast<double>(cloth.positions().size());
  std::vector<ClothContact> planes;
  for (int i = 0; i < 10; ++i) {
    planes = on_plane(cloth, 0);
    cloth.step(kStep, planes);
  }
  double given = 0;
  for (const ClothContact& plane : planes) given -= plane.impulse.z;
  // The air takes 6/s of it for as long as a substep, 1/960 s: 0.6 %.
  EXPECT_NEAR(given, mass * kGravity * kStep, 0.007 * mass * kGravity * kStep);
}

TEST(Cloth, RidesOnAPlaneThatMovesSideways) {
  Cloth cloth = make_cloth(0);
  for (int i = 0; i < 60; ++i) {
    std::vector<ClothContact> planes = on_plane(cloth, 0, {0.3, 0, 0});
    cloth.step(kStep, planes);
  }
  EXPECT_NEAR(cloth.velocities()[cloth.middle()].x, 0.3, 0.03);
}

}  // namespace
}  // namespace falling_objects
