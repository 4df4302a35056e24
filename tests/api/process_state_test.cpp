// SPDX-License-Identifier: BSD-3-Clause
// What of a process is the program's, and stays so: what it does with signals, which of its threads
// take them, its arithmetic, and that its threads can be ended. Each in a process of its own, in
// which no driver has been loaded before.
#include <pthread.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cfenv>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <limits>
#include <thread>
#include <vector>

#include "support/batch_collider.h"
#include "support/sanitizers.h"
#include "support/temporary_folder.h"

namespace ode_ext::test {
namespace {

// In the process of a death test: what is not so is said, and ends it.
void demand(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "not so: %s\n", what);
  std::_Exit(1);
}

// A cube in the top of another.
struct Scene {
  OdeWorld world;
  const OdeMesh& cube = world.mesh(make_cube(1));
  dSpaceID space = world.space(SpaceKind::Simple);
  dGeomID lower = world.geom(cube, {}, space);
  dGeomID upper = world.geom(cube, at(0.1, 0.2, 0.9), space);
};

volatile std::sig_atomic_t taken = 0;
void take(int) { taken = taken + 1; }

constexpr std::array kSignals = {SIGHUP,  SIGINT,  SIGQUIT, SIGILL,  SIGTRAP, SIGABRT,
                                 SIGBUS,  SIGFPE,  SIGUSR1, SIGSEGV, SIGUSR2, SIGPIPE,
                                 SIGALRM, SIGTERM, SIGXCPU, SIGXFSZ, SIGSYS};

class ProcessStateDeathTest : public ::testing::Test {
 protected:
  ProcessStateDeathTest() { ::testing::FLAGS_gtest_death_test_style = "threadsafe"; }
};

// In a process of its own.
template <class Body>
void expect_success(Body body) {
  EXPECT_EXIT(
      {
        body();
        std::_Exit(0);
      },
      ::testing::ExitedWithCode(0), "");
}

TEST_F(ProcessStateDeathTest, SignalsHaveTheHandlersOfTheProgramAfterCreationAndPasses) {
  expect_success([] {
    for (const int signal : kSignals) {
      struct sigaction own {};
      own.sa_handler = &take;
      own.sa_flags = SA_RESTART;
      sigaction(signal, &own, nullptr);
    }
    const Scene scene;
    const BatchCollider collider;
    collider.pass(scene.space);
    for (const int signal : kSignals) {
      struct sigaction now {};
      sigaction(signal, nullptr, &now);
      demand(now.sa_handler == &take && (now.sa_flags & SA_RESTART) != 0, strsignal(signal));
    }
    kill(getpid(), SIGUSR1);
    demand(taken == 1, "a signal that is sent is taken");
  });
}

TEST_F(ProcessStateDeathTest, SignalsThatTheProgramBlocksReachNoThreadOfTheDriver) {
  expect_success([] {
    const OdeWorld world;
    const BatchCollider collider;
    sigset_t blocked;
    sigemptyset(&blocked);
    sigaddset(&blocked, SIGUSR1);
    pthread_sigmask(SIG_BLOCK, &blocked, nullptr);
    kill(getpid(), SIGUSR1);
    const timespec limit = {5, 0};
    demand(sigtimedwait(&blocked, nullptr, &limit) == SIGUSR1, "the signal waits for the program");
  });
}

TEST_F(ProcessStateDeathTest, KernelsAreBuiltWhereChildrenAreNotWaitedFor) {
  expect_success([] {
    const TemporaryFolder cache("cache_of_a_daemon");
    setenv("POCL_CACHE_DIR", cache.path().c_str(), 1);
    std::signal(SIGCHLD, SIG_IGN);
    const Scene scene;
    const BatchCollider collider;
    demand(!collider.pass(scene.space).contacts.empty(), "there are contacts");
    struct sigaction now {};
    sigaction(SIGCHLD, nullptr, &now);
    demand(now.sa_handler == SIG_IGN, "SIGCHLD is ignored as before");
  });
}

// A thread that is cancelled ends after what it has called, and what it leaves can be used.
TEST_F(ProcessStateDeathTest, AThreadThatMakesPassesCanBeCancelled) {
  expect_success([] {
    alarm(60);  // a process that hangs ends by it
    Scene scene;
    const BatchCollider collider;
    for (int i = 0; i < 20; ++i) {
      std::atomic<int> passes{0};
      std::thread passing([&] {
        dAllocateODEDataForThread(dAllocateMaskAll);
        for (;;) {
          dGeomSetPosition(scene.upper, 0.1, 0.2, 0.9 + 1e-5 * (passes % 100));
          collider.pass(scene.space);
          ++passes;
          pthread_testcancel();
        }
      });
      while (passes < 3) std::this_thread::yield();
      pthread_cancel(passing.native_handle());
      passing.join();
      demand(!collider.pass(scene.space).contacts.empty(), "another thread passes afterwards");
    }
  });
}

// The message is written, where a thread could be cancelled, with the library's frames around it.
TEST_F(ProcessStateDeathTest, AThreadIsCancelledAfterACallThatHasSomethingToSay) {
  expect_success([] {
    alarm(60);
    Scene scene;
    TestMesh broken = make_cube(1);
    broken.vertices[4] = std::numeric_limits<float>::quiet_NaN();
    scene.world.geom(scene.world.mesh(broken), {}, scene.space);
    const BatchCollider collider;
    bool has_passed = false, goes_on = false;
    std::thread passing([&] {
      dAllocateODEDataForThread(dAllocateMaskAll);
      pthread_cancel(pthread_self());
      Collected collected;
      dBatchColliderSpaceCollide(collider, scene.space, &collected, &collect);
      has_passed = true;
      pthread_testcancel();
      goes_on = true;
    });
    passing.join();
    demand((collider.stats().status & dBatchStatusMeshRefused) != 0, "there is something to say");
    demand(has_passed && !goes_on, "it is cancelled after the call");
  });
}

int end_thread(dGeomID, int, int) { pthread_exit(nullptr); }

TEST_F(ProcessStateDeathTest, AMergeCallbackCanEndItsThread) {
  expect_success([] {
    alarm(60);
    Scene scene;
    const BatchCollider collider;
    dGeomTriMeshSetTriMergeCallback(scene.upper, &end_thread);
    bool is_ended_by_itself = false;
    std::thread asking([&] {
      dAllocateODEDataForThread(dAllocateMaskAll);
      answer_of(collider, scene.upper, scene.lower);
      is_ended_by_itself = true;
    });
    asking.join();
    demand(!is_ended_by_itself, "the callback ended it");
    dGeomTriMeshSetTriMergeCallback(scene.upper, nullptr);
    demand(!collider.pass(scene.space).contacts.empty(), "another thread passes afterwards");
  });
}

// What traps in a program is not what the library divides by 0 on purpose, before creation or
// after; nor does it count how a program rounds. It has its arithmetic back afterwards.
void expect_the_same_contacts_by(void (*choose)(), bool before_creation) {
  Scene scene;
  std::vector<Point> places;  // by one arithmetic for both
  for (int i = 0; i < 50; ++i) places.push_back({0.02 * i - 0.5, 0.3, 0.9 + 1e-3 * i});
  const auto moved = [&](const BatchCollider& collider) {
    std::vector<Contacts> found;
    for (const Point& place : places) {
      dGeomSetPosition(scene.upper, place[0], place[1], place[2]);
      collider.pass(scene.space);
      found.push_back(answer_of(collider, scene.upper, scene.lower));
    }
    return found;
  };
  const std::vector<Contacts> right = moved(BatchCollider());
  if (before_creation) choose();
  const BatchCollider collider;
  if (!before_creation) choose();
  const int traps = fegetexcept(), rounding = std::fegetround();
  const std::vector<Contacts> found = moved(collider);
  demand(fegetexcept() == traps && std::fegetround() == rounding,
         "the program's arithmetic is back");
  fedisableexcept(FE_ALL_EXCEPT);
  std::fesetround(FE_TONEAREST);
  demand(found.size() == right.size() && !found.empty(), "as many answers");
  for (std::size_t i = 0; i < found.size(); ++i)
    demand(difference(found[i], right[i]).empty(), "the same contacts");
}

void trap() { feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW); }
void round_up() { std::fesetround(FE_UPWARD); }

