// SPDX-License-Identifier: BSD-3-Clause
#include "opencl/choice.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "opencl/error.h"
#include "support/environment.h"

namespace ode_ext {
namespace {

DeviceInfo make(int index, cl_device_type type, const char* platform, const char* name,
                cl_uint compute_units, const char* version = "OpenCL 1.2 test") {
  DeviceInfo info;
  info.index = index;
  info.type = type;
  info.platform_name = platform;
  info.name = name;
  info.version = version;
  info.compute_units = compute_units;
  return info;
}

const std::vector<DeviceInfo> kDevices = {
    make(0, CL_DEVICE_TYPE_CPU, "Portable Computing Language", "pthread-EPYC", 64),
    make(1, CL_DEVICE_TYPE_ACCELERATOR, "Acme", "FPGA: board 7", 1),
    make(2, CL_DEVICE_TYPE_GPU, "NVIDIA CUDA", "RTX small", 20),
    make(3, CL_DEVICE_TYPE_GPU, "NVIDIA CUDA", "RTX large", 80),
    make(4, CL_DEVICE_TYPE_GPU, "Museum", "Old card", 900, "OpenCL 1.1 museum"),
    make(5, CL_DEVICE_TYPE_GPU, "Acme", "RTX large", 80),
};

int chosen(const std::string& selection) {
  const Choice choice = choose_among(kDevices, selection);
  return choice.device ? choice.device->index : -1;
}

std::string reason(const std::string& selection) {
  return choose_among(kDevices, selection).reason;
}

TEST(Choice, PrefersGpuThenAcceleratorThenCpu) {
  EXPECT_EQ(chosen(""), 3);
  EXPECT_EQ(choose_among({kDevices[0], kDevices[1]}, "").device->index, 1);
  EXPECT_EQ(choose_among({kDevices[0]}, "").device->index, 0);
}

TEST(Choice, BreaksTiesByComputeUnitsThenByIndex) {
  EXPECT_EQ(chosen(":gpu:rtx"), 3);
  EXPECT_EQ(chosen("small"), 2);
}

TEST(Choice, TakesAPlainIntegerAsAnIndex) {
  EXPECT_EQ(chosen("0"), 0);
  EXPECT_EQ(chosen(" 2 "), 2);
}

TEST(Choice, MatchesPartsOfPlatformTypeAndNameWhateverTheirCase) {
  EXPECT_EQ(chosen("PORTABLE:Cpu:epyc"), 0);
  EXPECT_EQ(chosen("acme::rtx"), 5);
  EXPECT_EQ(chosen("acme"), 5);
  EXPECT_EQ(chosen("acme:accelerator"), 1);
  EXPECT_EQ(chosen(":cpu"), 0);
  EXPECT_EQ(chosen("::"), 3);
}

TEST(Choice, LeavesColonsAfterTheSecondToTheName) { EXPECT_EQ(chosen("::fpga: board"), 1); }

TEST(Choice, LooksInPlatformAndDeviceNamesWithoutAColon) {
  EXPECT_EQ(chosen("cuda"), 3);
  EXPECT_EQ(chosen("pthread"), 0);
}

TEST(Choice, ChoosesNothingForWhatMatchesNothing) {
  for (const char* selection : {"6", "-1", "99999999999999999999", "intel", "acme:cpu:", ":tpu:",
                                ":gp:", "nvidia:gpu:small:large", "0x1", "1 2"}) {
    EXPECT_EQ(chosen(selection), -1) << selection;
    EXPECT_NE(reason(selection).find("\"" + std::string(selection) + "\""), std::string::npos);
    EXPECT_NE(reason(selection).find("platform:type:name"), std::string::npos);
  }
}

TEST(Choice, ChoosesNothingFromNothing) {
  EXPECT_EQ(choose_among({}, "").device, nullptr);
  EXPECT_EQ(choose_among({}, "0").device, nullptr);
}

TEST(Choice, SaysWhyADeviceThatWasAskedForCannotBeUsed) {
  EXPECT_EQ(chosen("museum"), -1);
  EXPECT_NE(reason("museum").find("OpenCL 1.2 is needed"), std::string::npos) << reason("museum");
}

TEST(Choice, SaysWhatMakesADeviceUnusable) {
  DeviceInfo device = kDevices[0];
  EXPECT_EQ(why_unusable(device), "");
  for (const char* version : {"OpenCL 1.2 x", "OpenCL 2.0", "OpenCL 3.0 PoCL", "OpenCL 10.0"}) {
    device.version = version;
    EXPECT_EQ(why_unusable(device), "") << version;
  }
  for (const char* version : {"OpenCL 1.1 x", "OpenCL 0.9", "", "CUDA 12"}) {
    device.version = version;
    EXPECT_NE(why_unusable(device), "") << version;
  }
  device = kDevices[0];
  device.little_endian = false;
  EXPECT_NE(why_unusable(device).find("little-endian"), std::string::npos);
  device = kDevices[0];
  device.has_compiler = false;
  EXPECT_NE(why_unusable(device).find("compiler"), std::string::npos);
  device = kDevices[0];
  device.available = false;
  EXPECT_NE(why_unusable(device).find("not available"), std::string::npos);
}

TEST(Choice, TellsWhetherTheEnvironmentChose) {
  {
    const test::Environment environment("ODE_EXT_DEVICE", "pthread");
    EXPECT_EQ(reason("pthread"), "ODE_EXT_DEVICE=\"pthread\"");
    EXPECT_EQ(reason("0"), "the program's selection \"0\"");
  }
  const test::Environment none("ODE_EXT_DEVICE", nullptr);
  EXPECT_EQ(reason("pthread"), "the program's selection \"pthread\"");
  EXPECT_EQ(reason(""), "the default order GPU, accelerator, CPU");
}

TEST(Choice, ListsOneDeviceALineAndMarksTheChosen) {
  const std::string lines = device_lines(kDevices, &kDevices[2]);
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 6);
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '*'), 1);
  EXPECT_NE(lines.find("\n* 2  gpu  RTX small  (NVIDIA CUDA)"), std::string::npos) << lines;
  EXPECT_NE(lines.find("unusable: it offers"), std::string::npos) << lines;
}

