// SPDX-License-Identifier: BSD-3-Clause
#include "opencl/buffer.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <numeric>
#include <utility>
#include <vector>

#include "opencl/error.h"
#include "opencl/program.h"

namespace ode_ext {
namespace {

// Slow enough (some 50 ms) that it is still at it when the host goes on.
constexpr const char* kSlowCopy = R"(
__kernel void slow_copy(__global const uint* from, __global uint* to) {
  uint x = 1u;
  for (uint i = 0u; i < 50000000u; ++i) x = x * 1664525u + (x >> 16);
  to[0] = from[0] + (x == 1u ? 1u : 0u);
}
)";

std::vector<std::uint8_t> counting(std::size_t size) {
  std::vector<std::uint8_t> bytes(size);
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{1});
  return bytes;
}

TEST(Buffer, TakesWholePagesAndNeverNone) {
  Device device("");
  Buffer buffer(device);
  EXPECT_EQ(buffer.capacity(), 0u);
  EXPECT_EQ(buffer.get(), nullptr);
  buffer.reserve(0);
  EXPECT_EQ(buffer.capacity(), 4096u);
  EXPECT_NE(buffer.get(), nullptr);
  Buffer larger(device);
  larger.reserve(4097);
  EXPECT_EQ(larger.capacity(), 8192u);
}

TEST(Buffer, GrowsByHalfAtLeastAndNeverShrinks) {
  Device device("");
  Buffer buffer(device);
  buffer.reserve(100 * 4096);
  const cl_mem memory = buffer.get();
  buffer.reserve(100 * 4096);
  buffer.reserve(1);
  EXPECT_EQ(buffer.get(), memory);
  EXPECT_EQ(buffer.capacity(), 100u * 4096);
  buffer.reserve(100 * 4096 + 1);
  EXPECT_EQ(buffer.capacity(), 150u * 4096);
  buffer.reserve(400 * 4096);
  EXPECT_EQ(buffer.capacity(), 400u * 4096);
}

TEST(Buffer, ReadsWhatWasWrittenAtAnyOffset) {
  Device device("");
  Buffer buffer(device);
  buffer.reserve(1000);
  for (const std::size_t size : {1u, 63u, 64u, 65u, 500u}) {
    for (const std::size_t offset : {0u, 1u, 4u, 77u}) {
      const std::vector<std::uint8_t> source = counting(size);
      std::vector<std::uint8_t> target(size);
      buffer.write(source.data(), size, offset);
      buffer.read(target.data(), size, offset);
      device.finish();
      EXPECT_EQ(target, source) << size << " at " << offset;
    }
  }
}

TEST(Buffer, KeepsWhatIsInItWhereItIsExtendedAndTheRestIsZero) {
  Device device("");
  Buffer buffer(device);
  buffer.extend(1);
  std::vector<unsigned char> bytes(buffer.capacity(), 1);
  buffer.read(bytes.data(), bytes.size());
  device.finish();
  EXPECT_EQ(bytes, std::vector<unsigned char>(bytes.size(), 0));
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<unsigned char>(i % 251 + 1);
  buffer.write(bytes.data(), bytes.size());
  const std::size_t before = buffer.capacity();
  buffer.extend(before + 1);
  ASSERT_GT(buffer.capacity(), before);
  std::vector<unsigned char> extended(buffer.capacity(), 1);
  buffer.read(extended.data(), extended.size());
  device.finish();
  bytes.resize(extended.size(), 0);
  EXPECT_EQ(extended, bytes);
}

TEST(Buffer, FillsExactlyTheBytesAskedForWithZero) {
  Device device("");
  Buffer buffer(device);
  const std::vector<std::uint8_t> source(200, 0xff);
  buffer.reserve(source.size());
  for (const auto& [offset, size] :
       {std::pair{0, 200}, {0, 1}, {1, 1}, {4, 8}, {4, 7}, {3, 8}, {196, 4}}) {
    std::vector<std::uint8_t> expected = source, target(source.size());
    std::memset(expected.data() + offset, 0, static_cast<std::size_t>(size));
    buffer.write(source.data(), source.size());
    buffer.fill_zero(static_cast<std::size_t>(size), static_cast<std::size_t>(offset));
    buffer.read(target.data(), target.size());
    device.finish();
    EXPECT_EQ(target, expected) << size << " at " << offset;
  }
}

TEST(Buffer, DoesNothingForZeroBytesEvenWhileEmpty) {
  Device device("");
  Buffer buffer(device);
  fault_injector::disarm();
  buffer.write(nullptr, 0);
  buffer.read(nullptr, 0);
  buffer.fill_zero(0);
  EXPECT_EQ(fault_injector::calls_checked(), 0);
}

