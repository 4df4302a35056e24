// SPDX-License-Identifier: BSD-3-Clause
#include "ode/members.h"

#include <gtest/gtest.h>

#include <memory>

#include "support/ode_world.h"

namespace ode_ext::test {
namespace {

TEST(Members, LetGoOfAMeshThatIsDestroyedOnWhateverGeomItWas) {
  OdeWorld world;
  const dTriMeshDataID gone = world.mesh(make_icosphere(1, 1)).id();
  const dTriMeshDataID kept = world.mesh(make_icosphere(1, 1)).id();
  const dGeomID geom = world.geom(world.mesh(make_icosphere(1, 1)), {});
  const auto mesh = std::make_shared<const Mesh>();
  const auto other = std::make_shared<const Mesh>();
  Members members;
  Members::Seen& seen = members.seen(geom);
  members.note(seen, geom, gone, mesh, Pose{}, 1);
  const std::uint64_t stamp = members.note(seen, geom, kept, other, Pose{}, 2).stamp;
  ASSERT_EQ(mesh.use_count(), 2) << "as it was before";
  members.forget(gone);
  EXPECT_EQ(mesh.use_count(), 1);
  EXPECT_EQ(members.at(geom, stamp).mesh, other);
  EXPECT_EQ(Members::find_same(seen, kept, other.get(), Pose{}, 3), &seen.now);
  EXPECT_EQ(Members::find_same(seen, gone, mesh.get(), Pose{}, 3), nullptr);
}

TEST(Members, LetGoOfAMeshThatWasEdited) {
  OdeWorld world;
  const OdeMesh& ball = world.mesh(make_icosphere(1, 1));
  const dGeomID geom = world.geom(ball, {});
  const auto mesh = std::make_shared<const Mesh>(), edited = std::make_shared<const Mesh>();
  Members members;
  Members::Seen& seen = members.seen(geom);
  members.note(seen, geom, ball.id(), mesh, Pose{}, 1);
  ASSERT_EQ(mesh.use_count(), 2);
  members.note(seen, geom, ball.id(), edited, Pose{}, 2);
  EXPECT_EQ(mesh.use_count(), 1);
  EXPECT_EQ(Members::find_same(seen, ball.id(), edited.get(), Pose{}, 3), &seen.now);
}

TEST(Members, LetGoOfMeshesThatAreDestroyedBeforeTheNextPassAtTheLatest) {
  OdeWorld world;
  Members members;
  const auto mesh = std::make_shared<const Mesh>();
  const OdeMesh& ball = world.mesh(make_icosphere(1, 1));
  for (int i = 0; i < 40; ++i) {
    const dGeomID geom = world.geom(ball, {});
    members.note(members.seen(geom), geom, ball.id(), mesh, Pose{}, 1);
  }
  ASSERT_EQ(mesh.use_count(), 41);
  members.forget(ball.id());
  members.let_go();
  EXPECT_EQ(mesh.use_count(), 1);
}

}  // namespace
}  // namespace ode_ext::test
