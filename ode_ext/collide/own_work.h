// SPDX-License-Identifier: BSD-3-Clause
// What the library does on a thread of the program's, under its lock, where no code of the
// program's runs.
#pragma once

#include <cfenv>
#include <mutex>

#include "opencl/not_cancelled.h"

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

namespace ode_ext {

// The arithmetic that a process starts with: rounded to the nearest, nothing traps, nothing is
// flushed to zero. A program may have chosen another (feenableexcept, fesetround), and gets it
// back.
class DefaultArithmetic {
 public:
  DefaultArithmetic() : is_in_force_(is_in_force()) {
    if (is_in_force_) return;
    std::fegetenv(&before_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~DefaultArithmetic() {
    if (!is_in_force_) std::fesetenv(&before_);
  }
  DefaultArithmetic(const DefaultArithmetic&) = delete;
  DefaultArithmetic& operator=(const DefaultArithmetic&) = delete;

 private:
  // Asked at every dCollide. To save and set all of it takes long on x86, where one register tells;
  // its low six bits are flags that operations leave behind.
  static bool is_in_force() {
#ifdef __SSE2__
    return (_mm_getcsr() & 0xffc0u) == 0x1f80u;
#else
    return false;
#endif
  }

  const bool is_in_force_;
  std::fenv_t before_{};
};

class OwnWork {
 public:
  explicit OwnWork(std::mutex& mutex) : lock_(mutex) {}

 private:
  const NotCancelled not_cancelled_;  // first: a lock that is waited for is to be let go again
  const std::lock_guard<std::mutex> lock_;
  const DefaultArithmetic arithmetic_;
};

}  // namespace ode_ext
