// SPDX-License-Identifier: BSD-3-Clause
#include "ode/thread_state.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>

namespace ode_ext::test {
namespace {

struct Words {
  std::string text;
};
std::string asked_late;

// Made before the state of its thread, so it goes after it.
struct AsksLate {
  ~AsksLate() {
    of_this_thread<Words>().text += " gone";  // which needs no heap
    asked_late = of_this_thread<Words>().text;
  }
};

TEST(ThreadState, IsOfEachThreadAlone) {
  of_this_thread<Words>().text = "mine";
  std::thread([] { EXPECT_EQ(of_this_thread<Words>().text, ""); }).join();
  EXPECT_EQ(of_this_thread<Words>().text, "mine");
  of_this_thread<Words>().text.clear();
}

TEST(ThreadState, CanBeAskedForWhenItIsGone) {
  std::thread([] {
    thread_local AsksLate late;
    static_cast<void>(&late);
    of_this_thread<Words>().text = "what was said before, and is on the heap, being so long";
  }).join();
  EXPECT_EQ(asked_late, " gone");
}

}  // namespace
}  // namespace ode_ext::test
