// SPDX-License-Identifier: BSD-3-Clause
// What a collider tells of its contacts and meshes, as a picture.
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <set>

#include "falling_objects/show/coats.h"
#include "falling_objects/show/space_view.h"
#include "simulation/scene.h"
#include "support/batch_collider.h"
#include "view/spots.h"
#include "view/studio.h"

namespace view_tests {
namespace {

using falling_objects::Overlays;
using falling_objects::SpaceView;
using ode_ext::test::at;
using ode_ext::test::Contacts;
using ode_ext::test::make_cube;
using ode_ext::test::make_icosphere;
using ode_ext::test::make_plate;
using ode_ext::test::merged;
using ode_ext::test::moved;
using ode_ext::test::OdeWorld;
using ode_ext::test::TestMesh;
using ode_ext::test::TestPose;

class ColliderOverlays : public testing::Test {
 protected:
  ~ColliderOverlays() override { dWorldDestroy(dynamics); }
  dGeomID add(const TestMesh& mesh, const TestPose& pose) {
    dGeomID geom = world.geom(world.mesh(mesh), {}, space);
    falling_objects::set_index(geom, next++);
    dGeomSetCategoryBits(geom, falling_objects::kMeshBit);
    dBodyID body = dBodyCreate(dynamics);
    dGeomSetBody(geom, body);
    ode_ext::test::set_pose(geom, pose);
    return geom;
  }
  view::Frame frame(const Contacts& contacts, const Overlays& overlays) {
    return view.frame(space, nullptr, contacts, overlays, collider);
  }
  view::Image draw(const view::Frame& frame) {
    camera = falling_objects::overview(frame);
    camera.azimuth = -1.5708F;  // x to the right
    return studio.draw({&frame, 1}, camera);
  }

