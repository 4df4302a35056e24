// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/mesh_oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <random>

#include "support/oracle_meshes.h"

namespace ode_ext::oracle {
namespace {

// Vertices are stored as float: rounding moves a coordinate below 2 by at most 2^-24 [m].
constexpr double kUnitFloat = 6e-8;

class Random {
 public:
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  Vector vector(double half) {
    return {between(-half, half), between(-half, half), between(-half, half)};
  }
  Pose pose(double half) {
    const Vector x = unit(vector(1)), z = unit(cross(x, vector(1)));
    return {{x, cross(z, x), z}, vector(half)};
  }

 private:
  std::mt19937_64 engine_{20150311};
};

Pose at(Vector position) { return {Pose{}.rows, position}; }

double box_distance(Vector half, Vector p) {
  const Vector q{std::abs(p.x) - half.x, std::abs(p.y) - half.y, std::abs(p.z) - half.z};
  const Vector outside{std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)};
  return length(outside) + std::min(std::max({q.x, q.y, q.z}), 0.0);
}

// How often the surface winds around p, by solid angles (van Oosterom and Strackee 1983): 1 inside
// and 0 outside, and nothing in common with pseudo-normals.
double winding_number(const Mesh& mesh, Vector p) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles()) {
    const Vector a = t[0] - p, b = t[1] - p, c = t[2] - p;
    const double la = length(a), lb = length(b), lc = length(c);
    sum += 2 * std::atan2(dot(a, cross(b, c)),
                          la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (4 * std::numbers::pi);
}

double brute_force_distance(const Mesh& mesh, Vector p) {
  double squared = std::numeric_limits<double>::infinity();
  for (const Triangle& t : mesh.triangles()) {
    squared = std::min(squared, closest_on_triangle(t, p).squared_distance);
  }
  return std::sqrt(squared) * (winding_number(mesh, p) > 0.5 ? -1 : 1);
}

double brute_force_depth(const Mesh& source, const Pose& from, const Mesh& target, const Pose& to) {
  double deepest = 0;
  for (const Vector& v : source.vertices()) {
    const double distance = brute_force_distance(target, to.to_local(from.to_world(v)));
    deepest = std::max(deepest, -distance);
  }
  return deepest;
}

TEST(MeshOracle, KnowsTheSignedDistanceOfABoxInsideAndOutside) {
  const Vector half{1, 0.5, 0.25};
  const Mesh box = make_box(half);
  Random random;
  for (int i = 0; i < 2000; ++i) {
    const Vector p = random.vector(1.5);
    EXPECT_NEAR(box.signed_distance(p), box_distance(half, p), 1e-14);
  }
}

// The closest points are corners and edges here, where a face's normal has the wrong sign.
TEST(MeshOracle, KnowsTheSideOfAPointThatIsClosestToAnEdgeOrACorner) {
  const Vector half{1, 1, 1};
  const Mesh box = make_box(half);
  for (const Vector& p : {Vector{1.3, 1.4, 0}, Vector{1.1, 1.2, 1.3}, Vector{-1.1, 1.001, -1.5},
                          Vector{0, -1.2, -1.0001}}) {
    EXPECT_NEAR(box.signed_distance(p), box_distance(half, p), 1e-14);
  }
}

TEST(MeshOracle, AgreesWithBruteForceAndSolidAnglesOnATorus) {
  const Mesh torus = make_torus(0.35, 0.15, 24, 12);
  ASSERT_TRUE(torus.closed());
  Random random;
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector p = random.vector(0.55);
    const double distance = brute_force_distance(torus, p);
    EXPECT_NEAR(torus.signed_distance(p), distance, 1e-12);
    inside += distance < 0;
  }
  EXPECT_GT(inside, 100);
}

TEST(MeshOracle, BoundsTheDistanceFromBelowEverywhereWithinReach) {
  const Mesh torus = make_torus(0.35, 0.15, 24, 12);
  Random random;
  int useful = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vector middle = random.vector(0.8);
    const double reach = random.between(0, 0.1);
    const double bound = torus.lower_bound(middle, reach);
    const Vector p = middle + random.between(0, reach) * unit(random.vector(1));
    EXPECT_LE(bound, torus.signed_distance(p) + 1e-12);
    useful += bound > 0;
  }
  EXPECT_GT(useful, 1000);
}

TEST(MeshOracle, FindsABoxThatStandsInAnotherByATenth) {
  const Mesh box = make_box({0.5, 0.5, 0.5});
  EXPECT_NEAR(penetration(box, {}, box, at({0.3, 0.2, 0.9})), 0.1, 1e-12);
  EXPECT_NEAR(penetration(box, at({0.3, 0.2, 0.9}), box, {}), 0.1, 1e-12);
}

TEST(MeshOracle, FindsABoxWhollyInsideAnotherWithItsDeepestCorner) {
  const Mesh big = make_box({1, 1, 1});
  const Mesh small = make_box({0.125, 0.125, 0.125});
  // The corner at -0.125 + 0.25 = 0.125 from the middle along x is 0.875 away from every side.
  EXPECT_NEAR(penetration(big, {}, small, at({0.25, 0, 0})), 0.875, 1e-12);
  EXPECT_NEAR(penetration(small, at({0.25, 0, 0}), big, {}), 0.875, 1e-12);
}

