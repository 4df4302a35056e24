// SPDX-License-Identifier: BSD-3-Clause
#include "opencl/error.h"

#include <gtest/gtest.h>

namespace ode_ext {
namespace {

std::string message_of(int code, const std::string& device) {
  try {
    check(code, "clSomething", device);
  } catch (const DeviceError& error) {
    EXPECT_EQ(error.code(), code);
    return error.what();
  }
  return "";
}

TEST(Check, LetsSuccessPass) {
  EXPECT_NO_THROW(check(CL_SUCCESS, "clSomething", "a device"));
  EXPECT_NO_THROW(check(CL_SUCCESS, "clSomething", "a device", []() -> std::string {
    throw std::logic_error("put words together for a call that succeeded");
  }));
}

TEST(Check, NamesCallCodeAndDevice) {
  EXPECT_EQ(message_of(CL_INVALID_VALUE, "a device (driver 7)")
                .find("clSomething failed with CL_INVALID_VALUE (-30) on a device (driver 7). "),
            0u);
  EXPECT_EQ(message_of(CL_INVALID_VALUE, "").find(" on "), std::string::npos);
}

TEST(Check, SaysWhatToTry) {
  for (int code : {CL_OUT_OF_RESOURCES, CL_OUT_OF_HOST_MEMORY, CL_MEM_OBJECT_ALLOCATION_FAILURE}) {
    EXPECT_NE(message_of(code, "d").find("fewer contacts"), std::string::npos) << code;
    EXPECT_NE(message_of(code, "d").find("ODE_EXT_DEVICE"), std::string::npos) << code;
  }
  EXPECT_NE(message_of(-1001, "").find("pocl-opencl-icd"), std::string::npos);
  EXPECT_NE(message_of(CL_BUILD_PROGRAM_FAILURE, "d").find("driver"), std::string::npos);
}

TEST(Check, NamesCodesItDoesNotKnow) {
  EXPECT_NE(message_of(-9999, "d").find("(-9999)"), std::string::npos);
}

TEST(Check, AppendsTheDescription) {
  try {
    check(CL_INVALID_ARG_SIZE, "clSetKernelArg", "d", [] { return "Argument 3."; });
    FAIL() << "expected a DeviceError";
  } catch (const DeviceError& error) {
    EXPECT_EQ(error.code(), CL_INVALID_ARG_SIZE);
    EXPECT_TRUE(std::string(error.what()).ends_with(" Argument 3.")) << error.what();
  }
}

TEST(FaultInjector, FailsTheNthCheckedCallOnce) {
  fault_injector::arm(3, CL_OUT_OF_RESOURCES);
  EXPECT_NO_THROW(check(CL_SUCCESS, "first", ""));
  EXPECT_NO_THROW(check(CL_SUCCESS, "second", ""));
  EXPECT_THROW(check(CL_SUCCESS, "third", ""), DeviceError);
  EXPECT_NO_THROW(check(CL_SUCCESS, "fourth", ""));
  EXPECT_EQ(fault_injector::calls_checked(), 4);
  fault_injector::disarm();
  EXPECT_EQ(fault_injector::calls_checked(), 0);
  EXPECT_NO_THROW(check(CL_SUCCESS, "first", ""));
  EXPECT_EQ(fault_injector::calls_checked(), 1);
}

}  // namespace
}  // namespace ode_ext
