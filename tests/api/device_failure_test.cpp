// SPDX-License-Identifier: BSD-3-Clause
// A device that fails at any call: the program goes on with ODE's own contacts, is told once, and
// gets the batch back as soon as the device works again.
#include <gtest/gtest.h>

#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "ode/batch_collider.h"
#include "ode/registry.h"
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
  dBatchColliderParams params;  // of one device: there may be others
  dBatchColliderParamsInit(&params);
  const std::string device = std::to_string(dBatchDeviceChoose(nullptr));
  params.device = device.c_str();
  int failures = 0;
  for (long long nth = 1;; ++nth) {
    fault_injector::arm(nth, CL_OUT_OF_HOST_MEMORY);
    const dBatchColliderID collider = dBatchColliderCreate(&params);
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

// Of dCollide outside of any pass, in programs that make none.
TEST_F(ApiDeviceFailure, OfAQuestionIsNoLongerToldOnceOneIsAnswered) {
  const BatchCollider collider;
  const CountMessages count;
  const auto ask = [&](int shift) {
    set_pose(pile_.geoms[0], at(0.01 * shift, 0, 0));  // something to compute
    set_pose(pile_.geoms[1], at(0.01 * shift, 0.1, 0));
    dContactGeom contact;
    return dCollide(pile_.geoms[0], pile_.geoms[1], 1, &contact, sizeof contact);
  };
  for (int round = 0; round < 2; ++round) {
    fault_injector::arm(1, CL_DEVICE_NOT_AVAILABLE);
    EXPECT_GT(ask(3 * round), 0) << "ODE's own collider answers";
    fault_injector::arm(1, CL_DEVICE_NOT_AVAILABLE);
    EXPECT_GT(ask(3 * round + 2), 0) << "and again";
    fault_injector::disarm();
    EXPECT_EQ(dBatchColliderGetStatus(collider), dBatchStatusDeviceFailed);
    EXPECT_EQ(message_count, round + 1);
    EXPECT_GT(ask(3 * round + 1), 0);
    EXPECT_EQ(dBatchColliderGetStatus(collider), 0);
  }
  // What is said of a pass stays. Of its calls some only read a clock, which costs nothing.
  for (int nth = 1; nth < 50 && dBatchColliderGetStatus(collider) == 0; ++nth) {
    pile_.shake(static_cast<std::uint64_t>(nth));
    fault_injector::arm(nth, CL_DEVICE_NOT_AVAILABLE);
    collider.pass(space_);
    fault_injector::disarm();
  }
  ASSERT_EQ(dBatchColliderGetStatus(collider), dBatchStatusDeviceFailed);
  EXPECT_GT(ask(9), 0);
  EXPECT_EQ(dBatchColliderGetStatus(collider), dBatchStatusDeviceFailed);
}

// As a driver leaves it that was reset: whatever was made before fails from then on.
TEST_F(ApiDeviceFailure, ThatGoesOnHasTheDeviceTakenUpFromTheStart) {
  const Environment told("ODE_EXT_LOG", "info");
  const BatchCollider collider;
  const Collected batch = collider.pass(space_);
  const CountMessages count;
  int failures = 0;
  for (int i = 1; failures < 8; ++i) {
    ASSERT_LT(i, 100);
    pile_.shake(static_cast<std::uint64_t>(i));
    // After a failure the first call is of this pass, else maybe one that reads a clock.
    fault_injector::arm(failures == 0 ? i : 1, CL_DEVICE_NOT_AVAILABLE);
    collider.pass(space_);
    fault_injector::disarm();
    failures += dBatchColliderGetStatus(collider) == dBatchStatusDeviceFailed ? 1 : 0;
    EXPECT_EQ(said.find("from the start"), std::string::npos) << said;
  }
  pile_.shake(5);
  EXPECT_EQ(difference_with_geoms(collider.pass(space_), batch), "");
  EXPECT_EQ(dBatchColliderGetStatus(collider), 0);
  EXPECT_NE(said.find("failed 8 times in a row: it is taken up from the start"), std::string::npos)
      << said;
  pile_.shake(6);
  pile_.shake(5);
  EXPECT_EQ(difference_with_geoms(collider.pass(space_), batch), "");
}

TEST_F(ApiDeviceFailure, ThatGoesOnHasTheDeviceTakenUpFromTheStartOnceHoweverItIsAsked) {
  const Environment told("ODE_EXT_LOG", "info");
  const BatchCollider collider;
  const dSpaceID empty = world_.space(SpaceKind::Simple);
  const CountMessages count;
  const auto starts = [&] {
    int found = 0;
    for (std::size_t at = 0; (at = said.find("from the start", at)) != std::string::npos; ++at)
      ++found;
    return found;
  };
  const auto ask = [&](int i) {
    set_pose(pile_.geoms[0], at(0.01 * i, 0, 0));
    set_pose(pile_.geoms[1], at(0.01 * i, 0.1, 0));
    return collide(pile_.geoms[0], pile_.geoms[1]).size();
  };
  for (int i = 0; i < 8; ++i) {
    fault_injector::arm(1, CL_DEVICE_NOT_AVAILABLE);
    EXPECT_GT(ask(i), 0u);
    fault_injector::disarm();
    EXPECT_EQ(starts(), 0);
  }
  // Passes with nothing to compute tell nothing of the device, and need none.
  for (int i = 0; i < 3; ++i) collider.pass(empty);
  EXPECT_EQ(starts(), 0);
  for (int i = 9; i < 12; ++i) {
    EXPECT_GT(ask(i), 0u);
    EXPECT_EQ(dBatchColliderGetStatus(collider) & dBatchStatusDeviceFailed, 0);
    EXPECT_EQ(starts(), 1);
  }
}

// A device of which no buffer may be large enough for what two soups have in common.
class ApiGivenUp : public testing::Test {
 protected:
  ApiGivenUp() {
    ColliderOptions options;
    options.max_contacts = 16;
    options.whole_steps = false;  // they reserve more
    options.largest_buffer = std::uint64_t{6} << 20;
    collider_ = std::make_shared<ode_ext::BatchCollider>(options, 0.0f, false, false);
    register_collider(collider_);
  }
  ~ApiGivenUp() override { dBatchColliderDestroy(id()); }

  dBatchColliderID id() const { return reinterpret_cast<dBatchColliderID>(collider_.get()); }
  Collected pass() const {
    Collected collected;
    EXPECT_EQ(dBatchColliderSpaceCollide(id(), space_, &collected, &collect), 1);
    return collected;
  }
  Collected stock() const {
    Collected collected;
    dSpaceCollide(space_, &collected, &collect);
    return collected;
  }
  GeomPair soups_as_asked() const {
    const GeomPair pair{soups_[0], soups_[1]}, exchanged{soups_[1], soups_[0]};
    return stock_.contacts.contains(pair) ? pair : exchanged;
  }

  OdeWorld world_;
  dSpaceID space_ = world_.space(SpaceKind::Simple);
  dGeomID soups_[2] = {world_.geom(world_.mesh(make_soup(800, 7)), {}, space_),
                       world_.geom(world_.mesh(make_soup(800, 8)), {}, space_)};
  Pile pile_{world_, space_, 8, 5, {20, 0, 0}};
  Collected stock_ = stock();  // before any collider exists
  dGeomID outside_[2] = {world_.geom(world_.mesh(make_cube(1)), at(50, 0, 0)),
                         world_.geom(world_.mesh(make_cube(1)), at(50.2, 0.3, 0.4))};
  std::shared_ptr<ode_ext::BatchCollider> collider_;
  const CountMessages count_{};
};

TEST_F(ApiGivenUp, OnePairIsAnsweredByOdeAndAllOthersByTheBatch) {
  Collected expected;
  {
    const BatchCollider whole;
    expected = whole.pass(space_);
  }
  expected.contacts[soups_as_asked()] = stock_.contacts[soups_as_asked()];
  for (int i = 1; i <= 3; ++i) {
    EXPECT_EQ(difference_with_geoms(pass(), expected), "") << "pass " << i;
    EXPECT_EQ(dBatchColliderGetStatus(id()) & dBatchStatusDeviceFailed, dBatchStatusDeviceFailed);
    EXPECT_EQ(dBatchColliderGetCount(id(), dBatchCounterPairsStock), i);
    // Where it was: something to look at, and the same to find; or only the soups are left to do.
    if (i == 1) pile_.shake(5);
    // A question of others outside of any pass changes nothing of that.
    set_pose(outside_[0], at(50 + 0.01 * i, 0, 0));
    EXPECT_FALSE(collide(outside_[0], outside_[1]).empty());
  }
  const std::size_t told = said.find("This is of one pair");
  EXPECT_NE(told, std::string::npos) << said;
  EXPECT_EQ(said.find("This is of one pair", told + 1), std::string::npos) << "once: " << said;
}

TEST_F(ApiGivenUp, OnePairIsTriedAgainAfterAWhileAndWhereItIsOfOtherMeshes) {
  const auto attempts = [&] {
    return dBatchColliderGetCount(id(), dBatchCounterRedone);  // each halves the scene
  };
  const auto counted = [&](int i) {
    pile_.shake(static_cast<std::uint64_t>(i));  // a scene to be halved
    pass();
    return attempts();
  };
  EXPECT_GT(counted(1), 0);
  int passes = 1;
  while (passes < 100 && counted(++passes) == 0) {
  }
  EXPECT_EQ(passes, 1 + 64);
  EXPECT_EQ(counted(++passes), 0);
  set_mesh(soups_[0], world_.mesh(make_soup(800, 9)).id());
  EXPECT_GT(counted(++passes), 0);
  EXPECT_EQ(counted(++passes), 0);
  // And it is collided where there is room.
  set_mesh(soups_[0], world_.mesh(make_cube(1)).id());
  pass();
  EXPECT_EQ(dBatchColliderGetStatus(id()) & dBatchStatusDeviceFailed, 0);
}

TEST_F(ApiGivenUp, OnePairOfManyThatAreGivenIsAnsweredByOde) {
  const auto& [soup, other] = soups_as_asked();
  std::vector<dGeomID> pairs{pile_.geoms[0], pile_.geoms[1], soup,
                             other,          pile_.geoms[2], pile_.geoms[3]};
  set_pose(pile_.geoms[1], pose_of(pile_.geoms[0]));
  set_pose(pile_.geoms[3], pose_of(pile_.geoms[2]));
  std::vector<Contacts> expected;
  {
    const BatchCollider whole;
    for (std::size_t i = 0; i < 3; ++i) expected.push_back(collide(pairs[2 * i], pairs[2 * i + 1]));
  }
  expected[1] = stock_.contacts[soups_as_asked()];
  std::vector<dContactGeom> contacts(3 * 64);
  int counts[3];
  EXPECT_GT(dBatchColliderCollidePairs(id(), pairs.data(), 3, 64, contacts.data(),
                                       sizeof(dContactGeom), counts),
            0);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto first = contacts.begin() + static_cast<std::ptrdiff_t>(64 * i);
    EXPECT_EQ(difference(Contacts(first, first + counts[i]), expected[i]), "") << i;
  }
}