TEST(MeshOracle, FindsNothingBetweenBoxesThatAreApartOrTouch) {
  const Mesh box = make_box({0.5, 0.5, 0.5});
  EXPECT_EQ(penetration(box, {}, box, at({1.25, 0, 0})), 0);
  EXPECT_EQ(penetration(box, {}, box, at({1, 0, 0})), 0);
}

TEST(MeshOracle, FindsHowDeepTwoSpheresOverlap) {
  constexpr unsigned kRings = 48, kSides = 96;
  const Mesh sphere = make_sphere(0.5, kRings, kSides);
  ASSERT_TRUE(sphere.closed());
  const double sag = sphere_sag(0.5, kRings, kSides);
  Random random;
  for (int i = 0; i < 20; ++i) {
    const double apart = random.between(0.6, 0.99);
    Pose pose = random.pose(0);
    pose.position = apart * unit(random.vector(1));
    const double depth = penetration(sphere, {}, sphere, pose);
    // Never more than of the true spheres. At least what is left when the deepest vertex is off the
    // line of centres by half a quad's diagonal, and the other surface lies lower by its sag.
    const double diagonal =
        0.5 * std::hypot(std::numbers::pi / kRings, 2 * std::numbers::pi / kSides);
    const double off = 0.5 * diagonal;  // [m] sideways
    EXPECT_LE(depth, 1 - apart + kUnitFloat);
    EXPECT_GE(depth, 1 - apart - sag - off * off * (1 / 1.0 + 1 / apart));
  }
}

TEST(MeshOracle, FindsNothingInTheHoleOfATorusButItsTube) {
  const Mesh torus = make_torus(0.5, 0.125, 48, 24);
  const Mesh sphere = make_sphere(0.25, 12, 24);
  EXPECT_EQ(penetration(torus, {}, sphere, {}), 0);
  EXPECT_GT(penetration(torus, {}, sphere, at({0.25, 0, 0})), 0.1);
}

TEST(MeshOracle, AgreesWithBruteForceInAnyPose) {
  const Mesh torus = make_torus(0.35, 0.15, 24, 12);
  const Mesh box = make_box({0.3, 0.2, 0.1});
  Random random;
  int deep = 0;
  for (int i = 0; i < 60; ++i) {
    const Pose a = random.pose(0.4), b = random.pose(0.4);
    const Mesh& other = i % 2 == 0 ? box : torus;
    const double expected =
        std::max(brute_force_depth(torus, a, other, b), brute_force_depth(other, b, torus, a));
    EXPECT_NEAR(penetration(torus, a, other, b), expected, 1e-12);
    EXPECT_NEAR(penetration(other, b, torus, a), expected, 1e-12);
    deep += expected > 0.01;
  }
  EXPECT_GT(deep, 20);
}

TEST(MeshOracle, FindsTheSameWhereverBothMeshesAre) {
  const Mesh torus = make_torus(0.35, 0.15, 24, 12);
  Random random;
  const Pose a, b = at({0.3, 0.1, 0.05});
  const double here = penetration(torus, a, torus, b);
  ASSERT_GT(here, 0.05);
  for (int i = 0; i < 10; ++i) {
    const Pose move = random.pose(100);
    const auto moved = [&](const Pose& pose) {
      Pose result = move;
      result.position = move.to_world(pose.position);
      return result;
    };
    // 100 m away a double has an ulp of 1.4e-14 m; a few of them add up.
    EXPECT_NEAR(penetration(torus, moved(a), torus, moved(b)), here, 1e-12);
  }
}

TEST(MeshOracle, TakesLooseTrianglesForTheMeshTheyForm) {
  std::vector<float> vertices;
  std::vector<unsigned> indices;
  const Mesh original = make_box({0.5, 0.5, 0.5});
  for (const Triangle& t : original.triangles()) {
    for (const Vector& v : t) {
      indices.push_back(static_cast<unsigned>(indices.size()));
      for (const double x : {v.x, v.y, v.z}) vertices.push_back(static_cast<float>(x));
    }
  }
  const Mesh box(vertices, indices);
  EXPECT_TRUE(box.closed());
  EXPECT_EQ(box.vertices().size(), 8u);
  EXPECT_NEAR(box.signed_distance({0.7, 0.7, 0.7}), 0.2 * std::sqrt(3.0), 1e-12);
}

TEST(MeshOracle, CallsAMeshWithAHoleOpen) {
  const std::vector<float> vertices{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  EXPECT_TRUE(Mesh(vertices, std::vector<unsigned>{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}).closed());
  EXPECT_FALSE(Mesh(vertices, std::vector<unsigned>{0, 2, 1, 0, 1, 3, 1, 2, 3}).closed());
}

TEST(MeshOracle, MeasuresTheThinnestPart) {
  EXPECT_NEAR(make_box({1, 1, 0.05}).thinnest_part(), 0.1, kUnitFloat);
  // Between two opposite flat sides of a tube of 12: less than its diameter by cos(15 degrees), and
  // by little more where the inner and outer halves bend.
  const double thinnest = make_torus(0.35, 0.15, 96, 12).thinnest_part();
  EXPECT_GT(thinnest, 0.28);
  EXPECT_LE(thinnest, 0.3);
}

}  // namespace
}  // namespace ode_ext::oracle
