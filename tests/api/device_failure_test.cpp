// SPDX-License-Identifier: BSD-3-Clause
// A device that fails at any call: the program goes on with ODE's own contacts, is told once, and
// gets the batch back as soon as the device works again.
#include <gtest/gtest.h>

#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "opencl/error.h"
#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

struct Disarm {
  ~Disarm() { fault_injector::disarm(); }
};

int message_count = 0;
std::string said;  // one a line
void count_message(int, const char* format, va_list values) {
  ++message_count;
  char text[1024];
  std::vsnprintf(text, sizeof(text), format, values);
  said += text + std::string("\n");
}

struct CountMessages {
  CountMessages() {
    message_count = 0;
    said.clear();
    dSetMessageHandler(&count_message);
  }
  ~CountMessages() { dSetMessageHandler(nullptr); }
};

class ApiDeviceFailure : public testing::Test {
 protected:
  Collected stock() {
    Collected collected;
    dSpaceCollide(space_, &collected, &collect);
    return collected;
  }

  OdeWorld world_;
  dSpaceID space_ = world_.space(SpaceKind::Simple);
  Pile pile_{world_, space_, 12, 5};
  Collected stock_ = stock();  // before any collider exists
  const Disarm disarm_{};
};

TEST_F(ApiDeviceFailure, AtAnyCallOfAPassIsAnsweredByOdesOwnColliderAndThenForgotten) {
  const BatchCollider collider;
  const Collected batch = collider.pass(space_);
  ASSERT_GT(batch.total(), 0);
  int failures = 0;
  for (long long nth = 1;; ++nth) {
    pile_.shake(static_cast<std::uint64_t>(nth));  // so that there is something to compute
    pile_.shake(5);
    const BatchCollider fresh;  // nothing kept from before, buffers still small
    fault_injector::arm(nth, CL_OUT_OF_RESOURCES);
    const Collected failed = fresh.pass(space_);
    const bool fired = fault_injector::calls_checked() >= nth;
    fault_injector::disarm();
    if (!fired) break;
    if ((fresh.stats().status & dBatchStatusDeviceFailed) != 0) {
      ++failures;
      ASSERT_EQ(difference_with_geoms(failed, stock_), "") << "call " << nth;
      EXPECT_NE(last_error().find("CL_OUT_OF_RESOURCES"), std::string::npos) << last_error();
      EXPECT_GT(fresh.stats().pairs_stock, 0);
    } else {  // out of resources may also be cured by computing the pairs in two halves
      ASSERT_EQ(difference_with_geoms(failed, batch), "") << "call " << nth;
    }
    ASSERT_EQ(difference_with_geoms(fresh.pass(space_), batch), "") << "after call " << nth;
    EXPECT_EQ(fresh.stats().status & dBatchStatusDeviceFailed, 0u);
  }
  EXPECT_GT(failures, 10);
}

// All meshes that are known stay on the device, be they of this pass or not.
TEST_F(ApiDeviceFailure, ForMemoryIsCuredByForgettingMeshesThatAreOutOfUse) {
  const dSpaceID elsewhere = world_.space(SpaceKind::Simple);
  const OdeMesh& other = world_.mesh(make_icosphere(1, 2));
  world_.geom(other, {}, elsewhere);
  world_.geom(other, {.position = {1, 0, 0}}, elsewhere);
  const BatchCollider collider;
  const Collected batch = collider.pass(space_);
  int fired = 0;
  for (long long nth = 1; fired + 1 == nth; ++nth) {
    const BatchCollider fresh;
    ASSERT_GT(fresh.pass(elsewhere).total(), 0);
    fault_injector::arm(nth, CL_MEM_OBJECT_ALLOCATION_FAILURE);
    const Collected cured = fresh.pass(space_);
    fired += fault_injector::calls_checked() >= nth ? 1 : 0;
    fault_injector::disarm();
    EXPECT_EQ(fresh.stats().status & dBatchStatusDeviceFailed, 0u) << "call " << nth;
    ASSERT_EQ(difference_with_geoms(cured, batch), "") << "call " << nth;
    ASSERT_EQ(fresh.pass(elsewhere).total(), collider.pass(elsewhere).total()) << "call " << nth;
  }
  EXPECT_GT(fired, 10);
}