class DefaultDeviceDeathTest : public testing::Test {
 protected:
  DefaultDeviceDeathTest() { ::testing::FLAGS_gtest_death_test_style = "threadsafe"; }
};

// PoCL shows as many devices as it is told to: the first fails, and the second is taken.
TEST_F(DefaultDeviceDeathTest, IsTheNextWhereTheFirstDoesNotWork) {
  EXPECT_EXIT(
      {
        unsetenv("ODE_EXT_DEVICE");
        setenv("POCL_DEVICES", "pthread basic", 1);
        const OdeWorld world;
        const int devices = dBatchDeviceCount();
        for (long long nth = 1; nth < 100; ++nth) {
          fault_injector::arm(nth, CL_BUILD_PROGRAM_FAILURE);
          const dBatchColliderID collider = dBatchColliderCreate(nullptr);
          fault_injector::disarm();
          const bool is_second =
              collider != nullptr &&
              dBatchColliderGetDeviceName(collider) !=
                  std::string(dBatchDeviceGetText(dBatchDeviceChoose(""), dBatchDeviceName));
          if (collider != nullptr) dBatchColliderDestroy(collider);
          if (is_second) std::exit(devices >= 2 ? 0 : 2);
        }
        // Of PoCL there are two.
        const std::string platform = dBatchDeviceGetText(0, dBatchDevicePlatform);
        std::exit(devices == 1 && platform.find("Portable") == std::string::npos ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace ode_ext::test
