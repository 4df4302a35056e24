// SPDX-License-Identifier: BSD-3-Clause
#include "opencl/fork_guard.h"

#include <pthread.h>

#include <atomic>

namespace ode_ext {
namespace {

std::atomic<bool> is_lost{false};

}  // namespace

void note_opencl_is_used() {
  // If it cannot be registered, for want of memory, a child is as badly off as without.
  [[maybe_unused]] static const int registered =
      pthread_atfork(nullptr, nullptr, [] { is_lost = true; });
}

bool is_lost_by_fork() { return is_lost.load(std::memory_order_relaxed); }

}  // namespace ode_ext
