// SPDX-License-Identifier: BSD-3-Clause
#include "opencl/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>
#include <vector>

#include "opencl/embedded_kernels.h"
#include "opencl/error.h"

namespace ode_ext {
namespace {

const std::filesystem::path kKernels =
    std::filesystem::path(__FILE__).parent_path() / ".." / ".." / "kernels";

constexpr const char* kSource = R"(
typedef struct { float scale; uint bias; } Parameters;
__kernel void transform(__global const uint* in, __global uint* out, Parameters p, uint count) {
  const uint i = (uint)get_global_id(0);
  if (i < count) out[i] = (uint)((float)in[i] * p.scale) + p.bias;
}
__kernel void local_sizes(__global uint* out) { out[get_global_id(0)] = (uint)get_local_size(0); }
)";

struct Parameters {
  float scale;
  std::uint32_t bias;
};

std::string error_of(auto&& action) {
  try {
    action();
  } catch (const DeviceError& error) {
    return error.what();
  }
  ADD_FAILURE() << "expected a DeviceError";
  return "";
}

TEST(EmbeddedKernels, AreTheBytesOfTheFiles) {
  ASSERT_GT(kEmbeddedKernelCount, 0u);
  for (std::size_t i = 0; i < kEmbeddedKernelCount; ++i) {
    const EmbeddedKernel& file = kEmbeddedKernels[i];
    std::ifstream stream(kKernels / file.name, std::ios::binary);
    ASSERT_TRUE(stream) << file.name;
    const std::string on_disk{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(file.text), file.size), on_disk)
        << file.name;
  }
}

// The paper's, and all kernels, which are of one of two programs where lanes are groups, with what
// only some of them are made of.
bool is_left_out_somewhere(const std::string& name) {
  return name.starts_with("paper/") || name.ends_with(".cl") || name == "lib/intersect.h" ||
         name == "lib/cross.h";
}

TEST(EmbeddedSource, KeepsEveryLineInItsPlaceAndLeavesOutIncludes) {
  const std::string source = embedded_source();
  EXPECT_EQ(source.find("\n#include \""), std::string::npos);
  std::size_t lines = 0;
  for (std::size_t i = 0; i < kEmbeddedKernelCount; ++i) {
    const EmbeddedKernel& file = kEmbeddedKernels[i];
    EXPECT_NE(source.find("#line 1 \"" + std::string(file.name) + "\"\n"), std::string::npos);
    lines += 1 + static_cast<std::size_t>(std::count(file.text, file.text + file.size, '\n'));
    if (file.text[file.size - 1] != '\n') ++lines;
    if (is_left_out_somewhere(file.name)) lines += 2;  // the condition around it
  }
  EXPECT_EQ(static_cast<std::size_t>(std::count(source.begin(), source.end(), '\n')), lines);
}

TEST(Program, BuildsTheEmbeddedKernels) {
  Device device("");
  EXPECT_NO_THROW(Program(device, ""));
}

TEST(Program, HasThePapersKernelsOnlyWhereAskedFor) {
  Device device("");
  Program product(device, ""), paper(device, "-DOX_PAPER");
  EXPECT_THROW(Kernel(product, "monolithic"), DeviceError);
  EXPECT_NO_THROW(Kernel(paper, "monolithic"));
}

TEST(Program, HasNoKernelsOfGroupsWhereTheyAreApart) {
  Device device("");
  Program all(device, ""), others(device, kGroupsApart);
  for (const char* name : {"cull", "flood", "choose_planes", "reduce_candidates"}) {
    EXPECT_NO_THROW(Kernel(all, name));
    EXPECT_THROW(Kernel(others, name), DeviceError);
  }
  EXPECT_NO_THROW(Kernel(others, "match"));
}

TEST(Program, AlwaysBuildsOpenClC12) {
  Device device("");
  EXPECT_NO_THROW(Program(device,
                          "#if __OPENCL_C_VERSION__ != 120 || defined(__FAST_RELAXED_MATH__)\n"
                          "#error not plain OpenCL C 1.2\n#endif\n__kernel void k() {}",
                          ""));
}

TEST(Program, NamesDeviceDriverOptionsAndLogWhenItDoesNotBuild) {
  Device device("");
  const std::string message = error_of(
      [&] { Program(device, "__kernel void k() { no_such_thing(); }", "-DSOME_OPTION=7"); });
  for (const std::string& part :
       {device.info().name, device.info().driver, std::string("-cl-std=CL1.2 -DSOME_OPTION=7"),
        std::string("no_such_thing"), std::string("CL_BUILD_PROGRAM_FAILURE (-11)")}) {
    EXPECT_NE(message.find(part), std::string::npos) << part << " is not in:\n" << message;
  }
}

