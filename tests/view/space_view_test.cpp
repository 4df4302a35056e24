// SPDX-License-Identifier: BSD-3-Clause
// An ODE space as a picture.
#include "falling_objects/show/space_view.h"

#include <gtest/gtest.h>

#include "falling_objects/show/hand.h"
#include "makers/solids.h"
#include "meshes/shapes.h"
#include "view/spots.h"
#include "view/studio.h"

namespace view_tests {
namespace {

using falling_objects::Hand;
using falling_objects::SpaceView;

// Two bodies of one mesh in a space of their own.
class Space : public testing::Test {
 protected:
  Space() : mesh_(falling_objects::make_jack()) {
    dInitODE2(0);
    world_ = dWorldCreate();
    space_ = dSimpleSpaceCreate(nullptr);
    data_ = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildSingle(data_, mesh_.vertices.data(), 3 * sizeof(float),
                                static_cast<int>(mesh_.vertex_count()), mesh_.indices.data(),
                                static_cast<int>(mesh_.indices.size()), 3 * sizeof(unsigned));
    for (const double x : {-1.0, 1.0}) bodies_.push_back(add(x));
    for (int i = 0; i < 2; ++i) {  // the newest comes first
      falling_objects::set_index(dSpaceGetGeom(space_, i), static_cast<std::size_t>(1 - i));
    }
  }
  ~Space() override {
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
    dGeomTriMeshDataDestroy(data_);
    if (block_data_ != nullptr) dGeomTriMeshDataDestroy(block_data_);
    dCloseODE();
  }

  dBodyID add(double x) {
    dBodyID body = dBodyCreate(world_);
    dBodySetPosition(body, x, 0, 0);
    dGeomID geom = dCreateTriMesh(space_, data_, nullptr, nullptr, nullptr);
    dGeomSetCategoryBits(geom, falling_objects::kMeshBit);
    dGeomSetBody(geom, body);
    return body;
  }

  // Around the first body.
  void add_block() {
    block_ = falling_objects::make_box(1.6, 1.6, 1.6, 1);
    block_data_ = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildSingle(block_data_, block_.vertices.data(), 3 * sizeof(float),
                                static_cast<int>(block_.vertex_count()), block_.indices.data(),
                                static_cast<int>(block_.indices.size()), 3 * sizeof(unsigned));
    dGeomID geom = dCreateTriMesh(space_, block_data_, nullptr, nullptr, nullptr);
    dGeomSetCategoryBits(geom, falling_objects::kMeshBit);
    dGeomSetPosition(geom, -1, 0, 0);
    falling_objects::set_index(geom, 2);
  }