TEST_F(ApiDeviceFailure, IsSaidOnceForARunOfFailures) {
  const BatchCollider collider;
  const CountMessages counting;
  for (std::uint64_t i = 0; i < 12; ++i) {  // more passes than a pair nobody asks for is kept
    pile_.shake(i);
    fault_injector::arm(1, CL_DEVICE_NOT_AVAILABLE);
    collider.pass(space_);
    fault_injector::disarm();
    EXPECT_NE(collider.stats().status & dBatchStatusDeviceFailed, 0u);
  }
  EXPECT_EQ(message_count, 1);
}

TEST_F(ApiDeviceFailure, WhileAPairIsComputedAloneIsAnsweredByOdesOwnCollider) {
  const BatchCollider collider;
  for (const auto& [pair, contacts] : stock_.contacts) {
    fault_injector::arm(1, CL_DEVICE_NOT_AVAILABLE);
    const Contacts answer = collide(pair.first, pair.second);
    fault_injector::disarm();
    EXPECT_EQ(difference_with_geoms(answer, contacts), "");
  }
}

TEST_F(ApiDeviceFailure, InCollidePairsIsAnsweredByOdesOwnCollider) {
  const BatchCollider collider;
  std::vector<dGeomID> pairs;
  for (const auto& [pair, contacts] : stock_.contacts) {
    pairs.push_back(pair.first);
    pairs.push_back(pair.second);
  }
  const auto count = static_cast<int>(pairs.size() / 2);
  Contacts contacts(64 * static_cast<std::size_t>(count));
  std::vector<int> counts(static_cast<std::size_t>(count));
  fault_injector::arm(1, CL_DEVICE_NOT_AVAILABLE);
  const int total = dBatchColliderCollidePairs(collider, pairs.data(), count, 64, contacts.data(),
                                               sizeof(dContactGeom), counts.data());
  fault_injector::disarm();
  EXPECT_EQ(total, stock_.total());
  EXPECT_NE(collider.stats().status & dBatchStatusDeviceFailed, 0u);
}

TEST_F(ApiDeviceFailure, AtAnyCallOfCreateIsAMessageAndNoCollider) {
  int failures = 0;
  for (long long nth = 1;; ++nth) {
    fault_injector::arm(nth, CL_OUT_OF_HOST_MEMORY);
    const dBatchColliderID collider = dBatchColliderCreate(nullptr);
    const bool fired = fault_injector::calls_checked() >= nth;
    fault_injector::disarm();
    if (collider != nullptr) dBatchColliderDestroy(collider);
    if (!fired) break;
    if (collider != nullptr) continue;  // a platform that fails to answer is passed over
    ++failures;
    EXPECT_EQ(last_error().rfind("dBatchColliderCreate: ", 0), 0u) << last_error();
    // Three of four calls set an argument of a kernel, all in one line: every seventh of these.
    if (last_error().find("clSetKernelArg") != std::string::npos) nth += 6;
  }
  EXPECT_GT(failures, 10);
}

class ApiInformation : public ApiDeviceFailure {
 protected:
  Environment log_{"ODE_EXT_LOG", "info"};
  CountMessages count_;
};

TEST_F(ApiInformation, SaysThatKernelsAreBuiltAndWhenTheyAre) {
  const BatchCollider collider;
  const std::size_t building = said.find("building the kernels for device"),
                    ready = said.find("the kernels are ready");
  ASSERT_NE(building, std::string::npos) << said;
  EXPECT_NE(said.find(collider.stats().device, building), std::string::npos) << said;
  EXPECT_GT(ready, building) << said;
  EXPECT_NE(ready, std::string::npos) << said;
}

TEST_F(ApiInformation, SaysThatKernelsAreBuiltBeforeTheyAre) {
  for (long long nth = 1; nth < 100; ++nth) {
    said.clear();
    fault_injector::arm(nth, CL_OUT_OF_HOST_MEMORY);
    const dBatchColliderID collider = dBatchColliderCreate(nullptr);
    fault_injector::disarm();
    if (collider != nullptr) dBatchColliderDestroy(collider);
    if (last_error().find("clCreateProgramWithSource") == std::string::npos) continue;
    EXPECT_NE(said.find("building the kernels"), std::string::npos) << said;
    EXPECT_EQ(said.find("the kernels are ready"), std::string::npos) << said;
    return;
  }
  FAIL() << "the build was never reached";
}

}  // namespace
}  // namespace ode_ext::test
