// SPDX-License-Identifier: BSD-3-Clause
// Meshes that no modeller should make, and that every program meets.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bench/accuracy/contact_match.h"
#include "reference/reference_hits.h"
#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

constexpr float kFloatNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kFloatInfinity = std::numeric_limits<float>::infinity();

class ApiBadInput : public ::testing::Test {
 protected:
  Contacts contacts_of(const TestMesh& a, const TestPose& pa, const TestMesh& b,
                       const TestPose& pb) {
    const Contacts contacts = collide(world.geom(world.mesh(a), pa), world.geom(world.mesh(b), pb));
    for (const dContactGeom& c : contacts) {
      EXPECT_TRUE(std::isfinite(c.depth) && c.depth >= 0);
      EXPECT_NEAR(length(normal(c)), 1, 1e-6);
      for (int k = 0; k < 3; ++k) EXPECT_TRUE(std::isfinite(c.pos[k]));
      EXPECT_GE(c.side1, 0);
      EXPECT_LT(c.side1, a.triangle_count());
      EXPECT_GE(c.side2, 0);
      EXPECT_LT(c.side2, b.triangle_count());
    }
    return contacts;
  }

  OdeWorld world;
  BatchCollider collider;
  const TestMesh block = make_box({6, 6, 2});
  const TestMesh cube = make_cube(2);
  const TestPose on_block = turned({0, 0, 1}, 0.3, {0.1, 0.2, 1.9});  // 0.1 deep, nothing aligned
};

// ODE gives such a pair nothing; here the triangle's corners below the top are contacts.
TEST_F(ApiBadInput, OneTriangleAgainstAMeshHasContacts) {
  const TestPose standing = turned({1, 0, 0}, 1.0, {0.1, 0.2, 1.2});
  const auto contacts = contacts_of(make_triangle(1), standing, block, {});
  EXPECT_FALSE(contacts.empty());
}

TEST_F(ApiBadInput, TwoSingleTrianglesDoNotCrash) {
  contacts_of(make_triangle(1), {}, make_triangle(1), turned({1, 0, 0}, 1.2, {0.1, 0.1, 0}));
}

TEST_F(ApiBadInput, TwoSingleTrianglesApartHaveNoContacts) {
  EXPECT_TRUE(contacts_of(make_triangle(1), {}, make_triangle(1), at(0, 0, 5)).empty());
}

// The message goes with the pass that met the mesh.
TEST_F(ApiBadInput, VerticesThatAreNotFiniteRefuseTheMeshAndSayso) {
  for (const float bad : {kFloatNan, kFloatInfinity, -kFloatInfinity}) {
    const dSpaceID space = world.space(SpaceKind::Simple);
    OdeMesh& broken = world.mesh(make_cube(2, 3));
    const dGeomID g1 = world.geom(broken, on_block, space);
    const dGeomID g2 = world.geom(world.mesh(block), {}, space);
    broken.edit().vertices[7] = bad;  // after ODE has sized the box
    const Collected collected = collider.pass(space);
    EXPECT_EQ(collected.total(), 0);
    EXPECT_NE(collider.stats().status & dBatchStatusMeshRefused, 0u);
    broken.edit() = make_cube(2, 3);
    broken.rebuild(make_cube(2, 3));
    EXPECT_GT(collider.pass(space).total(), 0);  // mended, it is welcome again
    EXPECT_EQ(collider.stats().status & dBatchStatusMeshRefused, 0u);
    dGeomDisable(g1);
    dGeomDisable(g2);
  }
}

TEST_F(ApiBadInput, ABrokenMeshDoesNotCostTheOthersTheirContacts) {
  const dSpaceID space = world.space(SpaceKind::Simple);
  OdeMesh& broken = world.mesh(make_cube(2, 3));
  world.geom(broken, at(0.5, 0.25, 1.75), space);
  const dGeomID g1 = world.geom(world.mesh(cube), on_block, space);
  const dGeomID g2 = world.geom(world.mesh(block), {}, space);
  broken.edit().vertices[7] = kFloatNan;
  collider.pass(space);
  const Contacts contacts = collide(g1, g2);
  EXPECT_FALSE(contacts.empty());
  EXPECT_EQ(difference_with_geoms(contacts, fresh_answer(g1, g2)), "");
}

TEST_F(ApiBadInput, TrianglesWithoutAreaChangeNothing) {
  TestMesh needles = cube;
  needles.indices.insert(needles.indices.end(), {0, 0, 1, 2, 2, 2});
  const Contacts clean = contacts_of(cube, on_block, block, {});
  const Contacts contacts = contacts_of(needles, on_block, block, {});
  EXPECT_FALSE(clean.empty());
  EXPECT_EQ(difference(contacts, clean), "");
}