  falling_objects::TriangleMesh mesh_, block_;
  dTriMeshDataID block_data_ = nullptr;
  dWorldID world_;
  dSpaceID space_;
  dTriMeshDataID data_;
  std::vector<dBodyID> bodies_;
};

TEST_F(Space, IsSeenWithAllItsMeshes) {
  view::Studio studio({320, 240});
  SpaceView view(studio.renderer());
  const view::Frame frame = view.frame(space_, nullptr, {}, {});
  ASSERT_EQ(frame.objects.size(), 2U);
  EXPECT_TRUE(frame.grounds.empty());
  EXPECT_TRUE(frame.arrows.empty());
  view::Camera camera = falling_objects::overview(frame);
  camera.azimuth = -1.5708F;
  const view::Image image = studio.draw({&frame, 1}, camera);
  const auto is_bluish = [](const Pixel& p) { return p.blue > p.red + 50; };
  EXPECT_EQ(spots(image, is_red, 20), 1);
  EXPECT_EQ(spots(image, is_bluish, 20), 1);
  EXPECT_TRUE(is_near(image, is_red, camera, {-1, 0, 0}, 2));
  EXPECT_TRUE(is_near(image, is_bluish, camera, {1, 0, 0}, 2));
}

TEST_F(Space, ShowsContactsAsArrowsThatAreLongerTheDeeperTheyAre) {
  view::Studio studio({320, 240});
  SpaceView view(studio.renderer());
  std::vector<dContactGeom> contacts(2);
  for (std::size_t i = 0; i < 2; ++i) {
    contacts[i] = {};
    contacts[i].pos[2] = 0.2 * static_cast<double>(i);
    contacts[i].normal[2] = 1;
    contacts[i].depth = 0.005 + 0.002 * static_cast<double>(i);
    contacts[i].g1 = contacts[i].g2 = dSpaceGetGeom(space_, 0);
    contacts[i].side1 = contacts[i].side2 = -1;
  }
  const view::Frame frame = view.frame(space_, nullptr, contacts, {true, true, true});
  ASSERT_EQ(frame.arrows.size(), 2U);
  EXPECT_EQ(frame.boxes.size(), 2U);
  EXPECT_TRUE(frame.patches.empty());  // no contact says which triangle
  const auto length = [&](std::size_t i) {
    return glm::distance(frame.arrows[i].from, frame.arrows[i].to);
  };
  EXPECT_GT(length(1), length(0) + 0.05F);
  const view::Camera camera = falling_objects::overview(frame);
  const view::Image image = studio.draw({&frame, 1}, camera);
  const auto is_black = [](const Pixel& p) { return p.red + p.green + p.blue < 150; };
  for (const view::Arrow& arrow : frame.arrows) {
    EXPECT_TRUE(is_near(image, is_black, camera, glm::mix(arrow.from, arrow.to, 0.8F), 2));
  }
}

TEST_F(Space, ShowsAsGlassWhatSomethingIsInFromTheStart) {
  view::Studio studio({64, 64});
  SpaceView heap(studio.renderer()), view(studio.renderer());
  EXPECT_TRUE(heap.frame(space_, nullptr, {}, {}).glass.empty());
  add_block();
  EXPECT_TRUE(heap.frame(space_, nullptr, {}, {}).glass.empty());
  const view::Frame frame = view.frame(space_, nullptr, {}, {});
  EXPECT_EQ(frame.glass.size(), 1U);
  EXPECT_EQ(frame.objects.size(), 2U);
  dBodySetPosition(bodies_[0], -2, 0, 0);
  EXPECT_TRUE(view.frame(space_, nullptr, {}, {}).glass.empty());  // it left
}

TEST_F(Space, KeepsWhatMovesInTheLight) {
  view::Studio studio({64, 64});
  SpaceView view(studio.renderer());
  const auto is_lit = [&](const view::Frame& frame, dBodyID body) {
    const dReal* at = dBodyGetPosition(body);
    return glm::distance(frame.center, glm::vec3(glm::dvec3(at[0], at[1], at[2]))) < frame.radius;
  };
  const view::Frame first = view.frame(space_, nullptr, {}, {});
  dBodySetPosition(bodies_[0], -1.05, 0, 0);
  EXPECT_EQ(view.frame(space_, nullptr, {}, {}).radius, first.radius);
  dBodySetPosition(bodies_[0], -4, 0, 0);
  const view::Frame later = view.frame(space_, nullptr, {}, {});
  EXPECT_TRUE(is_lit(later, bodies_[0]));
  EXPECT_TRUE(is_lit(later, bodies_[1]));
  dBodySetPosition(bodies_[0], 0, 0, -1000);  // shadows of the rest would be as coarse
  EXPECT_EQ(view.frame(space_, nullptr, {}, {}).radius, later.radius);
}

TEST_F(Space, IsLitFromWhereTheCameraIs) {
  view::Studio studio({64, 64});
  SpaceView view(studio.renderer());
  for (const float azimuth : {0.0F, 2.0F, -2.0F}) {
    view::Camera camera;
    camera.azimuth = azimuth;
    view.light_from(camera);
    const view::Frame frame = view.frame(space_, nullptr, {}, {});
    EXPECT_NEAR(glm::length(frame.to_sun), 1, 1e-5);
    EXPECT_GT(glm::dot(frame.to_sun, glm::normalize(camera.eye())), 0.7F);
  }
}

TEST_F(Space, NamesTheTrianglesThatContactsTouch) {
  view::Studio studio({64, 64});
  SpaceView view(studio.renderer());
  dContactGeom contact{};
  contact.g1 = dSpaceGetGeom(space_, 0);
  contact.g2 = dSpaceGetGeom(space_, 1);
  contact.side1 = 3;
  contact.side2 = 1000000;  // there is none
  const view::Frame frame = view.frame(space_, nullptr, {&contact, 1}, {false, true, false});
  ASSERT_EQ(frame.patches.size(), 1U);
  EXPECT_EQ(frame.patches[0].corners.size(), 3U);
}

TEST_F(Space, HasBodiesThatAHandTakesPullsAndThrows) {
  Hand hand;
  EXPECT_FALSE(hand.take(space_, {0, 0, 5}, {0, 0, -1}));  // between the two
  ASSERT_TRUE(hand.take(space_, {1, 0, 5}, {0, 0, -1}));
  hand.move({3, 0, 5}, {0, 0, -1});
  for (int i = 0; i < 60; ++i) {
    hand.pull();
    dWorldQuickStep(world_, 1.0 / 60);
  }
  EXPECT_NEAR(dBodyGetPosition(bodies_[1])[0], 3, 0.3);
  EXPECT_EQ(dBodyGetPosition(bodies_[0])[0], -1);
  hand.move({9, 0, 5}, {0, 0, -1});
  for (int i = 0; i < 6; ++i) {
    hand.pull();
    dWorldQuickStep(world_, 1.0 / 60);
  }
  hand.release();
  EXPECT_FALSE(hand.holds());
  EXPECT_GT(dBodyGetLinearVel(bodies_[1])[0], 1);  // it flies on
}

TEST_F(Space, HasBodiesThatNoHandTakesWhileSomethingFixedIsInFront) {
  dBodySetKinematic(bodies_[1]);
  Hand hand;
  EXPECT_FALSE(hand.take(space_, {1, 0, 5}, {0, 0, -1}));
  EXPECT_TRUE(hand.take(space_, {-1, 0, 5}, {0, 0, -1}));
}

}  // namespace
}  // namespace view_tests