TEST(Buffer, RefusesTransfersPastItsEnd) {
  Device device("");
  Buffer buffer(device);
  buffer.reserve(4096);
  std::vector<std::uint8_t> bytes(4097);
  EXPECT_THROW(buffer.write(bytes.data(), 4097), DeviceError);
  EXPECT_THROW(buffer.read(bytes.data(), 1, 4096), DeviceError);
  EXPECT_THROW(buffer.fill_zero(4097), DeviceError);
}

TEST(Buffer, NamesBothSizesWhenTheDeviceCannotHoldSoMuchAndIsEmptyThen) {
  Device device("");
  Buffer buffer(device);
  buffer.reserve(1);
  const std::size_t largest = device.info().largest_buffer;
  try {
    buffer.reserve(largest + 1);
    FAIL() << "expected a DeviceError";
  } catch (const DeviceError& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.code(), CL_INVALID_BUFFER_SIZE);
    EXPECT_NE(message.find(std::to_string(largest) + " bytes"), std::string::npos) << message;
    EXPECT_NE(message.find(std::to_string(largest + 1) + " bytes"), std::string::npos) << message;
    EXPECT_NE(message.find(device.info().name), std::string::npos) << message;
  }
  EXPECT_EQ(buffer.capacity(), 0u);
  EXPECT_EQ(buffer.get(), nullptr);
  EXPECT_THROW(buffer.reserve(SIZE_MAX), DeviceError);
  buffer.reserve(1);
  EXPECT_EQ(buffer.capacity(), 4096u);
}

TEST(Buffer, IsEmptyAfterTheDeviceRefusesToGrowIt) {
  Device device("");
  Buffer buffer(device);
  buffer.reserve(4096);
  fault_injector::arm(1, CL_MEM_OBJECT_ALLOCATION_FAILURE);
  try {
    buffer.reserve(8192);
    FAIL() << "expected a DeviceError";
  } catch (const DeviceError& error) {
    EXPECT_NE(std::string(error.what()).find("Asked for: 8192 bytes"), std::string::npos)
        << error.what();
  }
  fault_injector::disarm();
  EXPECT_EQ(buffer.capacity(), 0u);
  EXPECT_EQ(buffer.get(), nullptr);
}

TEST(Buffer, LeavesAnEmptyOneBehindWhenMoved) {
  Device device("");
  Buffer from(device);
  from.reserve(1);
  const cl_mem memory = from.get();
  const Buffer to(std::move(from));
  EXPECT_EQ(to.get(), memory);
  EXPECT_EQ(to.capacity(), 4096u);
  EXPECT_EQ(from.get(), nullptr);
  EXPECT_EQ(from.capacity(), 0u);
}

// Of a device that shares memory, if this one can, and of one that does not.
class SharedBuffer : public testing::TestWithParam<bool> {
 protected:
  // Launched, not waited for.
  void copy_one() {
    from_.reserve(4);
    to_.reserve(4);
    from_.write(&one_, 4);
    copy_.launch(1, 1, from_, to_);
  }
  std::uint32_t seen(const Buffer& buffer) {
    HostView view(device_);
    view.reserve(buffer, sizeof(std::uint32_t));
    view.read(buffer, sizeof(std::uint32_t));
    device_.finish();
    std::uint32_t number = 0;
    std::memcpy(&number, view.data(), sizeof(number));
    return number;
  }

  Device device_{"", 0, GetParam()};
  Program program_{device_, kSlowCopy, ""};
  Kernel copy_{program_, "slow_copy"};
  const std::uint32_t one_ = 1, two_ = 2;
  Buffer from_{device_, Memory::kShared}, to_{device_, Memory::kShared};
};

INSTANTIATE_TEST_SUITE_P(WhereItMayBe, SharedBuffer, testing::Bool());

TEST_P(SharedBuffer, ShowsWhatAKernelMadeOfWhatTheHostWrote) {
  copy_one();
  EXPECT_EQ(seen(to_), 1u);
  to_.fill_zero(4);
  EXPECT_EQ(seen(to_), 0u);
}

TEST_P(SharedBuffer, IsWrittenAfterTheKernelThatWasLaunchedBefore) {
  copy_one();
  from_.write(&two_, 4);
  EXPECT_EQ(seen(to_), 1u);
  EXPECT_EQ(seen(from_), 2u);
  copy_.launch(1, 1, from_, to_);
  from_.fill_zero(4);
  EXPECT_EQ(seen(to_), 2u);
}

TEST_P(SharedBuffer, OutlivesItsReleaseInTheKernelsThatNeedIt) {
  copy_one();
  from_.release();
  EXPECT_EQ(from_.shared(), nullptr);
  // What takes the place of memory that was freed too early.
  const std::vector<std::vector<std::uint32_t>> others(64, std::vector<std::uint32_t>(1024, 77));
  EXPECT_EQ(seen(to_), 1u);
}

