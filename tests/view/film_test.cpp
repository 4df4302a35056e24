// SPDX-License-Identifier: BSD-3-Clause
#include "view/film.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "support/temporary_folder.h"
#include "view/camera.h"

namespace view_tests {
namespace {

using ode_ext::TemporaryFolder;
using testing::HasSubstr;

view::Image grey(view::Size size) {
  return {size, std::vector<std::uint8_t>(static_cast<std::size_t>(3) *
                                              static_cast<std::size_t>(size.width) *
                                              static_cast<std::size_t>(size.height),
                                          128)};
}

template <class Call>
std::string error_of(Call call) {
  try {
    call();
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

TEST(Film, NumbersPicturesWhereTheirNameSaysSo) {
  EXPECT_EQ(view::numbered("a/%04d.png", 12), "a/0012.png");
  EXPECT_EQ(view::numbered("a%d.png", 12), "a12.png");
  EXPECT_EQ(view::numbered("a.png", 12), "a.png");
  for (const char* bad : {"%s.png", "%04d%d.png", "%", "100%.png", "%9999d.png"}) {
    EXPECT_THAT(error_of([&] { view::numbered(bad, 1); }), HasSubstr("%04d")) << bad;
  }
}

TEST(Film, WritesAllPicturesOrThatOfTheEnd) {
  const TemporaryFolder folder("film_test");
  const std::string out = folder / "made";
  view::Film all(out + "/%02d.png", "", {32, 32}, 30);
  EXPECT_TRUE(all.wants_all());
  EXPECT_FALSE(all.wants_end());
  for (int i = 0; i < 2; ++i) all.add(grey({32, 32}));
  all.finish();
  view::Film end(out + "/last.png", "", {32, 32}, 30);
  EXPECT_FALSE(end.wants_all());
  EXPECT_TRUE(end.wants_end());
  end.add_end(grey({32, 32}));
  end.finish();
  for (const char* name : {"/00.png", "/01.png", "/last.png"}) {
    EXPECT_TRUE(std::filesystem::exists(out + name)) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(out + "/02.png"));
}

TEST(Film, MakesAFilm) {
  const TemporaryFolder folder("film_test");
  const std::string out = folder / "made/a.mp4";
  view::Film film("", out, {64, 64}, 30);
  for (int i = 0; i < 5; ++i) film.add(grey({64, 64}));
  film.finish();
  EXPECT_GT(std::filesystem::file_size(out), 500U);
}

TEST(Film, SaysWhyItCannotBeMade) {
  const TemporaryFolder folder("film_test");
  EXPECT_THAT(error_of([] { write_png("/nowhere/a.png", grey({8, 8})); }), HasSubstr("/nowhere"));
  EXPECT_THAT(error_of([] { write_png("/dev/full", grey({8, 8})); }), HasSubstr("/dev/full"));
  testing::internal::CaptureStderr();
  const std::string bad = error_of([&] {
    view::Film film("", folder / "a.nonsense", {64, 64}, 30);
    for (int i = 0; i < 100; ++i) film.add(grey({64, 64}));
    film.finish();
  });
  testing::internal::GetCapturedStderr();
  EXPECT_THAT(bad, HasSubstr("a.nonsense"));
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  const std::string missing = error_of([] { view::Film film("", "a.mp4", {64, 64}, 30); });
  setenv("PATH", path.c_str(), 1);
  EXPECT_THAT(missing, HasSubstr("install ffmpeg"));
}

TEST(Camera, IsReadFromText) {
  const view::Camera start = view::looking_at(glm::vec3(1, 2, 3), 5);
  const auto placed = view::parse_camera("4,2,7:1,2,3", start);
  ASSERT_TRUE(placed);
  EXPECT_LT(glm::distance(placed->eye(), glm::vec3(4, 2, 7)), 1e-4F);
  EXPECT_EQ(placed->target, glm::vec3(1, 2, 3));
  const auto turned = view::parse_camera("90,30,10", start);
  ASSERT_TRUE(turned);
  EXPECT_EQ(turned->target, start.target);
  EXPECT_NEAR(turned->eye().z, 3 + 10 * 0.5, 1e-4);
  EXPECT_NEAR(turned->eye().x, 1, 1e-4);
  EXPECT_EQ(view::parse_camera("90,30", start)->distance, start.distance);
  for (const char* bad : {"", "1", "1,2,3,4", "1,2,3:4,5", "a,b", "1,2,", "1,2,-3", "1;2", "0,nan",
                          "1,2,3:1,2,3", "1,2x"}) {
    EXPECT_FALSE(view::parse_camera(bad, start)) << bad;
  }
}

TEST(Camera, LooksThroughAPlaceOfThePictureToWhereItIsSeen) {
  view::Camera camera = view::looking_at(glm::vec3(1, 2, 3), 5);
  for (const float aspect : {0.5F, 1.8F}) {
    const glm::vec3 there = camera.eye() + 7.0F * camera.ray({0.3F, -0.6F}, aspect);
    const glm::vec4 clip = camera.clip_from_world(aspect) * glm::vec4(there, 1);
    EXPECT_NEAR(clip.x / clip.w, 0.3F, 1e-4F);
    EXPECT_NEAR(clip.y / clip.w, -0.6F, 1e-4F);
  }
}

}  // namespace
}  // namespace view_tests