  OdeWorld world;
  dWorldID dynamics = dWorldCreate();
  dSpaceID space = world.space(ode_ext::test::SpaceKind::Simple);
  ode_ext::test::BatchCollider collider;
  std::size_t next = 0;
  view::Studio studio{{320, 240}};
  SpaceView view{studio.renderer()};
  view::Camera camera;
};

bool has(const Pixel& p, view::Color color) {  // its hue, through something too
  const glm::vec3 seen(static_cast<float>(p.red), static_cast<float>(p.green),
                       static_cast<float>(p.blue));
  const auto hue = [](glm::vec3 c) { return c - glm::vec3((c.x + c.y + c.z) / 3); };
  return glm::length(hue(seen)) > 30 &&
         glm::dot(glm::normalize(hue(seen)), glm::normalize(hue(color))) > 0.9F;
}

// A table of two feet, each of which stands in the floor.
TEST_F(ColliderOverlays, ShowTheRegionsOfOverlapInTwoColors) {
  const TestMesh foot = make_cube(0.4);
  const dGeomID table =
      add(merged(moved(foot, {-0.8, 0, 0}), moved(foot, {0.8, 0, 0})), at(0, 0, 0.19));
  const dGeomID floor = add(make_plate(3, 0.4, 1), at(0, 0, -0.2));
  const Contacts contacts = answer_of(collider, table, floor);
  Overlays overlays;
  EXPECT_TRUE(frame(contacts, overlays).patches.empty());
  overlays.regions = overlays.contacts = true;
  const view::Frame seen = frame(contacts, overlays);
  ASSERT_EQ(seen.patches.size(), 2U);
  EXPECT_NE(seen.patches[0].color, seen.patches[1].color);
  const view::Image image = draw(seen);
  for (const view::Patch& patch : seen.patches) {
    glm::vec3 middle(0);
    for (const glm::vec3& corner : patch.corners) {
      middle += corner / static_cast<float>(patch.corners.size());
    }
    EXPECT_NEAR(std::abs(middle.x), 0.8F, 0.1F);
    const Mask mask = [&](const Pixel& p) { return has(p, patch.color); };
    EXPECT_TRUE(is_near(image, mask, camera, middle, 3));
    EXPECT_EQ(spots(image, mask, 20), 1);
  }
  for (const view::Arrow& arrow : seen.arrows) {
    EXPECT_TRUE(arrow.color == seen.patches[0].color || arrow.color == seen.patches[1].color);
  }
}

TEST_F(ColliderOverlays, ShowWhatIsInsideSomethingThroughIt) {
  const dGeomID block = add(make_cube(1, 2), at(0, 0, 0));
  const dGeomID grain = add(make_icosphere(0.2, 2), at(0.05, 0, 0.1));
  const Contacts contacts = answer_of(collider, block, grain);
  const Mask is_pink = [](const Pixel& p) { return p.red > p.green + 40 && p.blue > p.green + 40; };
  EXPECT_EQ(area(draw(frame(contacts, {})), is_pink), 0);
  Overlays overlays;
  overlays.inside = true;
  const view::Frame seen = frame(contacts, overlays);
  ASSERT_EQ(seen.shown_through.size(), 1U);
  EXPECT_EQ(spots(draw(seen), is_pink, 50), 1);
  EXPECT_TRUE(is_near(draw(seen), is_pink, camera, {0.05F, 0, 0.1F}, 2));
  // Half out of it, it is inside no more.
  dGeomSetPosition(grain, 0.5, 0, 0);
  EXPECT_TRUE(frame(answer_of(collider, block, grain), overlays).shown_through.empty());
}

TEST_F(ColliderOverlays, ShowMeshletsInColorsOnceTheMeshIsKnown) {
  const dGeomID ball = add(make_icosphere(0.5, 3), at(0, 0, 0));
  const dGeomID other = add(make_icosphere(0.5, 3), at(0.9, 0, 0));
  Overlays overlays;
  overlays.meshlets = true;
  EXPECT_EQ(frame({}, overlays).objects.size(), 2U);
  answer_of(collider, ball, other);
  const view::Frame seen = frame({}, overlays);
  std::set<std::array<float, 3>> colors;
  for (const view::Instance& coat : seen.objects) {
    colors.insert({coat.color.x, coat.color.y, coat.color.z});
  }
  EXPECT_GE(colors.size(), 5U);
  const view::Image image = draw(seen);
  for (const auto& [red, green, blue] : colors) {
    const view::Color color{red, green, blue};
    EXPECT_GT(area(image, [&](const Pixel& p) { return has(p, color); }), 50);
  }
  EXPECT_EQ(view.frame(space, nullptr, {}, {}, collider).objects.size(), 2U);
}

TEST(Coats, GiveMeshletsThatMeetDifferentColors) {
  // A strip of squares, two triangles and a meshlet each.
  falling_objects::IndexedMesh strip;
  std::vector<int> meshlets;
  for (unsigned i = 0; i < 20; ++i) {
    for (const float y : {0.0F, 1.0F}) strip.positions.emplace_back(static_cast<float>(i), y, 0);
    if (i == 0) continue;
    const unsigned a = 2 * (i - 1);
    strip.triangles.insert(strip.triangles.end(), {a, a + 2, a + 3, a, a + 3, a + 1});
    meshlets.insert(meshlets.end(), 2, static_cast<int>((i - 1) % 2 == 0 ? i - 1 : i + 7));
  }
  const auto coats = falling_objects::coats_of(strip, meshlets);
  std::size_t triangles = 0;
  for (const auto& coat : coats) {
    triangles += coat.size() / 3;
    std::map<unsigned, std::set<unsigned>> squares_at;  // by vertex
    for (std::size_t i = 0; i < coat.size(); ++i) {
      const std::size_t first = i - i % 3;
      squares_at[coat[i]].insert(std::min({coat[first], coat[first + 1], coat[first + 2]}) / 2);
    }
    for (const auto& [vertex, squares] : squares_at) EXPECT_EQ(squares.size(), 1U);
  }
  EXPECT_EQ(triangles, meshlets.size());
}

}  // namespace
}  // namespace view_tests
