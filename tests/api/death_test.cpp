// SPDX-License-Identifier: BSD-3-Clause
// Where Debian's ODE itself ends the program before this library is reached: recorded, so that
// nobody looks for the fault here, and so that a newer ODE that is kinder is noticed.
#include <sys/wait.h>

#include <csignal>
#include <limits>

#include "support/batch_collider.h"
#include "support/sanitizers.h"

namespace ode_ext::test {
namespace {

// By a segmentation fault, which a sanitizer makes an exit of.
bool crashed(int status) {
  if (WIFSIGNALED(status)) return WTERMSIG(status) == SIGSEGV;
  return ODE_EXT_ADDRESS_SANITIZER != 0 && WIFEXITED(status) && WEXITSTATUS(status) != 0;
}

class OdeDeathTest : public ::testing::Test {
 protected:
  OdeDeathTest() { ::testing::FLAGS_gtest_death_test_style = "threadsafe"; }
};

TEST_F(OdeDeathTest, AbortsWhereAMeshOfNoTrianglesIsBuilt) {
  EXPECT_DEATH(
      {
        OdeWorld world;
        TestMesh empty = make_cube(1);
        empty.indices.clear();
        world.geom(world.mesh(empty), {});
      },
      "assertion \"indices\" failed in buildData");
}

// ODE reads the vertex that the index names: far enough out there is no memory.
TEST_F(OdeDeathTest, CrashesWhereAnIndexIsOutOfRange) {
  EXPECT_EXIT(
      {
        OdeWorld world;
        TestMesh mesh = make_cube(1);
        mesh.indices[5] = 0x7fffffff;
        world.geom(world.mesh(mesh), {});
      },
      crashed, "");
}

TEST_F(OdeDeathTest, AbortsWhereAnInfiniteVertexMeetsAHashSpace) {
  EXPECT_DEATH(
      {
        OdeWorld world;
        const dSpaceID space = world.space(SpaceKind::Hash);
        TestMesh mesh = make_cube(1);
        mesh.vertices[0] = std::numeric_limits<float>::infinity();
        world.geom(world.mesh(mesh), {}, space);
        world.geom(world.mesh(make_cube(1)), {}, space);
        Collected collected;
        dSpaceCollide(space, &collected, &collect_order_only);
      },
      "assertion \"aabbBound");
}

// dCollide itself does not look at its stride, only the collider of meshes does.
TEST_F(OdeDeathTest, AbortsWhereDCollidesStrideIsTooSmallWithoutACollider) {
  EXPECT_DEATH(
      {
        OdeWorld world;
        const OdeMesh& cube = world.mesh(make_cube(1));
        const dGeomID g1 = world.geom(cube, {});
        const dGeomID g2 = world.geom(cube, at(0.5, 0.25, 0.125));
        dContactGeom contacts[2];
        dCollide(g1, g2, 2, contacts, sizeof(dContactGeom) - 1);
      },
      "Stride");
}

// Stale until something asks for it: see set_mesh.
TEST_F(OdeDeathTest, AbortsInTheNextPassAfterAGeomInASpaceWasGivenAnotherMesh) {
  EXPECT_DEATH(
      {
        OdeWorld world;
        const dSpaceID space = world.space(SpaceKind::Simple);
        const OdeMesh& cube = world.mesh(make_cube(1));
        const dGeomID g1 = world.geom(cube, {}, space);
        world.geom(cube, at(0.5, 0.25, 0.125), space);
        Collected collected;
        dSpaceCollide(space, &collected, &collect_order_only);
        dGeomTriMeshSetData(g1, world.mesh(make_cube(2)).id());
        dSpaceCollide(space, &collected, &collect_order_only);
      },
      "GEOM_AABB_BAD");
}

TEST_F(OdeDeathTest, CrashesOnTwoSingleTrianglesWithoutACollider) {
  EXPECT_EXIT(
      {
        OdeWorld world;
        const OdeMesh& triangle = world.mesh(make_triangle(1));
        collide(world.geom(triangle, {}), world.geom(triangle, turned({1, 0, 0}, 1)));
      },
      crashed, "");
}

// The same pair once a collider has come and gone: ODE's own collider is reached through this
// library then, which does not pass on what crashes it.
TEST_F(OdeDeathTest, IsSparedTwoSingleTrianglesAfterTheLastCollider) {
  OdeWorld world;
  const OdeMesh& triangle = world.mesh(make_triangle(1));
  const dGeomID g1 = world.geom(triangle, {}), g2 = world.geom(triangle, turned({1, 0, 0}, 1));
  BatchCollider().destroy();
  EXPECT_TRUE(collide(g1, g2).empty());
}

TEST_F(OdeDeathTest, AbortsWhereAColliderIsCreatedBeforeOde) {
  EXPECT_DEATH(BatchCollider(), "assertion \"colliders_initialized\" failed");
}

}  // namespace
}  // namespace ode_ext::test