TEST(Devices, AreNumberedAsChooseDeviceTakesThem) {
  const std::vector<DeviceInfo> devices = list_devices();
  ASSERT_FALSE(devices.empty()) << "no OpenCL device: install pocl-opencl-icd";
  for (std::size_t i = 0; i < devices.size(); ++i) {
    EXPECT_EQ(devices[i].index, static_cast<int>(i));
    EXPECT_EQ(choose_device(std::to_string(i)).id, devices[i].id);
    EXPECT_FALSE(devices[i].name.empty());
    EXPECT_GT(devices[i].largest_buffer, 0u);
    EXPECT_GT(devices[i].work_group_limit, 0u);
  }
}

TEST(Devices, AreListedInTheErrorWhenNothingMatches) {
  try {
    choose_device("no such device");
    FAIL() << "expected a DeviceError";
  } catch (const DeviceError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("no such device"), std::string::npos) << message;
    EXPECT_NE(message.find(list_devices().at(0).name), std::string::npos) << message;
  }
}

TEST(Devices, AreDescribedWithTheChosenOneMarked) {
  const std::string text = describe_devices("");
  EXPECT_NE(text.find("* chosen by the default order"), std::string::npos) << text;
  EXPECT_NE(text.find(choose_device("").driver), std::string::npos) << text;
  const std::string refusal = describe_devices("no such device");
  EXPECT_NE(refusal.find("no OpenCL device matches \"no such device\""), std::string::npos);
  EXPECT_NE(refusal.find(list_devices().at(0).name), std::string::npos) << refusal;
  EXPECT_EQ(refusal.find('*'), std::string::npos) << refusal;
}

TEST(Devices, AreDescribedEvenWhenOpenClFails) {
  fault_injector::arm(1, CL_OUT_OF_HOST_MEMORY);
  const std::string text = describe_devices("");
  fault_injector::disarm();
  EXPECT_NE(text.find("clGetPlatformIDs failed with CL_OUT_OF_HOST_MEMORY (-6)"), std::string::npos)
      << text;
}

