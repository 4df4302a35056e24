// SPDX-License-Identifier: BSD-3-Clause
// What a program learns of the OpenCL devices.
#include <gmock/gmock.h>

#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

using ::testing::HasSubstr;

TEST(ApiDevices, AreListedWithAllThatIsKnownOfThem) {
  const int count = dBatchDeviceCount();
  ASSERT_GT(count, 0) << last_error();
  for (int device = 0; device < count; ++device) {
    for (const int property : {dBatchDevicePlatform, dBatchDeviceName, dBatchDeviceVersion}) {
      const char* text = dBatchDeviceGetText(device, property);
      ASSERT_NE(text, nullptr) << last_error();
      EXPECT_STRNE(text, "") << property;
    }
    for (const int property : {dBatchDeviceVendor, dBatchDeviceDriver, dBatchDeviceProblem})
      EXPECT_NE(dBatchDeviceGetText(device, property), nullptr) << property;
    EXPECT_THAT((std::vector<std::string>{"gpu", "accelerator", "cpu", "other"}),
                ::testing::Contains(dBatchDeviceGetText(device, dBatchDeviceType)));
    EXPECT_GT(dBatchDeviceGetNumber(device, dBatchDeviceComputeUnits), 0);
    EXPECT_GT(dBatchDeviceGetNumber(device, dBatchDeviceMemory), 0);
    EXPECT_GT(dBatchDeviceGetNumber(device, dBatchDeviceLargestBuffer), 0);
  }
}

TEST(ApiDevices, ThatIsChosenIsTheOneACollidersNameIsOf) {
  OdeWorld world;
  const BatchCollider collider;
  ASSERT_GT(dBatchDeviceCount(), 0);
  const int chosen = dBatchDeviceChoose(nullptr);
  ASSERT_GE(chosen, 0) << last_error();
  EXPECT_STREQ(dBatchDeviceGetText(chosen, dBatchDeviceProblem), "");
  EXPECT_THAT(dBatchColliderGetDeviceName(collider),
              HasSubstr(dBatchDeviceGetText(chosen, dBatchDeviceName)));
  EXPECT_EQ(dBatchDeviceChoose(std::to_string(chosen).c_str()), chosen);
}

TEST(ApiDevices, ThatDoNotExistAreRefusedWithASentence) {
  const int count = dBatchDeviceCount();
  for (const int device : {-1, count, 1 << 30}) {
    EXPECT_EQ(dBatchDeviceGetText(device, dBatchDeviceName), nullptr);
    EXPECT_THAT(last_error(), HasSubstr("there is no device " + std::to_string(device)));
    EXPECT_EQ(dBatchDeviceGetNumber(device, dBatchDeviceMemory), -1);
  }
  EXPECT_EQ(dBatchDeviceGetText(0, dBatchDeviceMemory), nullptr);
  EXPECT_THAT(last_error(), HasSubstr("a device has no text"));
  EXPECT_EQ(dBatchDeviceGetNumber(0, dBatchDeviceName), -1);
  EXPECT_THAT(last_error(), HasSubstr("a device has no number"));
  EXPECT_EQ(dBatchDeviceChoose("no such device"), -1);
  EXPECT_THAT(last_error(), HasSubstr("no OpenCL device matches"));
}

}  // namespace
}  // namespace ode_ext::test
