// SPDX-License-Identifier: BSD-3-Clause
// What a capture leaves alone. That it can be replayed is tested with ode_ext-replay. The file is
// opened once a process, so each test has one.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "support/batch_collider.h"
#include "support/path_for_a_death.h"

namespace ode_ext::test {
namespace {

class ApiCaptureDeathTest : public testing::Test {
 protected:
  ApiCaptureDeathTest() { ::testing::FLAGS_gtest_death_test_style = "threadsafe"; }
};

// Exits with 0 if both colliders answer, and neither is taken to have failed.
void capture_begun_with_the_second(const std::string& path) {
  bool well = true;
  {
    OdeWorld world;
    const dSpaceID space = world.space(SpaceKind::Simple);
    const Pile pile(world, space, 5, 1);
    const BatchCollider first;
    setenv("ODE_EXT_CAPTURE", path.c_str(), 1);
    const BatchCollider second;
    for (const BatchCollider* collider : {&first, &second}) {
      collider->pass(space);
      const PassStatistics stats = collider->stats();
      well = well && stats.pairs_computed > 0 && (stats.status & dBatchStatusDeviceFailed) == 0;
    }
  }
  std::exit(well ? 0 : 1);
}

TEST_F(ApiCaptureDeathTest, OfALaterColliderLeavesTheEarlierOneAlone) {
  const PathForADeath path("ode_ext_capture_test");
  EXPECT_EXIT(capture_begun_with_the_second(path.name()), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace ode_ext::test
