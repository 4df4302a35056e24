// SPDX-License-Identifier: BSD-3-Clause
// Bodies on a sheet, which has no front: on which side they are is known by where their middle is.
// And a sheet on a ground, of which it is not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <vector>

#include "contacts/bowl.h"
#include "contacts/placed.h"
#include "contacts/upright.h"
#include "support/deform_rig.h"

namespace ode_ext::test {
namespace {

// A bowl with a wall: its outer face, the inner one, and the rim between them.
TestMesh make_thick_bowl(int rows, int around, float wall) {
  TestMesh bowl = make_bowl(rows, around);
  TestMesh inner = inverted(bowl);
  const auto count = static_cast<unsigned>(bowl.vertex_count());
  for (const float v : inner.vertices) bowl.vertices.push_back(v * (1 - wall / 0.3f));
  for (const unsigned v : inner.indices) bowl.indices.push_back(count + v);
  const unsigned rim = count - static_cast<unsigned>(around);
  for (unsigned i = 0; i < static_cast<unsigned>(around); ++i) {
    const unsigned a = rim + i, b = rim + (i + 1) % static_cast<unsigned>(around);
    bowl.indices.insert(bowl.indices.end(), {a, b, count + b, a, count + b, count + a});
  }
  return bowl;
}

struct Shape {
  const char* name;
  TestMesh mesh;
};

// Contacts point into the body.
std::vector<Contact> contacts_of(const TestMesh& body, const TestPose& at, const TestMesh& sheet,
                                 const TestPose& sheet_at) {
  Scene scene;
  scene.meshes = {std::make_shared<const Mesh>(build_mesh(soup_of(body))),
                  deformable(soup_of(sheet), 0.02f)};
  scene.objects = {{collider_pose(at), 0, 1}, {collider_pose(sheet_at), 1, 2}};
  scene.pairs = {{0, 1}};
  return collider().collide(scene, nullptr).contacts;
}

struct Dipped {
  double in;  // [m] how far its lowest vertex is below the sheet
  std::vector<Contact> found;
};

// A body turned in any way, into a flat sheet of few cells or many, wound either way.
Dipped dip(Random& random, const TestMesh& body, int i) {
  TestPose pose = tilted(random, std::numbers::pi, TestPose{});
  const double in = std::pow(10, random.uniform(-3, -1.7));
  pose.position = {0.01, 0.02, -lowest_of(body, pose)[2] - in};
  const TestMesh sheet = make_sheet(4, i % 3 == 0 ? 4 : 40);
  const TestPose frame = i % 4 == 0 ? TestPose{} : random.pose(2);
  Dipped dipped{
      in, contacts_of(body, composed(frame, pose), i % 2 == 0 ? inverted(sheet) : sheet, frame)};
  for (Contact& c : dipped.found) {
    const Point n = rotate_back(frame, point_of(c.normal));
    c.normal = {n[0], n[1], n[2]};
  }
  return dipped;
}

// Before the side was known, contacts pointed down in 231 of these 1,000 poses, by up to 59 times
// as far as the body was in.
TEST(BodiesOnSheets, OpenOnesAreHeldUpByAsMuchAsTheyAreIn) {
  Random random(41);
  for (const Shape& shape :
       std::vector<Shape>{{"bowl", make_bowl(6, 20)},
                          {"inverted bowl", inverted(make_bowl(6, 20))},
                          {"coarse bowl", make_bowl(3, 11)},
                          {"box", opened(make_box({0.3, 0.25, 0.2}), 0.1)},
                          {"fine box", opened(make_box({0.3, 0.25, 0.2}, 4, 4, 4), 0.1)}})
    for (int i = 0; i < 200; ++i) {
      const Dipped dipped = dip(random, shape.mesh, i);
      ASSERT_FALSE(dipped.found.empty()) << shape.name << ", " << i;
      for (const Contact& c : dipped.found) EXPECT_GT(c.normal.z, 0) << shape.name << ", " << i;
      EXPECT_LE(deepest(dipped.found), 1.001 * dipped.in) << shape.name << ", " << i;
      EXPECT_GT(deepest(dipped.found), 0.5 * dipped.in) << shape.name << ", " << i;
    }
}

// Whose wall is 1 cm: before, contacts pointed down in 55 of 200.
TEST(BodiesOnSheets, OnesWithThinWallsAreHeldUp) {
  Random random(42);
  const TestMesh bowl = make_thick_bowl(6, 20, 0.01f);
  int shallow = 0;
  for (int i = 0; i < 200; ++i) {
    const Dipped dipped = dip(random, bowl, i);
    ASSERT_FALSE(dipped.found.empty()) << i;
    for (const Contact& c : dipped.found) EXPECT_GT(c.normal.z, 0) << i;
    EXPECT_LE(deepest(dipped.found), 1.001 * dipped.in) << i;
    if (deepest(dipped.found) < 0.5 * dipped.in) ++shallow;
  }
  EXPECT_LE(shallow, 4);  // by a rim that is in by more than the wall is thick
}

// A cloth of 1 m, tilted, whose lowest corner is in the top of a block of 24 m by 3 m: along the
// normal of the cloth the middle of the block may be on either side.
TEST(BodiesOnSheets, SheetsOnALargeGroundLeaveByItsTop) {
  Random random(43);
  const TestMesh ground = make_box({24, 24, 3}, 6, 6, 1);
  const TestMesh cloth = make_sheet(1, 16);
  for (int i = 0; i < 200; ++i) {
    TestPose pose = tilted(random, radians(15), TestPose{});
    const double in = random.uniform(0.002, 0.02);
    pose.position = {random.uniform(-10, 10), random.uniform(-10, 10),
                     1.5 - in - lowest_of(cloth, pose)[2]};
    const auto found = contacts_of(ground, TestPose{}, i % 2 == 0 ? inverted(cloth) : cloth, pose);
    ASSERT_FALSE(found.empty()) << i;
    EXPECT_LE(deepest(found), 1.001 * in) << i;
    for (const Contact& c : found) EXPECT_LT(c.normal.z, -0.9) << i;
  }
}

}  // namespace
}  // namespace ode_ext::test
