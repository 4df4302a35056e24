// SPDX-License-Identifier: BSD-3-Clause
// A child of a program with a collider: the driver's threads are not there, so nothing of OpenCL's
// may be waited for, and ODE's own collider answers.
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>

#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

constexpr unsigned kMostSeconds = 60;  // a child that waits for ever is ended then

int messages_of_child = 0;
std::string last_message;
void take_message(int, const char* text, va_list arguments) {
  ++messages_of_child;
  char buffer[1024];
  vsnprintf(buffer, sizeof buffer, text, arguments);
  last_message = buffer;
}

// Runs `body` in a child; what it returned, or -1 if the child was killed or hung.
template <class Body>
int in_child(const Body& body) {
  const pid_t child = fork();
  if (child == 0) {
    alarm(kMostSeconds);
    _exit(body());
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

class ApiFork : public ::testing::Test {
 protected:
  OdeWorld world;
  dSpaceID space = world.space(SpaceKind::Hash);
  Pile pile{world, space, 8, 3};
  Collected stock = [this] {
    Collected collected;
    dSpaceCollide(space, &collected, &collect);
    return collected;
  }();
  BatchCollider collider;
  Collected batch = collider.pass(space);
};

TEST_F(ApiFork, LeavesTheChildWithContactsOfOdesOwnCollider) {
  ASSERT_NE(difference_with_geoms(batch, stock), "") << "the two could not be told apart";
  const int result = in_child([&] {
    for (const auto& [pair, contacts] : stock.contacts)
      if (!difference_with_geoms(collide(pair.first, pair.second), contacts).empty()) return 1;
    if (!difference_with_geoms(collider.pass(space), stock).empty()) return 2;
    const dGeomID pairs[] = {pile.geoms[0], pile.geoms[1]};
    dContactGeom contacts[64];
    int count = 0;
    const int total =
        dBatchColliderCollidePairs(collider, pairs, 1, 64, contacts, sizeof(dContactGeom), &count);
    if (total != count || count != static_cast<int>(collide(pairs[0], pairs[1]).size())) return 3;
    if ((collider.stats().status & dBatchStatusDeviceFailed) == 0) return 4;
    return 0;
  });
  EXPECT_EQ(result, 0);
}

TEST_F(ApiFork, IsSaidOnceInTheChild) {
  const int result = in_child([&] {
    dSetMessageHandler(&take_message);
    for (int i = 0; i < 3; ++i) collider.pass(space);
    if (messages_of_child != 1) return 1;
    return last_message.find("forked") != std::string::npos ? 0 : 2;
  });
  EXPECT_EQ(result, 0);
}

TEST_F(ApiFork, LeavesTheChildWithoutDevicesToDescribe) {
  const int result = in_child([&] {
    char text[] = "never written";
    if (dBatchColliderDescribeDevices(nullptr, text, sizeof text) != -1) return 1;
    return text[0] == '\0' ? 0 : 2;
  });
  EXPECT_EQ(result, 0);
}

TEST_F(ApiFork, LeavesTheChildAbleToDestroyAndToExit) {
  const int result = in_child([&] {
    collider.destroy();
    if (dBatchColliderCreate(nullptr) != nullptr) return 1;
    if (last_error().find("forked") == std::string::npos) return 2;
    return 0;
  });
  EXPECT_EQ(result, 0);
}

TEST_F(ApiFork, LeavesTheParentAsItWas) {
  ASSERT_EQ(in_child([] { return 0; }), 0);
  pile.shake(4);
  const BatchCollider fresh;
  EXPECT_EQ(difference_with_geoms(collider.pass(space), fresh.pass(space)), "");
  EXPECT_GT(collider.stats().pairs_computed, 0);
  EXPECT_EQ(collider.stats().status & dBatchStatusDeviceFailed, 0u);
}

}  // namespace
}  // namespace ode_ext::test