TEST(Devices, OfAPlatformThatFailsAreLeftOutAndTheFailureIsTold) {
  fault_injector::arm(3, CL_OUT_OF_RESOURCES);  // after the two clGetPlatformIDs: clGetDeviceIDs
  const std::size_t left = list_devices().size();
  fault_injector::arm(3, CL_OUT_OF_RESOURCES);
  const std::string text = describe_devices("");
  fault_injector::disarm();
  EXPECT_LT(left, list_devices().size());
  EXPECT_NE(text.find("Platform 0 was left out: clGetDeviceIDs failed"), std::string::npos) << text;
}

// A fresh process (the "threadsafe" style runs this program again), since the loader reads the list
// of platforms once.
TEST(DevicesDeathTest, AreNoneWithoutAPlatformAndTheMessageSaysWhatToInstall) {
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto try_without_platforms = [] {
    char folder[] = "/tmp/no_platforms_XXXXXX";
    if (!::mkdtemp(folder)) std::exit(2);
    ::setenv("OCL_ICD_VENDORS", folder, 1);
    const bool empty = list_devices().empty();
    const std::string text = describe_devices("");
    ::rmdir(folder);
    try {
      Device device("");
    } catch (const DeviceError& error) {
      std::fprintf(stderr, "%s%s", error.what(), text.c_str());
      std::exit(empty && error.code() != 0 ? 0 : 3);
    }
    std::exit(4);
  };
  EXPECT_EXIT(try_without_platforms(), ::testing::ExitedWithCode(0),
              "no OpenCL platform. Install pocl-opencl-icd.*no OpenCL platform. Install");
}

// PoCL shows no device then. (A path below a file stops root too.)
TEST(DevicesDeathTest, WhereTheCacheOfPoclCannotBeMadeTheMessageSaysSo) {
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto try_without_cache = [] {
    ::setenv("POCL_CACHE_DIR", "/dev/null/cache", 1);
    try {
      Device device("Portable Computing Language");
    } catch (const DeviceError& error) {
      const std::string text = error.what() + describe_devices("Portable Computing Language");
      std::fputs(text.c_str(), stderr);
      std::exit(text.find("nstall pocl") == std::string::npos ? 0 : 3);
    }
    std::exit(4);
  };
  EXPECT_EXIT(try_without_cache(), ::testing::ExitedWithCode(0),
              "POCL_CACHE_DIR .now '/dev/null/cache'.*POCL_CACHE_DIR .now '/dev/null/cache'");
}

TEST(PlatformAdvice, IsForPoclAlone) {
  EXPECT_NE(platform_advice("Portable Computing Language").find("POCL_CACHE_DIR"),
            std::string::npos);
  EXPECT_EQ(platform_advice("NVIDIA CUDA"), "");
}

// There may be several of one name, and names that are part of others.
TEST(Choice, OfADeviceThatIsThereChoosesItAgain) {
  std::vector<DeviceInfo> twins = kDevices;
  twins.push_back(make(6, CL_DEVICE_TYPE_GPU, "NVIDIA CUDA", "RTX large", 80));
  twins.push_back(make(7, CL_DEVICE_TYPE_GPU, "NVIDIA CUDA", "RTX large plus", 90));
  for (const DeviceInfo& device : twins)
    EXPECT_EQ(choose_among({device}, selection_of(device, {})).device != nullptr,
              why_unusable(device).empty());
  for (const DeviceInfo& device : twins) {
    if (!why_unusable(device).empty()) continue;
    const Choice choice = choose_among(twins, selection_of(device, twins));
    ASSERT_NE(choice.device, nullptr) << device.index;
    EXPECT_EQ(choice.device->index, device.index);
  }
}

TEST(Choice, OfADeviceWhoseNumberIsAnothersGoesByItsNames) {
  std::vector<DeviceInfo> others = kDevices;
  std::swap(others[2], others[3]);
  std::swap(others[2].index, others[3].index);
  const Choice choice = choose_among(others, selection_of(kDevices[2], others));
  ASSERT_NE(choice.device, nullptr);
  EXPECT_EQ(choice.device->name, kDevices[2].name);
}

}  // namespace
}  // namespace ode_ext
