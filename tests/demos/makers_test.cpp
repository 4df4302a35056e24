// SPDX-License-Identifier: BSD-3-Clause
// The shapes that scenes are made of are solids, and those that fit into each other do.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/mesh_oracle.h"
#include "makers/catalog.h"
#include "makers/solids.h"
#include "makers/spur_gear.h"
#include "makers/swept.h"
#include "makers/thread.h"

namespace falling_objects {
namespace {

using ode_ext::oracle::Mesh;
using ode_ext::oracle::Pose;
using ode_ext::oracle::Vector;

constexpr double kPi = std::numbers::pi;

Mesh oracle_mesh(const TriangleMesh& mesh) { return Mesh(mesh.vertices, mesh.indices); }

Pose turned_about_z(double angle, const Vector& position) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}}, position};
}

TEST(ShapeMakers, MakeClosedMeshesWoundOutwards) {
  for (const ShapeMaker& maker : shape_makers()) {
    std::vector<double> values;
    for (const ShapeParameter& p : maker.parameters) values.push_back(p.fallback);
    const TriangleMesh mesh = maker.make(values);
    EXPECT_TRUE(is_closed(mesh)) << maker.name;
    EXPECT_GT(signed_volume(mesh), 0) << maker.name;
    EXPECT_GT(smallest_area(mesh), 1e-7) << maker.name;
  }
}

// Polygons are inside their circles: volumes fall short by a few percent.
TEST(ShapeMakers, MakeTheVolumesOfTheirFormulas) {
  EXPECT_NEAR(signed_volume(make_box(1, 2, 3, 3)), 6, 1e-5);
  const auto expect_just_below = [](double volume, double formula) {
    EXPECT_LT(volume, formula);
    EXPECT_GT(volume, 0.97 * formula);
  };
  expect_just_below(signed_volume(make_sphere(0.5, 36)), kPi / 6);
  expect_just_below(signed_volume(make_cylinder(0.5, 2, 36)), kPi / 2);
  expect_just_below(signed_volume(make_torus(0.4, 0.1, 48, 24)), 2 * kPi * kPi * 0.4 * 0.01);
  expect_just_below(signed_volume(make_pipe(0.5, 0.3, 1, 36)), kPi * 0.16);
  expect_just_below(signed_volume(make_shell(0.5, 0.3, 36)), 4 * kPi / 3 * (0.125 - 0.027));
  // A link: two half circles and two straight ways of wire.
  expect_just_below(signed_volume(make_link(0.3, 0.14, 0.05, 24)),
                    kPi * 0.0025 * (2 * kPi * 0.12 + 2 * 0.16));
}

TEST(ShapeMakers, KeepLinksThatHangTautFromTouchingByAHairAndNoMore) {
  const Mesh link = oracle_mesh(make_link(0.3, 0.14, 0.05, 24));
  const auto depth = [&](double apart) {
    return penetration(link, {}, link, turned_about_z(kPi / 2, {0, 0, apart}));
  };
  EXPECT_EQ(depth(0.298), 0);
  EXPECT_GT(depth(0.304), 0.002);
}

constexpr Thread kThread{0.1, 0.075, 0.1, 48, 6};

Thread of_a_nut() {
  Thread thread = kThread;
  thread.turns = 2;
  return thread;
}

TEST(ShapeMakers, MakeNutsThatFitWhereverTheyHaveBeenTurnedTo) {
  const Mesh bolt = oracle_mesh(make_bolt(kThread, 0.2, 0.1));
  const Mesh nut = oracle_mesh(make_nut(of_a_nut(), 0.003, 0.2));
  for (const double turn : {0.0, 0.1, 0.37, 0.5, 0.93}) {
    const Vector up{0, 0, kThread.pitch * (3 + turn)};
    EXPECT_EQ(penetration(nut, turned_about_z(2 * kPi * turn, up), bolt, {}), 0) << turn;
  }
}

TEST(ShapeMakers, MakeNutsThatCannotBePulledOffTheirBolt) {
  const Mesh bolt = oracle_mesh(make_bolt(kThread, 0.2, 0.1));
  const Mesh nut = oracle_mesh(make_nut(of_a_nut(), 0.003, 0.2));
  for (const double up : {-0.05, -0.006, 0.006, 0.05}) {
    const Vector off{0, 0, 3 * kThread.pitch + up};
    EXPECT_GT(penetration(nut, turned_about_z(0, off), bolt, {}), 0.001) << up;
  }
}

TEST(ShapeMakers, MakeGearsThatMeshInEveryPosition) {
  const auto gear = [](unsigned teeth) {
    return oracle_mesh(make_spur_gear({teeth, 0.1, 0.2, 0.01, 0}));
  };
  const Mesh small = gear(12), large = gear(31);
  for (int i = 0; i < 10; ++i) {
    const double turn = 0.1 * i * 2 * kPi / 12;
    const Pose one = turned_about_z(turn, {});
    const auto depth = [&](double amiss) {
      return penetration(small, one, large,
                         turned_about_z(amiss - turn * 12 / 31, {(12 + 31) * 0.05, 0, 0}));
    };
    EXPECT_LT(depth(0), 0.0005) << i;
    EXPECT_GT(depth(0.02), 0.005) << i;  // 3 cm at its rim
  }
}

}  // namespace
}  // namespace falling_objects