// A cache that was there, and then could not be written: PoCL's log is empty but for the failure.
TEST(ProgramDeathTest, ThatPoclCannotCacheSaysWhatToDo) {
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto try_with_cache_of_another = [] {
    char folder[] = "/tmp/no_cache_XXXXXX";
    if (!::mkdtemp(folder)) std::exit(2);
    ::setenv("POCL_CACHE_DIR", folder, 1);
    Device device("Portable Computing Language");
    std::filesystem::remove_all(folder);
    std::ofstream(folder).put('x');  // a file of this name: root cannot write below it either
    const std::string message = error_of([&] { Program(device, kSource, ""); });
    std::filesystem::remove(folder);
    std::fputs(message.c_str(), stderr);
    std::exit(0);
  };
  EXPECT_EXIT(try_with_cache_of_another(), ::testing::ExitedWithCode(0),
              "CL_BUILD_PROGRAM_FAILURE.*POCL_CACHE_DIR .now '/tmp/no_cache_");
}

TEST(Kernel, SaysWhichOneDoesNotExist) {
  Device device("");
  Program program(device, kSource, "");
  const std::string message = error_of([&] { Kernel(program, "missing"); });
  EXPECT_NE(message.find("CL_INVALID_KERNEL_NAME"), std::string::npos) << message;
  EXPECT_NE(message.find("Kernel: missing."), std::string::npos) << message;
}

TEST(Kernel, SaysWhichArgumentIsWrong) {
  Device device("");
  Program program(device, kSource, "");
  Kernel kernel(program, "local_sizes");
  Buffer buffer(device);
  buffer.reserve(1);
  const std::string message = error_of([&] { kernel.launch(1, 1, buffer, std::uint32_t{1}); });
  EXPECT_NE(message.find("Kernel: local_sizes, argument 1 of 4 bytes."), std::string::npos)
      << message;
}

TEST(Kernel, RefusesToRunWithAnArgumentMissing) {
  Device device("");
  Program program(device, kSource, "");
  Kernel kernel(program, "transform");
  Buffer buffer(device);
  buffer.reserve(1);
  EXPECT_NE(error_of([&] { kernel.launch(1, 1, buffer); }).find("CL_INVALID_KERNEL_ARGS"),
            std::string::npos);
}

class KernelOfSize : public testing::TestWithParam<std::size_t> {};

TEST_P(KernelOfSize, RunsEveryWorkItemOnce) {
  const std::size_t local = GetParam();
  Device device("");
  Program program(device, kSource, "");
  Kernel kernel(program, "transform"), sizes(program, "local_sizes");
  for (const std::size_t count : {1u, 63u, 64u, 65u, 1234u, 70000u}) {
    const std::size_t groups = (count + local - 1) / local;
    std::vector<std::uint32_t> in(count), out(count), expected(count), seen(groups * local);
    for (std::size_t i = 0; i < count; ++i) {
      in[i] = static_cast<std::uint32_t>(i);
      expected[i] = static_cast<std::uint32_t>(2 * i + 3);
    }
    Buffer source(device), target(device), local_sizes(device);
    source.reserve(4 * count);
    target.reserve(4 * count);
    local_sizes.reserve(4 * seen.size());
    source.write(in.data(), 4 * count);
    kernel.launch(groups, local, source, target, Parameters{2.0f, 3}, static_cast<cl_uint>(count));
    sizes.launch(groups, local, local_sizes);
    target.read(out.data(), 4 * count);
    local_sizes.read(seen.data(), 4 * seen.size());
    device.finish();
    EXPECT_EQ(out, expected) << count;
    EXPECT_EQ(seen, std::vector<std::uint32_t>(seen.size(), static_cast<std::uint32_t>(local)));
  }
}

INSTANTIATE_TEST_SUITE_P(LocalSizes, KernelOfSize, testing::Values(1, 32, 64, 256));

TEST(Kernel, RefusesAWorkGroupLargerThanTheDevices) {
  Device device("");
  Program program(device, kSource, "");
  Kernel kernel(program, "local_sizes");
  Buffer buffer(device);
  const std::size_t local = 2 * device.info().work_group_limit;
  buffer.reserve(4 * local);
  const std::string message = error_of([&] { kernel.launch(1, local, buffer); });
  EXPECT_NE(message.find("Kernel: local_sizes, 1 groups of " + std::to_string(local)),
            std::string::npos)
      << message;
}

TEST(Kernel, EnqueuesNothingForNoGroups) {
  Device device("");
  Program program(device, kSource, "");
  Kernel kernel(program, "local_sizes");
  Buffer buffer(device);
  buffer.reserve(4);
  fault_injector::disarm();
  kernel.launch(0, 64, buffer);
  EXPECT_EQ(fault_injector::calls_checked(), 1);  // the argument's
  device.finish();
  EXPECT_EQ(kernel.take_milliseconds(), 0);
}

class KernelArguments : public testing::Test {
 protected:
  // How many a launch sets; of no groups it makes no other calls.
  int set_for(const Buffer& buffer) {
    fault_injector::disarm();
    kernel_.launch(0, 64, buffer);
    return static_cast<int>(fault_injector::calls_checked());
  }
  Buffer buffer_of(std::size_t words) {
    Buffer buffer(device_);
    buffer.reserve(4 * words);
    return buffer;
  }

