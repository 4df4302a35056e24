// SPDX-License-Identifier: BSD-3-Clause
// What is kept of spaces that come and go.
#include "ode/space_memories.h"
#include "opencl/program.h"
#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

PassRoot root(std::uintptr_t number) { return {reinterpret_cast<dGeomID>(number), nullptr}; }

class ApiSpaces : public ::testing::Test {
 protected:
  PassMemory& use(std::uintptr_t space, std::uint64_t pass, bool familiar = true) {
    PassMemory& memory = memories.of(root(space), pass, familiar, {});
    if (memory.temporal == nullptr) memory.temporal = std::make_unique<TemporalCache>(device);
    memory.history.pairs = 1;
    return memory;
  }

  Device device{""};
  SpaceMemories memories;
};

constexpr std::size_t kPlenty = std::size_t{1} << 40;

TEST_F(ApiSpaces, OneForEachPassKeepNoMoreThanTheLastFew) {
  std::size_t after_100 = 0;
  for (std::uint64_t pass = 1; pass <= 2000; ++pass) {
    use(pass, pass);
    memories.prune(pass, kPlenty);
    if (pass == 100) after_100 = memories.temporal_bytes();
  }
  EXPECT_GT(after_100, 0u);
  EXPECT_LE(memories.temporal_bytes(), after_100);
  EXPECT_LE(memories.size(), 1026u);
}

TEST_F(ApiSpaces, CollidedInTurnKeepTheirs) {
  for (std::uint64_t pass = 1; pass <= 200; ++pass) {
    if (pass > 20) {
      EXPECT_NE(memories.of(root(pass % 20), pass, true, {}).temporal, nullptr);
    }
    use(pass % 20, pass);
    memories.prune(pass, kPlenty);
  }
}

TEST_F(ApiSpaces, GiveUpTheLongestUnusedBeyondTheMemoryThatThereIs) {
  for (std::uint64_t pass = 1; pass <= 10; ++pass) use(pass, pass);
  const std::size_t each = memories.temporal_bytes() / 10;
  memories.prune(10, 3 * each);
  EXPECT_EQ(memories.temporal_bytes(), 3 * each);
  EXPECT_EQ(memories.of(root(7), 10, true, {}).temporal, nullptr);
  EXPECT_NE(memories.of(root(8), 10, true, {}).temporal, nullptr);
  memories.prune(11, 0);
  EXPECT_EQ(memories.temporal_bytes(), 0u);
  EXPECT_EQ(memories.of(root(8), 11, true, {}).history.pairs, 1u) << "which takes no device memory";
}

TEST_F(ApiSpaces, OfThePassThatRunsKeepTheirsWhateverItTakes) {
  use(1, 5);
  memories.prune(5, 0);
  EXPECT_GT(memories.temporal_bytes(), 0u);
}

TEST_F(ApiSpaces, AtAnAddressUsedAgainInheritNothing) {
  use(1, 5);
  const PassMemory& memory = memories.of(root(1), 6, false, {});
  EXPECT_EQ(memory.temporal, nullptr);
  EXPECT_EQ(memory.history.pairs, 0u);
}

// Twenty worlds of one collider: between two passes of a space all its answers are forgotten.
TEST_F(ApiSpaces, AreKnownAgainByPairsThatTheyHadWhenAnswersAreForgotten) {
  const auto pair = [](std::uintptr_t a, std::uintptr_t b) {
    GatheredPair made;
    made.first.geom = reinterpret_cast<dGeomID>(a);
    made.second.geom = reinterpret_cast<dGeomID>(b);
    return made;
  };
  const std::vector<GatheredPair> own{pair(8, 16), pair(8, 24), pair(16, 24)};
  const std::vector<GatheredPair> others{pair(8, 32), pair(40, 16)};
  memories.of(root(1), 5, true, own).history.pairs = 3;
  EXPECT_EQ(memories.of(root(1), 25, false, own).history.pairs, 3u);
  EXPECT_EQ(memories.of(root(1), 26, false, others).history.pairs, 0u);
}

}  // namespace
}  // namespace ode_ext::test