// Three vertices in a line: an area of zero without equal corners. The mesh is not closed by it.
TEST_F(ApiBadInput, CollinearTrianglesDoNotCrash) {
  TestMesh mesh = cube;
  const auto first = static_cast<unsigned>(mesh.vertex_count());
  mesh.vertices.insert(mesh.vertices.end(), {-1, -1, -1, 0, -1, -1, 1, -1, -1});
  mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2});
  EXPECT_FALSE(contacts_of(mesh, on_block, block, {}).empty());
}

TEST_F(ApiBadInput, FacesGivenTwiceStillCollide) {
  EXPECT_FALSE(contacts_of(merged(cube, cube), on_block, block, {}).empty());
  EXPECT_FALSE(contacts_of(cube, on_block, merged(block, block), {}).empty());
}

// A fin on an edge: three triangles share it.
TEST_F(ApiBadInput, EdgesOfThreeTrianglesStillCollide) {
  TestMesh fin = cube;
  fin.vertices.insert(fin.vertices.end(), {0, 0, 2});
  fin.indices.insert(fin.indices.end(), {fin.indices[0], fin.indices[1],
                                         static_cast<unsigned>(fin.vertex_count() - 1)});
  EXPECT_FALSE(contacts_of(fin, on_block, block, {}).empty());
}

TEST_F(ApiBadInput, TwoSolidsInOneMeshBothCollide) {
  const TestMesh pair = merged(moved(cube, {-4, 0, 0}), moved(cube, {4, 0, 0}));
  const Contacts contacts = contacts_of(pair, at(0.1, 0.2, 1.9), make_box({16, 16, 2}), {});
  bool left = false, right = false;
  for (const dContactGeom& c : contacts) (c.pos[0] < 0 ? left : right) = true;
  EXPECT_TRUE(left);
  EXPECT_TRUE(right);
}

TEST_F(ApiBadInput, AnInvertedClosedMeshHasTheContactsOfTheUprightOne) {
  const TestMesh torus = make_torus(1, 0.4, 12, 8);
  const TestPose pose = turned({1, 2, 3}, 1, {0.3, 0.2, 1.3});
  const Contacts upright = contacts_of(torus, pose, block, {});
  const Contacts turned_in = contacts_of(inverted(torus), pose, inverted(block), {});
  ASSERT_FALSE(upright.empty());
  EXPECT_EQ(difference(turned_in, upright), "");
}

// In whose frame a pair is computed is decided by the content of its meshes, and with it what
// rounds: by 2^-20 of the extents at most (pair_step.cl), here about 10.
constexpr double kRounding = 1e-5;

using accuracy::same_contacts;

// Of `every` consecutive triangles one is wound the other way, the `which`th.
TestMesh badly_wound(TestMesh mesh, std::size_t every, std::size_t which = 0) {
  for (std::size_t t = 3 * which; t < mesh.indices.size(); t += 3 * every)
    std::swap(mesh.indices[t + 1], mesh.indices[t + 2]);
  return mesh;
}

TEST_F(ApiBadInput, AClosedMeshWoundAnyhowHasTheContactsOfTheUprightOne) {
  const TestMesh torus = make_torus(1, 0.4, 12, 8);
  const TestPose pose = turned({1, 2, 3}, 1, {0.3, 0.2, 1.8});
  const Contacts upright = contacts_of(torus, pose, block, {});
  ASSERT_FALSE(upright.empty());
  ASSERT_LT(upright.size(), 16u);  // none is left out, where rounding may decide which
  for (const std::size_t every : {2u, 3u, 7u, 1000u}) {
    const TestMesh some = badly_wound(torus, every), others = inverted(some);
    const Contacts both = contacts_of(some, pose, badly_wound(block, every), {});
    EXPECT_TRUE(same_contacts(both, upright, kRounding)) << every;
    EXPECT_TRUE(same_contacts(contacts_of(others, pose, block, {}), upright, kRounding)) << every;
  }
}

// Parts that contradict themselves say nothing about one another: each is a solid.
TEST_F(ApiBadInput, PartsOfAMeshWoundAnyhowAreSolidsEach) {
  const TestMesh left = moved(cube, {-4, 0, 0}), right = moved(cube, {4, 0, 0});
  const TestMesh floor = make_box({16, 16, 2});
  const TestPose pose = turned({0, 0, 1}, 0.3, {0.1, 0.2, 1.9});
  const Contacts upright = contacts_of(merged(left, right), pose, floor, {});
  ASSERT_FALSE(upright.empty());
  const TestMesh bad = merged(badly_wound(left, 1000), inverted(right));
  EXPECT_TRUE(same_contacts(contacts_of(bad, pose, floor, {}), upright, kRounding));
}