  Device device_{""};
  Program program_{device_, kSource, ""};
  Kernel kernel_{program_, "local_sizes"};
  Buffer buffer_ = buffer_of(64), other_ = buffer_of(64);
};

TEST_F(KernelArguments, AreSetAgainOnlyWhereTheyAreOthers) {
  EXPECT_EQ(set_for(buffer_), 1);
  EXPECT_EQ(set_for(buffer_), 0);
  EXPECT_EQ(set_for(other_), 1);
  EXPECT_EQ(set_for(buffer_), 1);
}

TEST_F(KernelArguments, AreTheMemoryThatABufferHasNow) {
  for (const Memory memory : {Memory::kDevice, Memory::kShared}) {
    Buffer buffer(device_, memory);
    for (const std::size_t count : {64u, 4096u, 65536u}) {  // another each time, maybe in one place
      buffer.reserve(4 * count);
      buffer.fill_zero(4 * count);
      EXPECT_EQ(set_for(buffer), 1);
      kernel_.launch(1, 64, buffer);
      std::uint32_t size = 0;
      buffer.read(&size, sizeof(size));
      device_.finish();
      EXPECT_EQ(size, 64u);
      buffer.release();
      EXPECT_EQ(buffer.id(), 0u);
    }
  }
}

TEST_F(KernelArguments, AreSetAgainWhereOneCouldNotBeSet) {
  EXPECT_EQ(set_for(buffer_), 1);
  fault_injector::arm(1, CL_OUT_OF_RESOURCES);
  EXPECT_THROW(kernel_.launch(0, 64, other_), DeviceError);
  EXPECT_EQ(set_for(buffer_), 1);  // nobody knows which of the two it has
}

TEST(Kernel, TellsTheTimeOfEachLaunchOnce) {
  Device device("");
  Program program(device, kSource, "");
  Kernel kernel(program, "local_sizes");
  Buffer buffer(device);
  buffer.reserve(4 * 64 * 1000);
  for (int i = 0; i < 3; ++i) {
    const auto start = std::chrono::steady_clock::now();
    kernel.launch(1000, 64, buffer);
    device.finish();
    const std::chrono::duration<double, std::milli> passed =
        std::chrono::steady_clock::now() - start;
    const double time = kernel.take_milliseconds();
    EXPECT_GT(time, 0);
    // It lies within what the host saw pass; two clocks may differ by some parts in 10'000, and a
    // GPU's has ticks of a microsecond.
    EXPECT_LT(time, 1.001 * passed.count() + 0.002);
    EXPECT_EQ(kernel.take_milliseconds(), 0);
  }
}

TEST(Kernel, LosesNoTimeOfManyLaunchesNobodyAskedAbout) {
  Device device("");
  Program program(device, kSource, "");
  Kernel one(program, "local_sizes"), many(program, "local_sizes");
  Buffer buffer(device);
  buffer.reserve(4 * 64 * 100);
  one.launch(100, 64, buffer);  // compiled and warm
  device.finish();
  one.take_milliseconds();
  double least = 1e9;  // [ms]
  for (int i = 0; i < 300; ++i) {
    one.launch(100, 64, buffer);
    device.finish();
    least = std::min(least, one.take_milliseconds());
    many.launch(100, 64, buffer);
    device.finish();
  }
  // 300 launches of the same work take at least half of 300 times the shortest one ever seen: half,
  // since the shortest is of another kernel object.
  EXPECT_GT(many.take_milliseconds(), 150 * least);
}

TEST(Device, WorksInSeveralThreadsAtOnceIfEachHasItsOwn) {
  static constexpr std::uint32_t kCount = 1000;
  std::vector<std::uint32_t> sums(4);
  std::vector<std::thread> threads;
  for (std::uint32_t t = 0; t < sums.size(); ++t) {
    threads.emplace_back([&sums, t] {
      Device device("");
      Program program(device, kSource, "");
      Kernel kernel(program, "transform");
      Buffer source(device), target(device);
      std::vector<std::uint32_t> numbers(kCount, 1);
      source.reserve(4 * kCount);
      target.reserve(4 * kCount);
      for (int i = 0; i < 20; ++i) {  // adds t each time
        source.write(numbers.data(), 4 * kCount);
        kernel.launch((kCount + 63) / 64, 64, source, target, Parameters{1.0f, t}, kCount);
        target.read(numbers.data(), 4 * kCount);
        device.finish();
      }
      EXPECT_EQ(numbers, std::vector<std::uint32_t>(kCount, 1 + 20 * t));
      sums[t] = numbers[0];
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(sums, (std::vector<std::uint32_t>{1, 21, 41, 61}));
}

}  // namespace
}  // namespace ode_ext
