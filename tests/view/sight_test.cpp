// SPDX-License-Identifier: BSD-3-Clause
#include "view/sight.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "view/camera.h"

namespace view_tests {
namespace {

TEST(Sight, SeesBallsOfWhichAPartIsInThePicture) {
  const view::Camera camera = view::looking_at(glm::vec3(0), 1);
  const view::Sight sight(camera.clip_from_world(1), {100, 100});
  EXPECT_TRUE(sight.sees(glm::vec3(0), 0.1F));
  EXPECT_FALSE(sight.sees(camera.eye() * 2.0F, 0.1F));  // behind
  const glm::vec3 aside = 3.0F * camera.right();
  EXPECT_FALSE(sight.sees(aside, 1));
  EXPECT_TRUE(sight.sees(aside, 2.5F));
  EXPECT_FALSE(sight.sees(-aside, 1));
}

TEST(Sight, MeasuresInPixelsWhereABallIsNearest) {
  const view::Camera camera = view::looking_at(glm::vec3(0), 1);
  const view::Sight sight(camera.clip_from_world(2), {200, 100});
  const float expected = 100 / camera.extent_at(glm::vec3(0));
  EXPECT_NEAR(sight.pixels_per_meter(glm::vec3(0), 0), expected, 0.01F * expected);
  EXPECT_NEAR(sight.pixels_per_meter(glm::vec3(0), camera.distance / 2), 2 * expected,
              0.02F * expected);
}

TEST(Sight, MeasuresTheSameEverywhereInAParallelProjection) {
  const view::Sight sight(glm::ortho(-4.0F, 4.0F, -4.0F, 4.0F, -10.0F, 10.0F), {80, 80});
  EXPECT_NEAR(sight.pixels_per_meter({0, 0, 0}, 1), 10, 0.01F);
  EXPECT_NEAR(sight.pixels_per_meter({3, 1, 5}, 2), 10, 0.01F);
}

}  // namespace
}  // namespace view_tests
