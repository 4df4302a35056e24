// SPDX-License-Identifier: BSD-3-Clause
// Pictures of what is known to be there.
#include <gtest/gtest.h>

#include "view/spots.h"
#include "view/studio.h"

namespace view_tests {
namespace {

constexpr view::Color kRed{1, 0, 0}, kGreen{0, 1, 0}, kBlue{0, 0, 1}, kGrey{0.7F, 0.7F, 0.7F},
    kYellow{1, 0.85F, 0.1F};

view::Pose at(float x, float y, float z, float size = 1) {
  return view::Pose(glm::vec3(size, 0, 0), glm::vec3(0, size, 0), glm::vec3(0, 0, size),
                    glm::vec3(x, y, z));
}

// From -0.5 to 0.5.
view::MeshId add_cube(view::Renderer& renderer) {
  std::vector<glm::vec3> corners;
  for (unsigned i = 0; i < 8; ++i) {
    corners.emplace_back((i & 1U) != 0 ? 0.5F : -0.5F, (i & 2U) != 0 ? 0.5F : -0.5F,
                         (i & 4U) != 0 ? 0.5F : -0.5F);
  }
  const std::vector<unsigned> triangles{0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                        2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  return renderer.add_mesh(corners, triangles, true);
}

view::Camera from_above(float distance) {
  view::Camera camera;
  camera.distance = distance;
  camera.azimuth = -1.5708F;  // x to the right
  camera.turn(0, 2);          // as steep as it goes
  return camera;
}

view::Image draw(view::Studio& studio, const view::Frame& frame, const view::Camera& camera) {
  return studio.draw({&frame, 1}, camera);
}

TEST(Renderer, ShowsEachObjectInItsColor) {
  view::Studio studio({320, 240});
  const view::MeshId cube = add_cube(studio.renderer());
  view::Frame frame;
  frame.radius = 5;
  for (const float x : {-3.0F, -1.0F, 1.0F, 3.0F}) {
    frame.objects.push_back({cube, at(x, 1.5F, 0), kRed});
  }
  for (const float x : {-2.0F, 0.0F, 2.0F}) {
    frame.objects.push_back({cube, at(x, 0, 0), kGreen});
  }
  frame.objects.push_back({cube, at(0, -1.5F, 0), kBlue});
  const view::Camera camera = from_above(16);
  const view::Image image = draw(studio, frame, camera);
  EXPECT_EQ(spots(image, is_red), 4);
  EXPECT_EQ(spots(image, is_green), 3);
  EXPECT_EQ(spots(image, is_blue), 1);
  for (const view::Instance& object : frame.objects) {
    const Mask mask = object.color == kRed ? is_red : object.color == kGreen ? is_green : is_blue;
    EXPECT_TRUE(is_near(image, mask, camera, object.pose[3], 1));
  }
}

TEST(Renderer, ShowsTenThousandObjects) {
  view::Studio studio({1000, 1000});
  const view::MeshId cube = add_cube(studio.renderer());
  view::Frame frame;
  frame.radius = 80;
  for (int i = 0; i < 10000; ++i) {
    const auto x = static_cast<float>(i % 100) - 49.5F, y = static_cast<float>(i / 100) - 49.5F;
    frame.objects.push_back({cube, at(x, y, 0, 0.5F), kRed});
  }
  EXPECT_EQ(spots(draw(studio, frame, from_above(180)), is_red, 2), 10000);
}

TEST(Renderer, LeavesNothingBlack) {
  view::Studio studio({320, 240});
  const view::MeshId cube = add_cube(studio.renderer());
  view::Frame frame;
  frame.radius = 4;
  frame.grounds.push_back({cube, at(0, 0, -4, 7), kGrey});
  frame.objects.push_back({cube, at(0, 0, 0), kGrey});
  const view::Image image = draw(studio, frame, view::looking_at(glm::vec3(0), 3));
  EXPECT_EQ(area(image, [](const Pixel& p) { return p.red + p.green + p.blue < 90; }), 0);
}

TEST(Renderer, DarkensWhereAShadowFalls) {
  view::Studio studio({320, 240});
  const view::MeshId cube = add_cube(studio.renderer());
  const auto is_dark = [](const Pixel& p) { return p.red + p.green + p.blue < 420; };
  view::Frame frame;
  frame.radius = 4;
  frame.grounds.push_back({cube, at(0, 0, -10, 20), kGrey});
  const view::Camera camera = from_above(10);
  EXPECT_EQ(area(draw(studio, frame, camera), is_dark), 0);
  frame.objects.push_back({cube, at(0, 0, 2), kRed});
  const view::Image image = draw(studio, frame, camera);
  EXPECT_GT(area(image, [&](const Pixel& p) { return is_dark(p) && !is_red(p); }), 300);
}

TEST(Renderer, ShowsTheEdgesOfBoxesAndTouchedTriangles) {
  view::Studio studio({320, 240});
  view::Frame frame;
  const view::Camera camera = view::looking_at(glm::vec3(0), 2);
  frame.boxes.push_back({glm::vec3(-1), glm::vec3(1), kRed});
  frame.patches.push_back({{{-0.5F, 0, 0}, {0.5F, 0, 0}, {0, 0, 0.5F}}, kYellow});
  const view::Image image = draw(studio, frame, camera);
  EXPECT_GT(area(image, is_red), 200);
  for (const float x : {-1.0F, 1.0F}) {
    for (const float z : {-1.0F, 1.0F}) {
      EXPECT_TRUE(is_near(image, is_red, camera, {x, -1, z}, 2));
      EXPECT_TRUE(is_near(image, is_red, camera, {x, 1, z}, 2));
    }
  }
  const auto is_yellow = [](const Pixel& p) { return p.red > 200 && p.green > 180 && p.blue < 80; };
  EXPECT_TRUE(is_near(image, is_yellow, camera, {0, 0, 0.2F}, 1));
}

TEST(Renderer, ShowsArrowsThroughWhatIsInFrontOfThemFainter) {
  view::Studio studio({320, 240});
  const view::MeshId cube = add_cube(studio.renderer());
  view::Frame frame;
  const view::Camera camera = view::looking_at(glm::vec3(0), 2);
  frame.arrows.push_back({{0, 0, -0.5F}, {0, 0, 0.5F}, kRed});
  const auto is_pure = [](const Pixel& p) { return p.red > 120 && p.green < 60; };
  EXPECT_GT(area(draw(studio, frame, camera), is_pure), 10);
  frame.objects.push_back({cube, at(0, 0, 0, 1.5F), kGrey});
  const view::Image hidden = draw(studio, frame, camera);
  EXPECT_EQ(area(hidden, is_pure), 0);
  const auto is_reddish = [](const Pixel& p) { return p.red > p.green + 30; };
  EXPECT_TRUE(is_near(hidden, is_reddish, camera, {0, 0, 0}, 3));
}

TEST(Renderer, ShowsPatchesAndObjectsThroughWhatIsInFrontOfThemFainterIfAsked) {
  view::Studio studio({320, 240});
  const view::MeshId cube = add_cube(studio.renderer());
  const view::Camera camera = view::looking_at(glm::vec3(0), 2);
  const auto is_reddish = [](const Pixel& p) { return p.red > p.green + 30; };
  const auto is_bluish = [](const Pixel& p) { return p.blue > p.green + 30; };
  const auto is_pure = [](const Pixel& p) { return p.red > 150 && p.green < 30; };
  for (const bool through : {false, true}) {
    view::Frame frame;
    frame.objects.push_back({cube, at(0, 0, 0, 1.5F), kGrey});
    const view::Instance inner{cube, at(0, 0, 0.3F, 0.3F), kBlue};
    frame.objects.push_back(inner);
    if (through) frame.shown_through.push_back(inner);
    frame.patches.push_back({{{-0.3F, 0, -0.5F}, {0.3F, 0, -0.5F}, {0, 0, -0.1F}}, kRed, through});
    const view::Image image = draw(studio, frame, camera);
    EXPECT_EQ(is_near(image, is_reddish, camera, {0, 0, -0.4F}, 2), through);
    EXPECT_EQ(is_near(image, is_bluish, camera, {0, 0, 0.3F}, 2), through);
    EXPECT_EQ(area(image, is_pure), 0);
  }
}

// From (-1, -1, 0) to (1, 1, 0), seen from above.
view::MeshId add_square(view::Renderer& renderer) {
  const std::vector<glm::vec3> corners{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  return renderer.add_mesh(corners, std::vector<unsigned>{0, 1, 2, 0, 2, 3}, true);
}

TEST(Renderer, ShowsWhatIsBehindAGroundThatIsSeenFromBelow) {
  view::Studio studio({320, 240});
  const view::MeshId square = add_square(studio.renderer()), cube = add_cube(studio.renderer());
  view::Frame frame;
  frame.objects.push_back({cube, at(0, 0, 1), kRed});
  view::Camera camera = view::looking_at(glm::vec3(0), 2);
  const auto is_reddish = [](const Pixel& p) { return p.red > p.green + 30; };
  for (const float side : {1.0F, -1.0F}) {
    camera.elevation = side * glm::radians(60.0F);
    frame.grounds.clear();
    const int alone = area(draw(studio, frame, camera), is_reddish);
    frame.grounds.push_back({square, at(0, 0, 0), kBlue});
    const view::Image image = draw(studio, frame, camera);
    EXPECT_GT(area(image, is_reddish), alone / 2);
    EXPECT_GT(area(image, [](const Pixel& p) { return p.blue > p.green + 20; }), 1000);
  }
}

TEST(Renderer, ShowsWhatIsInGlass) {
  view::Studio studio({320, 240});
  const view::MeshId cube = add_cube(studio.renderer());
  const view::Camera camera = view::looking_at(glm::vec3(0), 2);
  const auto is_reddish = [](const Pixel& p) { return p.red > p.green + 30; };
  view::Frame frame;
  frame.objects.push_back({cube, at(0, 0, 0, 0.5F), kRed});
  frame.objects.push_back({cube, at(0, 0, 0), kGrey});
  EXPECT_EQ(area(draw(studio, frame, camera), is_reddish), 0);
  frame.glass.push_back(frame.objects.back());
  frame.objects.pop_back();
  const view::Image image = draw(studio, frame, camera);
  EXPECT_TRUE(is_near(image, is_reddish, camera, {0, 0, 0}, 1));
  EXPECT_EQ(area(image, [](const Pixel& p) { return p.red > 100 && p.green < 15; }), 0);
}

TEST(Renderer, LeavesOutWhatIsOutOfSightButNotItsShadow) {
  view::Studio studio({320, 240});
  const view::MeshId cube = add_cube(studio.renderer());
  const auto is_dark = [](const Pixel& p) { return p.red + p.green + p.blue < 420; };
  view::Frame frame;
  frame.radius = 20;
  frame.grounds.push_back({cube, at(0, 0, -10, 20), kGrey});
  const view::Camera camera = from_above(5);
  EXPECT_EQ(area(draw(studio, frame, camera), is_dark), 0);
  frame.objects.push_back({cube, at(0, 0, 9, 3), kRed});  // behind the eye
  frame.to_sun = glm::normalize(glm::vec3(0.1F, 0, 1));
  const view::Image image = draw(studio, frame, camera);
  EXPECT_EQ(area(image, is_red), 0);
  EXPECT_GT(area(image, is_dark), 1000);
}

TEST(Renderer, ShowsClothsFromBothSides) {
  view::Studio studio({320, 240});
  view::Frame frame;
  frame.cloths.push_back(
      {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {0, 1, 2, 0, 2, 3}, kGreen});
  view::Camera camera = view::looking_at(glm::vec3(0), 2);
  EXPECT_GT(area(draw(studio, frame, camera), is_green), 1000);
  camera.elevation = -camera.elevation;
  EXPECT_GT(area(draw(studio, frame, camera), is_green), 1000);
}

TEST(Camera, GoesBackUntilAllIsSeenAndStaysWhereItIs) {
  const view::Camera start = view::looking_at(glm::vec3(0), 1);
  const std::vector<glm::vec3> near{{0, 0, 0}, {0.3F, 0, 0}}, far{{-3, 0, 0}, {3, 0, 0}};
  EXPECT_EQ(view::seeing(start, near, 1).distance, start.distance);
  const auto x_of = [&](const view::Camera& camera, float aspect) {
    const glm::vec4 clip = camera.clip_from_world(aspect) * glm::vec4(far[1], 1);
    return std::abs(clip.x) / clip.w;
  };
  for (const float aspect : {0.5F, 1.0F, 2.0F}) {
    const view::Camera camera = view::seeing(start, far, aspect);
    EXPECT_GT(x_of(start, aspect), 1);
    EXPECT_LT(x_of(camera, aspect), 1);
    EXPECT_GT(x_of(camera, aspect), 0.6F);
    EXPECT_EQ(camera.target, start.target);
  }
}

TEST(Studio, DrawsWorldsSideBySideWithTheirCaptions) {
  view::Studio studio({640, 240});
  const view::MeshId cube = add_cube(studio.renderer());
  std::vector<view::Frame> frames(2);
  frames[0].objects.push_back({cube, at(0, 0, 0), kRed});
  frames[1].objects.push_back({cube, at(0, 0, 0), kBlue});
  frames[1].caption = {"a title", "and a line"};
  const view::Image image = studio.draw(frames, view::looking_at(glm::vec3(0), 1));
  const auto half = [&](int from, const Mask& mask) {
    int count = 0;
    for (int y = 0; y < 240; ++y) {
      for (int x = from; x < from + 320; ++x) count += mask(pixel(image, x, y));
    }
    return count;
  };
  EXPECT_GT(half(0, is_red), 1000);
  EXPECT_EQ(half(320, is_red), 0);
  EXPECT_GT(half(320, is_blue), 1000);
  EXPECT_EQ(half(0, is_blue), 0);
  const auto is_dark = [](const Pixel& p) {
    return p.red < 120 && p.green < 120 && p.blue < 120 && !is_red(p) && !is_blue(p);
  };
  EXPECT_GT(half(320, is_dark), 1000);  // behind the text
  EXPECT_EQ(half(0, is_dark), 0);
}

}  // namespace
}  // namespace view_tests
