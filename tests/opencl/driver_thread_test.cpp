// SPDX-License-Identifier: BSD-3-Clause
#include "opencl/driver_thread.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "support/sanitizers.h"

namespace ode_ext::test {
namespace {

TEST(DriverThread, IsAnotherAndBlocksSignalsThatAreSent) {
  const auto caller = std::this_thread::get_id();
  const bool blocks = from_driver_thread([&] {
    EXPECT_NE(std::this_thread::get_id(), caller);
    sigset_t mask;
    pthread_sigmask(SIG_BLOCK, nullptr, &mask);
    return sigismember(&mask, SIGTERM) == 1 && sigismember(&mask, SIGSEGV) == 0;
  });
  EXPECT_TRUE(blocks);
  sigset_t mask;
  pthread_sigmask(SIG_BLOCK, nullptr, &mask);
  EXPECT_EQ(sigismember(&mask, SIGTERM), 0);
}

TEST(DriverThread, IsTheSameForACallWithinACall) {
  run_in_driver_thread([] {
    const auto outer = std::this_thread::get_id();
    EXPECT_EQ(from_driver_thread([] { return std::this_thread::get_id(); }), outer);
  });
}

TEST(DriverThread, ThrowsWhatTheCallThrows) {
  EXPECT_THROW(run_in_driver_thread([] { throw std::out_of_range("far"); }), std::out_of_range);
  EXPECT_EQ(from_driver_thread([] { return 7; }), 7);
}

volatile std::sig_atomic_t children = 0;
void count_child(int) { children = children + 1; }

// Of children that end meanwhile it hears afterwards.
TEST(DriverThread, CallsAHandlerOfChildrenOnceItIsDone) {
  children = 0;
  struct sigaction own {
  }, before{};
  own.sa_handler = &count_child;
  sigaction(SIGCHLD, &own, &before);
  run_in_driver_thread([] {
    struct sigaction now {};
    sigaction(SIGCHLD, nullptr, &now);
    EXPECT_EQ(now.sa_handler, SIG_DFL);
  });
  struct sigaction after {};
  sigaction(SIGCHLD, &before, &after);
  EXPECT_EQ(after.sa_handler, &count_child);
  EXPECT_EQ(children, 1);
}

#if ODE_EXT_ADDRESS_SANITIZER == 0 && ODE_EXT_THREAD_SANITIZER == 0  // whose memory has no bounds
// In a process of its own: its memory is limited to what it has and half of the stack.
TEST(DriverThreadDeathTest, IsTheCallersWhereNoThreadCanBeHad) {
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(
      {
        std::ifstream statm("/proc/self/statm");
        rlim_t pages = 0;
        statm >> pages;
        const rlim_t room = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + (4u << 20);
        rlimit limit;
        limit.rlim_cur = limit.rlim_max = room;
        setrlimit(RLIMIT_AS, &limit);
        const auto caller = std::this_thread::get_id();
        const bool is_here = from_driver_thread([&] {
          return from_driver_thread([] { return std::this_thread::get_id(); }) == caller;
        });
        std::_Exit(is_here ? 0 : 1);
      },
      ::testing::ExitedWithCode(0), "");
}
#endif

}  // namespace
}  // namespace ode_ext::test