// A part that is wound consistently is believed: the wrong way round it is a cavity, which has no
// inside where there is nothing around it.
TEST_F(ApiBadInput, APartWoundInsideOutDoesNotDisturbTheOthers) {
  const TestMesh pair = merged(make_box({6, 6, 2}), inverted(moved(cube, {20, 0, 0})));
  contacts_of(cube, at(20.1, 0.2, 0.3), pair, {});  // what it says is sound, which way is not
  const Contacts on_block_alone = contacts_of(cube, on_block, block, {});
  EXPECT_TRUE(same_contacts(contacts_of(cube, on_block, pair, {}), on_block_alone, kRounding));
}

// Each edge of the projective plane on six places has two triangles, and yet it has no sides.
TEST_F(ApiBadInput, ASurfaceWithoutSidesStillCollidesWhereItIsCrossed) {
  TestMesh plane;
  plane.vertices = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 2, 2, 1, 1};
  plane.indices = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5, 0, 1, 5,
                   1, 2, 4, 2, 3, 5, 1, 3, 4, 2, 4, 5, 1, 3, 5};
  EXPECT_FALSE(contacts_of(plane, turned({1, 2, 3}, 0.4, {0.1, 0.2, 0.7}), block, {}).empty());
  EXPECT_TRUE(contacts_of(plane, at(0.1, 0.2, 1.1), block, {}).empty());
}

// What is open is taken as it is wound.
TEST_F(ApiBadInput, AnOpenMeshWoundAnyhowStillCollidesWhereItIsCrossed) {
  for (const std::size_t every : {1u, 2u, 3u}) {  // 1: all of it from below
    const TestMesh sheet = badly_wound(make_sheet(8, 3), every);
    EXPECT_FALSE(contacts_of(cube, turned({1, 2, 3}, 0.4, {0.1, 0.2, 0.9}), sheet, {}).empty());
  }
}

TEST_F(ApiBadInput, AnOpenSheetCarriesACube) {
  const Contacts contacts = contacts_of(cube, at(0.1, 0.2, 0.9), make_sheet(8, 3), {});
  ASSERT_FALSE(contacts.empty());
  for (const dContactGeom& c : contacts) {
    EXPECT_LT(distance(normal(c), {0, 0, 1}), 1e-6);
    EXPECT_LE(c.depth, 0.1 + 1e-6);
  }
  EXPECT_NEAR(contacts[0].depth, 0.1, 1e-6);
}

TEST_F(ApiBadInput, TwoOpenSheetsDoNotCrash) {
  contacts_of(make_sheet(4, 3), {}, make_sheet(4, 3), turned({1, 0, 0}, 0.7, {0.1, 0.1, 0.1}));
}

// The answer scales with the scene: float has the same digits everywhere.
TEST_F(ApiBadInput, CoordinatesOfAMillionAndAMillionthCollideAsThoseOfOne) {
  const Contacts one = contacts_of(cube, on_block, block, {});
  ASSERT_FALSE(one.empty());
  for (const double scale : {0x1p20, 0x1p-20}) {  // powers of two: nothing rounds differently
    TestPose pose = on_block;
    pose.position = scale * pose.position;
    const Contacts other = contacts_of(scaled(cube, scale), pose, scaled(block, scale), {});
    ASSERT_EQ(other.size(), one.size()) << scale;
    // Which mesh comes first goes by their contents, and which of equally deep ones by that.
    for (const dContactGeom& c : other)
      EXPECT_TRUE(std::any_of(one.begin(), one.end(), [&](const dContactGeom& d) {
        return std::fabs(c.depth / scale - d.depth) < 1e-6 &&
               distance(normal(c), normal(d)) < 1e-6 &&
               distance((1 / scale) * pos(c), pos(d)) < 1e-5;
      })) << scale;
    for (const dContactGeom& d : one)
      EXPECT_TRUE(std::any_of(other.begin(), other.end(), [&](const dContactGeom& c) {
        return distance((1 / scale) * pos(c), pos(d)) < 1e-5;
      })) << scale;
  }
}

// A grain on a boulder: the coordinates of the pair are the boulder's, and 2^-20 of them, 1.3 mm,
// is what rounding may do; nearer than four times that may be a touch.
TEST_F(ApiBadInput, ATinyMeshOnALargeOneCollides) {
  const TestMesh grain = make_cube(0.01), boulder = make_cube(1000);
  EXPECT_FALSE(contacts_of(grain, at(0.1, 0.2, 500.004), boulder, {}).empty());
  EXPECT_TRUE(contacts_of(grain, at(0.1, 0.2, 500.011), boulder, {}).empty());
}

}  // namespace
}  // namespace ode_ext::test