TEST_F(ProcessStateDeathTest, TrapsThatWereThereBeforeCreationAreOfTheProgramAlone) {
  expect_success([] { expect_the_same_contacts_by(&trap, true); });
}

TEST_F(ProcessStateDeathTest, TrapsThatCameAfterCreationAreOfTheProgramAlone) {
  expect_success([] { expect_the_same_contacts_by(&trap, false); });
}

TEST_F(ProcessStateDeathTest, HowAProgramRoundsChangesNoContact) {
  expect_success([] { expect_the_same_contacts_by(&round_up, true); });
}

#if ODE_EXT_ADDRESS_SANITIZER == 0 && ODE_EXT_THREAD_SANITIZER == 0  // they need more stack
void* create_a_collider(void*) {
  static_cast<void>(BatchCollider());
  return nullptr;
}

TEST_F(ProcessStateDeathTest, AColliderIsCreatedOnAThreadOfASmallStack) {
  expect_success([] {
    const OdeWorld world;
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    demand(pthread_attr_setstacksize(&attributes, 64 << 10) == 0, "a stack of 64 KiB");
    pthread_t thread;
    demand(pthread_create(&thread, &attributes, &create_a_collider, nullptr) == 0, "a thread");
    pthread_join(thread, nullptr);
  });
}
#endif

}  // namespace
}  // namespace ode_ext::test
