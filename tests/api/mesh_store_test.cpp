// SPDX-License-Identifier: BSD-3-Clause
// What the store builds of a mesh that changes; what the answers are then is in meshes_test.cpp.
#include "ode/mesh_store.h"

#include <gtest/gtest.h>

#include "support/mesh_makers.h"
#include "support/ode_world.h"

namespace ode_ext::test {
namespace {

class MeshStoreTest : public ::testing::Test {
 protected:
  // The mesh in the next pass, after vertex 0 was moved by so much.
  const Mesh& pass(float by = 0) {
    mesh_.edit().vertices[0] += by;
    ++pass_;
    return *store_.refresh(mesh_.id(), pass_, pass_);
  }

  static bool has_grids(const Mesh& mesh) { return !mesh.clearance.steps.empty(); }

  OdeWorld world_;
  OdeMesh& mesh_ = world_.mesh(make_icosphere(1, 2));
  MeshStore store_{0, false};
  std::uint64_t pass_ = 0;
};

TEST_F(MeshStoreTest, BuildsNoGridsWhereAMeshChangesPassAfterPass) {
  EXPECT_TRUE(has_grids(pass()));
  EXPECT_FALSE(has_grids(pass(0.01f)));
  EXPECT_FALSE(has_grids(pass(0.01f)));
}

TEST_F(MeshStoreTest, BuildsGridsWhereAMeshChangesNowAndThen) {
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(has_grids(pass(0.01f)));
    EXPECT_TRUE(has_grids(pass()));
  }
}

TEST_F(MeshStoreTest, BuildsTheGridsOnceAMeshHasComeToRest) {
  pass();
  pass(0.01f);
  pass(0.01f);
  const Mesh* before = &pass();
  EXPECT_FALSE(has_grids(*before));
  int passes = 1;
  while (!has_grids(pass()) && passes < 100) ++passes;
  EXPECT_LT(passes, 20);
  const Mesh* after = &pass();
  EXPECT_EQ(&pass(), after) << "built again and again";
}

}  // namespace
}  // namespace ode_ext::test
