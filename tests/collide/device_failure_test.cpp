// SPDX-License-Identifier: BSD-3-Clause
// A device that fails in any of its calls: the batch throws, and the next one is whole again.
#include <gtest/gtest.h>

#include <initializer_list>

#include "collide/collider.h"
#include "support/moving_scene.h"
#include "support/test_scene.h"

namespace ode_ext::test {
namespace {

using Bits = std::vector<std::vector<ContactBits>>;

class DeviceFailure : public ::testing::Test {
 protected:
  ~DeviceFailure() override { fault_injector::disarm(); }
};

constexpr int kCode = CL_INVALID_OPERATION;  // says nothing of memory: there is no second try

// Makes the nth call of a batch fail, for n = 1 until the batch has no more calls; `prepare` comes
// before each. Returns how many calls were made to fail. The last calls of a batch only read the
// kernels' clocks, after the contacts: only those may fail without taking the batch along.
template <class Prepare>
int fail_every_call(Collider& collider, const Scene& scene, const Bits& expected, int code,
                    const Prepare& prepare) {
  int failures = 0;
  for (int n = 1;; ++n) {
    prepare();
    fault_injector::arm(n, code);
    bool failed = false;
    try {
      const Bits bits = bits_of(collider.collide(scene, nullptr));
      EXPECT_EQ(bits, expected) << "call " << n;
    } catch (const DeviceError& error) {
      failed = true;
      EXPECT_EQ(error.code(), code);
    }
    const bool fired = fault_injector::calls_checked() >= n;
    fault_injector::disarm();
    EXPECT_EQ(bits_of(collider.collide(scene, nullptr)), expected) << "after call " << n;
    if (!fired) return n - 1;
    if (failed && code == kCode) {
      EXPECT_EQ(++failures, n) << "a call before went unnoticed";
    }
    if (::testing::Test::HasFailure()) return n;
  }
}

// Of a device that shares memory with the host there are fewer to fail than of others.
class DeviceFailureInStep : public DeviceFailure, public testing::WithParamInterface<bool> {
 protected:
  ColliderOptions options() const {
    ColliderOptions result;
    result.share_memory = GetParam();
    return result;
  }
};

INSTANTIATE_TEST_SUITE_P(SharingMemoryOrNot, DeviceFailureInStep, testing::Bool());

// How many calls were made to fail, of batches of so many pairs each.
int fail_every_call_of(const ColliderOptions& options, int pairs,
                       std::initializer_list<std::uint64_t> seeds) {
  int failures = 0;
  Collider collider(options);
  for (const std::uint64_t seed : seeds) {
    const TestScene scene = random_scene(pairs, seed);
    const Bits expected = bits_of(collider.collide(scene.scene, nullptr));
    failures += fail_every_call(collider, scene.scene, expected, kCode, [] {});
  }
  return failures;
}

// A batch in one launch makes a handful of calls.
TEST_P(DeviceFailureInStep, IsReportedFromEveryCallAndThenForgotten) {
  ColliderOptions stepwise = options();
  stepwise.whole_steps = false;
  EXPECT_GT(fail_every_call_of(options(), 20, {71, 171, 271, 371, 471, 571}), 20);
  EXPECT_GT(fail_every_call_of(stepwise, 20, {71}), 20);
}

TEST_P(DeviceFailureInStep, IsReportedFromEveryCallOfFewPairs) {
  ColliderOptions few = options();
  few.initial_capacity = 1;  // it is run again too
  EXPECT_GT(fail_every_call_of(few, 3, {75, 175}), 5);
  few.whole_steps = false;
  EXPECT_GT(fail_every_call_of(few, 3, {75}), 5);
}

TEST_P(DeviceFailureInStep, IsReportedWhileMeshesAreUploaded) {
  const TestScene scene = random_scene(20, 72), other = random_scene(5, 73);
  Collider collider(options());
  const Bits expected = bits_of(collider.collide(scene.scene, nullptr));
  EXPECT_GT(fail_every_call(collider, scene.scene, expected, kCode,
                            [&] { collider.collide(other.scene, nullptr); }),
            26);
}

// Of a batch whose lists have room for next to nothing.
void fail_while_buffers_grow(ColliderOptions options, bool whole_steps, int every, int at_least) {
  const TestScene scene = random_scene(20, 74);
  options.whole_steps = whole_steps;
  options.initial_capacity = 1;
  Collider reference(options);
  const Bits expected = bits_of(reference.collide(scene.scene, nullptr));
  ASSERT_GT(reference.report().redone, 0);
  int failures = 0;
  // Not every call, since each needs a collider of its own; the rounds of the redone batch repeat
  // their calls, and not in so many.
  for (int n = 1;; n += every) {
    Collider collider(options);
    fault_injector::arm(n, kCode);
    bool failed = false;
    Bits bits;
    try {
      bits = bits_of(collider.collide(scene.scene, nullptr));
    } catch (const DeviceError&) {
      failed = true;
    }
    const bool fired = fault_injector::calls_checked() >= n;
    fault_injector::disarm();
    ASSERT_TRUE(fired || !failed) << "call " << n;
    if (!failed) {
      ASSERT_EQ(bits, expected) << "call " << n;
    }
    failures += failed;
    ASSERT_EQ(bits_of(collider.collide(scene.scene, nullptr)), expected) << "after call " << n;
    if (!fired) break;
    ASSERT_LT(n, 4000);
  }
  EXPECT_GT(failures, at_least);
}

TEST_P(DeviceFailureInStep, IsReportedWhileBuffersGrow) {
  fail_while_buffers_grow(options(), false, 13, 40);
}

TEST_P(DeviceFailureInStep, IsReportedWhileTheBufferOfContactsGrows) {
  fail_while_buffers_grow(options(), true, 1, 30);
}

TEST_P(DeviceFailureInStep, IsReportedWhereEveryCountIsWaitedFor) {
  const TestScene scene = random_scene(20, 75);
  ColliderOptions exact = options();
  exact.launches = LaunchRule::kExact;
  Collider collider(exact);
  const Bits expected = bits_of(collider.collide(scene.scene, nullptr));
  EXPECT_GT(fail_every_call(collider, scene.scene, expected, kCode, [] {}), 20);
}

// Memory that runs out in the middle of a batch: halves of it may fit.
TEST_P(DeviceFailureInStep, OfMemoryIsMetWithSmallerTilesOrReported) {
  const TestScene scene = random_scene(20, 76), other = random_scene(5, 77);
  for (const int code : {CL_MEM_OBJECT_ALLOCATION_FAILURE, CL_OUT_OF_RESOURCES}) {
    Collider collider(options());
    const Bits expected = bits_of(collider.collide(scene.scene, nullptr));
    EXPECT_GT(fail_every_call(collider, scene.scene, expected, code,
                              [&] { collider.collide(other.scene, nullptr); }),
              20);
  }
  int halved = 0;
  bool fired = true;
  for (int n = 1; fired; ++n) {
    Collider collider(options());
    const Bits expected = bits_of(collider.collide(scene.scene, nullptr));
    fault_injector::arm(n, CL_OUT_OF_RESOURCES);
    try {
      EXPECT_EQ(bits_of(collider.collide(scene.scene, nullptr)), expected);
      halved += collider.report().redone > 0 ? 1 : 0;
    } catch (const DeviceError& error) {  // of what all tiles have in common
      EXPECT_EQ(error.code(), CL_OUT_OF_RESOURCES);
    }
    fired = fault_injector::calls_checked() >= n;
    fault_injector::disarm();
  }
  EXPECT_GT(halved, 1);
}

TEST_F(DeviceFailure, OfASinglePairIsReportedWhateverTheCode) {
  const TestScene scene = one_pair(make_cube(1), at(0.1, 0.2, 0.9), make_cube(1), at(0, 0, 0));
  Collider collider({});
  const Bits expected = bits_of(collider.collide(scene.scene, nullptr));
  int failures = 0;
  bool fired = true;
  for (int n = 1; fired; ++n) {
    fault_injector::arm(n, CL_OUT_OF_RESOURCES);
    try {
      EXPECT_EQ(bits_of(collider.collide(scene.scene, nullptr)), expected) << "a clock at most";
    } catch (const DeviceError&) {
      ++failures;
    }
    fired = fault_injector::calls_checked() >= n;
    fault_injector::disarm();
    EXPECT_EQ(bits_of(collider.collide(scene.scene, nullptr)), expected);
  }
  EXPECT_GT(failures, 1);
}

// What a batch that failed, or was halved, left of its temporal data is not taken for whole by the
// next one.
TEST_F(DeviceFailure, LeavesNoTemporalDataHalfWritten) {
  ColliderOptions full;
  full.count_work = true;  // lists vertices by their own rays, as iterative ones do
  Collider reference(full);
  MovingScene moving(smooth_meshes(), 6, 0.002, 78);
  ColliderOptions remembering;
  remembering.rays = Rays::kIterative;
  Collider collider(remembering);
  std::uint64_t iterative = 0;
  for (const int code : {kCode, CL_OUT_OF_RESOURCES, CL_MEM_OBJECT_ALLOCATION_FAILURE}) {
    bool fired = true;
    for (int n = 1; fired; ++n) {
      PassMemory memory;
      for (int i = 0; i < 2; ++i, moving.advance()) collider.collide(moving.scene(), &memory);
      fault_injector::arm(n, code);
      try {
        collider.collide(moving.scene(), &memory);
      } catch (const DeviceError&) {
      }
      fired = fault_injector::calls_checked() >= n;
      fault_injector::disarm();
      for (int i = 0; i < 2; ++i) {
        moving.advance();
        const Bits expected = bits_of(reference.collide(moving.scene(), nullptr));
        ASSERT_EQ(bits_of(collider.collide(moving.scene(), &memory)), expected)
            << "after call " << n << " failed with " << code;
      }
      iterative += collider.report().actual[static_cast<std::size_t>(List::kRaysIterative)];
    }
  }
  EXPECT_GT(iterative, 1000u);
}

}  // namespace
}  // namespace ode_ext::test
