// SPDX-License-Identifier: BSD-3-Clause
#include "bench/stability/bench.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/stability/ground.h"

namespace ode_ext::stability {
namespace {

constexpr double kTiny = 1e-12;  // rounding of numbers of order one, with three digits to spare

int contacts_of_a_cube_inside_another(Collider collider) {
  const Shape inner = box_shape({0.2, 0.2, 0.2}), outer = box_shape({1, 1, 1});
  Bench bench({.collider = collider, .gravity = 0});
  bench.add_body(inner, at(0.1, 0, 0), 0);
  bench.add_fixed(outer, {}, 0);
  bench.step();
  return bench.contacts(0);
}

// ODE's own mesh collider says nothing of meshes whose surfaces do not cross.
TEST(Bench, CollidesWithTheColliderAskedFor) {
  EXPECT_GT(contacts_of_a_cube_inside_another(Collider::kExt), 0);
  EXPECT_EQ(contacts_of_a_cube_inside_another(Collider::kStock), 0);
  EXPECT_GT(contacts_of_a_cube_inside_another(Collider::kBoxes), 0);
}

TEST(Bench, GivesBoxesTheMassOfTheirMeshes) {
  const Shape cube = box_shape({0.2, 0.2, 0.2});
  for (const Collider collider : kColliders) {
    Bench bench({.collider = collider});
    dMass mass;
    dBodyGetMass(bench.add_body(cube, {}, 0), &mass);
    EXPECT_NEAR(mass.mass, 4, kTiny) << name_of(collider);
    EXPECT_NEAR(mass.I[0], 4 * 0.04 / 6, kTiny) << name_of(collider);
  }
}

TEST(Bench, PutsBodiesWhereTheyAreAskedFor) {
  const Shape cube = box_shape({0.2, 0.2, 0.2});
  Bench bench({.collider = Collider::kBoxes});
  const TestPose asked = turned({1, 2, 3}, 0.5, {4, 5, 6});
  const TestPose got = pose(bench.add_body(cube, asked, 0));
  EXPECT_EQ(got.position, asked.position);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(got.rotation[i], asked.rotation[i], kTiny);
}

TEST(Bench, KeepsCellsApartAndPutsThePlaneIntoAll) {
  const Shape cube = box_shape({0.2, 0.2, 0.2});
  Bench bench({.collider = Collider::kBoxes});
  bench.add_body(cube, at(0, 0, 0.05), 0);
  bench.add_body(cube, at(0, 0, 0.05), 1);
  bench.step();
  EXPECT_EQ(bench.contacts(0), 0);
  bench.add_plane();
  bench.step();
  EXPECT_EQ(bench.contacts(0), 4);
  EXPECT_EQ(bench.contacts(1), 4);
  bench.add_body(cube, at(0.01, 0.02, 0.2), 1);
  bench.step();
  EXPECT_EQ(bench.contacts(0), 4);
  EXPECT_GT(bench.contacts(1), 4);
}

TEST(Bench, RetiresACell) {
  const Shape cube = box_shape({0.2, 0.2, 0.2});
  Bench bench({.collider = Collider::kBoxes});
  const dBodyID gone = bench.add_body(cube, at(0, 0, 0.05), 0);
  const dBodyID stays = bench.add_body(cube, at(1, 0, 0.05), 1);
  bench.add_plane();
  bench.retire(0);
  for (int i = 0; i < 3; ++i) bench.step();
  EXPECT_EQ(bench.contacts(0), 0);
  EXPECT_EQ(position(gone)[2], 0.05);
  EXPECT_GT(position(stays)[2], 0.05);  // pushed out of the plane
  EXPECT_DOUBLE_EQ(bench.time(), 3.0 / 240);
}

// Along the direction given friction is mu; along the diagonal of ODE's own two it is sqrt(2) mu.
TEST(Bench, BrakesAlongTheDirectionGiven) {
  const Shape box = box_shape({0.5, 0.5, 0.1});
  const double mu = 0.2;
  const auto deceleration = [&](bool given) {
    Bench bench({.collider = Collider::kBoxes, .mu = mu});
    const Point along = unit({1, 1, 0});
    const dBodyID body = bench.add_body(box, turned({0, 0, 1}, 0.3, {0, 0, 0.05}), 0);
    bench.add_plane();
    if (given) bench.set_friction_direction(0, along);
    dBodySetLinearVel(body, 2 * along[0], 2 * along[1], 0);
    for (int i = 0; i < 120; ++i) bench.step();
    return (2 - length(velocity(body))) / bench.time();
  };
  EXPECT_NEAR(deceleration(true), mu * 9.81, 0.01 * mu * 9.81);
  EXPECT_NEAR(deceleration(false), std::sqrt(2) * mu * 9.81, 0.02 * mu * 9.81);
}

TEST(KineticEnergy, IsThatOfMovingAndOfTurning) {
  const Shape box = box_shape({0.2, 0.4, 0.6});
  Bench bench({.collider = Collider::kBoxes});
  // Turned so that the body's x is the world's y.
  const dBodyID body = bench.add_body(box, turned({0, 0, 1}, std::acos(0.0)), 0);
  const double mass = 500 * 0.2 * 0.4 * 0.6;
  dBodySetLinearVel(body, 1, 2, 2);
  EXPECT_NEAR(kinetic_energy(body), 0.5 * mass * 9, kTiny * mass * 9);
  dBodySetLinearVel(body, 0, 0, 0);
  dBodySetAngularVel(body, 0, 3, 0);
  const double inertia = mass * (0.4 * 0.4 + 0.6 * 0.6) / 12;
  EXPECT_NEAR(kinetic_energy(body), 0.5 * inertia * 9, kTiny * mass * 9);
}

TEST(Shapes, AreCentredOnTheirCentreOfMass) {
  // Three squares of one, at (-0.5, -0.5), (0.5, -0.5) and (-0.5, 0.5).
  const Point c = centre_of_mass(make_l(2));
  EXPECT_LT(distance(c, {-1.0 / 6, -1.0 / 6, 0}), 1e-7);
  EXPECT_LT(length(centre_of_mass(solid_shape(make_l(2)).mesh)), 1e-7);
}

TEST(Ground, IsFlatAndCoversTheSameSquareHoweverIrregular) {
  const GroundSize size;
  Random random(3);
  const Shape regular = regular_slab(size);
  const Shape irregular = irregular_slab(size, random);
  EXPECT_NE(irregular.mesh.vertices, regular.mesh.vertices);
  for (const Shape& shape : {regular, irregular, open_sheet(size)}) {
    double area = 0;
    int top = 0;
    for (std::size_t t = 0; t < shape.mesh.indices.size() / 3; ++t) {
      const Point a = shape.mesh.corner(t, 0), b = shape.mesh.corner(t, 1),
                  c = shape.mesh.corner(t, 2);
      if (std::min({a[2], b[2], c[2]}) < size.thickness / 2) continue;
      const Point twice = cross(b - a, c - a);
      EXPECT_GT(twice[2], 0);
      EXPECT_EQ(std::max({a[2], b[2], c[2]}), size.thickness / 2);
      area += twice[2] / 2;
      ++top;
    }
    EXPECT_EQ(top, 2048);
    EXPECT_NEAR(area, size.size * size.size, 1e-4);  // float corners
  }
}

}  // namespace
}  // namespace ode_ext::stability
