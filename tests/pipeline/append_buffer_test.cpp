// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/append_buffer.h"

#include <gtest/gtest.h>

namespace ode_ext {
namespace {

TEST(AppendBuffer, HasNoRoomUntilAsked) {
  Device device("");
  const AppendBuffer buffer(device, 12);
  EXPECT_EQ(buffer.capacity(), 0u);
  EXPECT_EQ(buffer.record_bytes(), 12u);
}

TEST(AppendBuffer, GrowsByAQuarterMoreThanAsked) {
  Device device("");
  AppendBuffer buffer(device, 12);
  buffer.reserve(1000);
  EXPECT_EQ(buffer.capacity(), 1250u);
  EXPECT_GE(buffer.records().capacity(), 1250u * 12);
}

TEST(AppendBuffer, KeepsItsMemoryWhileThereIsRoom) {
  Device device("");
  AppendBuffer buffer(device, 8);
  buffer.reserve(1000);
  const cl_mem memory = buffer.records().get();
  buffer.reserve(1250);
  buffer.reserve(1);
  EXPECT_EQ(buffer.capacity(), 1250u);
  EXPECT_EQ(buffer.records().get(), memory);
}

TEST(AppendBuffer, HoldsEveryNumberOfRecordsAskedFor) {
  Device device("");
  AppendBuffer buffer(device, 32);
  for (std::uint64_t records = 1; records < 200000; records = records * 3 + 1) {
    buffer.reserve(records);
    ASSERT_GE(buffer.capacity(), records);
    ASSERT_GE(buffer.records().capacity(), std::size_t{buffer.capacity()} * 32);
  }
}

TEST(AppendBuffer, IsEmptyAfterGrowingFailed) {
  Device device("");
  AppendBuffer buffer(device, 8);
  buffer.reserve(100);
  fault_injector::arm(1, CL_MEM_OBJECT_ALLOCATION_FAILURE);
  EXPECT_THROW(buffer.reserve(100000), DeviceError);
  fault_injector::disarm();
  EXPECT_EQ(buffer.capacity(), 0u);
  buffer.reserve(100);
  EXPECT_EQ(buffer.capacity(), 125u);
  EXPECT_GE(buffer.records().capacity(), 125u * 8);
}

}  // namespace
}  // namespace ode_ext
