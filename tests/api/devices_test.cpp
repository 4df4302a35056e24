// SPDX-License-Identifier: BSD-3-Clause
// Choosing and describing devices.
#include <gmock/gmock.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <vector>

#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

using ::testing::HasSubstr;

constexpr const char* kNothing = "no platform of this name::";

std::string described(const char* selection = nullptr) {
  const int size = dBatchColliderDescribeDevices(selection, nullptr, 0);
  std::vector<char> text(static_cast<std::size_t>(size) + 1);
  EXPECT_EQ(dBatchColliderDescribeDevices(selection, text.data(), text.size()), size);
  return text.data();
}

std::string default_device() {
  OdeWorld world;
  return BatchCollider().stats().device;
}

TEST(ApiDescribeDevices, NamesTheDeviceThatACollideGets) {
  EXPECT_THAT(described(), HasSubstr(default_device()));
}

TEST(ApiDescribeDevices, ReturnsTheWholeLengthAndTerminatesWhatFits) {
  const std::string whole = described();
  ASSERT_GT(whole.size(), 8u);
  char text[8];
  std::fill_n(text, sizeof text, '#');
  EXPECT_EQ(dBatchColliderDescribeDevices(nullptr, text, 6), static_cast<int>(whole.size()));
  EXPECT_EQ(std::string(text), whole.substr(0, 5));
  EXPECT_EQ(text[6], '#');
}

TEST(ApiDescribeDevices, MarksNothingForASelectionThatMatchesNothing) {
  EXPECT_NE(described(kNothing), described());
  EXPECT_THAT(described(kNothing), HasSubstr(default_device()));  // still listed
}

TEST(ApiDevice, ThatMatchesNothingIsRefusedWithAListOfThoseThatExist) {
  const std::string existing = default_device();
  OdeWorld world;
  dBatchColliderParams params;
  dBatchColliderParamsInit(&params);
  params.device = kNothing;
  EXPECT_EQ(dBatchColliderCreate(&params), nullptr);
  EXPECT_THAT(last_error(), HasSubstr(existing));
  EXPECT_THAT(last_error(), HasSubstr(kNothing));
}

TEST(ApiDevice, OfTheEnvironmentThatMatchesNothingIsRefusedWithAList) {
  const std::string existing = default_device();
  OdeWorld world;
  const Environment environment("ODE_EXT_DEVICE", kNothing);
  EXPECT_EQ(dBatchColliderCreate(nullptr), nullptr);
  EXPECT_THAT(last_error(), HasSubstr(existing));
  EXPECT_THAT(last_error(), HasSubstr(kNothing));
}

TEST(ApiDevice, OfTheParametersGoesBeforeThatOfTheEnvironment) {
  OdeWorld world;
  const Environment environment("ODE_EXT_DEVICE", kNothing);
  const BatchCollider collider([](dBatchColliderParams& p) { p.device = "0"; });
  EXPECT_NE(collider.stats().device[0], '\0');
}

TEST(ApiDevice, IsFoundByAPartOfItsNameInEitherCase) {
  std::string part = "::" + default_device().substr(0, 5);
  for (char& c : part) c = static_cast<char>(std::toupper(c));
  OdeWorld world;
  const BatchCollider collider([&](dBatchColliderParams& p) { p.device = part.c_str(); });
  EXPECT_NE(collider.stats().device[0], '\0');
}

TEST(ApiDevice, IndexBeyondTheLastIsRefused) {
  OdeWorld world;
  dBatchColliderParams params;
  dBatchColliderParamsInit(&params);
  params.device = "9999";
  EXPECT_EQ(dBatchColliderCreate(&params), nullptr);
  EXPECT_NE(last_error(), "");
}

// The loader reads OCL_ICD_VENDORS once a process, so this runs in one of its own.
TEST(ApiDeviceDeathTest, NoPlatformAtAllIsAMessageAndNoCrash) {
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(
      {
        setenv("OCL_ICD_VENDORS", "/nonexistent", 1);
        OdeWorld world;
        const bool refused = dBatchColliderCreate(nullptr) == nullptr;
        std::fprintf(stderr, "[%s]\n", dBatchColliderGetLastErrorMessage());
        std::_Exit(refused && !last_error().empty() ? 0 : 1);
      },
      ::testing::ExitedWithCode(0), "OpenCL");
}

// A program whose Create failed goes on with the 0 it got.
TEST(ApiNullCollider, CollidesAsPlainOdeDoes) {
  OdeWorld world;
  for (const SpaceKind kind : kSpaceKinds) {
    const dSpaceID space = world.space(kind);
    const Pile pile(world, space, 6, 1);
    Collected plain, batch;
    dSpaceCollide(space, &plain, &collect);
    EXPECT_EQ(dBatchColliderSpaceCollide(nullptr, space, &batch, &collect), 1);
    ASSERT_GT(plain.order.size(), 0u);
    EXPECT_EQ(difference_with_geoms(plain, batch), "") << name_of(kind);
  }
}

TEST(ApiNullCollider, CollidesTwoSpacesAsPlainOdeDoes) {
  OdeWorld world;
  const dSpaceID s1 = world.space(SpaceKind::Hash), s2 = world.space(SpaceKind::Simple);
  const Pile p1(world, s1, 4, 1), p2(world, s2, 4, 2);
  Collected plain, batch;
  const auto g1 = reinterpret_cast<dGeomID>(s1), g2 = reinterpret_cast<dGeomID>(s2);
  dSpaceCollide2(g1, g2, &plain, &collect);
  EXPECT_EQ(dBatchColliderSpaceCollide2(nullptr, g1, g2, &batch, &collect), 1);
  ASSERT_GT(plain.order.size(), 0u);
  EXPECT_EQ(difference_with_geoms(plain, batch), "");
}

}  // namespace
}  // namespace ode_ext::test