TEST_P(SharedBuffer, IsEmptyAfterAnyCallThatFailedToGrowIt) {
  for (const bool extends : {false, true})
    for (int nth = 1;; ++nth) {
      Buffer buffer(device_, Memory::kShared);
      buffer.extend(4);
      device_.finish();
      fault_injector::arm(nth, CL_MEM_OBJECT_ALLOCATION_FAILURE);
      try {
        extends ? buffer.extend(8192) : buffer.reserve(8192);
        ASSERT_LT(fault_injector::calls_checked(), nth);
        fault_injector::disarm();
        EXPECT_GT(nth, 1);
        break;
      } catch (const DeviceError&) {
        fault_injector::disarm();
        EXPECT_EQ(buffer.capacity(), 0u) << nth;
        EXPECT_EQ(buffer.get(), nullptr) << nth;
        EXPECT_EQ(buffer.shared(), nullptr) << nth;
      }
    }
}

TEST_P(SharedBuffer, KeepsWhatIsInItWhereItIsExtended) {
  Buffer buffer(device_, Memory::kShared);
  buffer.extend(4);
  buffer.write(&two_, 4);
  buffer.extend(buffer.capacity() + 1);
  EXPECT_EQ(seen(buffer), 2u);
}

TEST_P(SharedBuffer, RefusesTransfersPastItsEnd) {
  Buffer buffer(device_, Memory::kShared);
  buffer.reserve(4096);
  const std::vector<std::uint8_t> bytes(4097);
  EXPECT_THROW(buffer.write(bytes.data(), 4097), DeviceError);
  EXPECT_THROW(buffer.write(bytes.data(), 1, 4096), DeviceError);
  EXPECT_THROW(buffer.fill_zero(4097), DeviceError);
}

TEST_P(SharedBuffer, NeedsNoCommandsWhereItIsShared) {
  Buffer buffer(device_, Memory::kShared);
  buffer.reserve(4);
  EXPECT_EQ(buffer.shared() != nullptr, device_.info().shares_memory);
  HostView view(device_);
  view.reserve(buffer, 4);
  device_.finish();
  fault_injector::disarm();
  buffer.write(&two_, 4);
  view.read(buffer, 4);
  EXPECT_EQ(fault_injector::calls_checked() == 0, device_.info().shares_memory);
}

TEST(Device, ThatMaySharesMemoryIfItIsAProcessorOfPocl) {
  const Device device(""), other("", 0, false);
  EXPECT_FALSE(other.info().shares_memory);
  if (device.info().platform_name == "Portable Computing Language" &&
      device.info().type == CL_DEVICE_TYPE_CPU) {
    EXPECT_TRUE(device.info().shares_memory);
  }
}

TEST(PinnedMemory, TakesAndGivesWhatTheDeviceHolds) {
  Device device("");
  Buffer buffer(device);
  PinnedMemory pinned(device);
  EXPECT_EQ(pinned.data(), nullptr);
  const std::vector<std::uint8_t> source = counting(5000);
  pinned.reserve(source.size());
  buffer.reserve(source.size());
  ASSERT_EQ(pinned.capacity(), 8192u);
  std::memcpy(pinned.data(), source.data(), source.size());
  buffer.write(pinned.data(), source.size());
  device.finish();
  std::memset(pinned.data(), 0, source.size());
  buffer.read(pinned.data(), source.size());
  device.finish();
  EXPECT_EQ(std::memcmp(pinned.data(), source.data(), source.size()), 0);
}

TEST(PinnedMemory, IsWritableToItsLastByteAfterGrowing) {
  Device device("");
  PinnedMemory pinned(device);
  pinned.reserve(1);
  pinned.reserve(100000);
  ASSERT_GE(pinned.capacity(), 100000u);
  std::memset(pinned.data(), 0x5a, pinned.capacity());
  EXPECT_EQ(static_cast<std::uint8_t*>(pinned.data())[pinned.capacity() - 1], 0x5a);
}

TEST(PinnedMemory, IsEmptyAfterAFailedMapping) {
  Device device("");
  PinnedMemory pinned(device);
  pinned.reserve(1);
  fault_injector::arm(2, CL_MAP_FAILURE);  // clCreateBuffer, clEnqueueMapBuffer
  EXPECT_THROW(pinned.reserve(10000), DeviceError);
  fault_injector::disarm();
  EXPECT_EQ(pinned.data(), nullptr);
  EXPECT_EQ(pinned.capacity(), 0u);
  pinned.reserve(1);
  EXPECT_NE(pinned.data(), nullptr);
}

TEST(Device, CountsSynchronizations) {
  Device device("");
  PinnedMemory pinned(device);
  EXPECT_EQ(device.synchronizations(), 0);
  device.finish();
  EXPECT_EQ(device.synchronizations(), 1);
  pinned.reserve(1);
  EXPECT_EQ(device.synchronizations(), 2);
}

}  // namespace
}  // namespace ode_ext
