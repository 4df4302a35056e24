// SPDX-License-Identifier: BSD-3-Clause
// Looks for leaks when the last test has ended, and not at exit as LeakSanitizer does by itself: at
// exit PoCL has already destroyed the static maps that hold the passes of its kernel compiler,
// which it never frees, so that any run that compiles a kernel would report them.

#include <gtest/gtest.h>

#include "support/sanitizers.h"

#if ODE_EXT_ADDRESS_SANITIZER
#include <sanitizer/lsan_interface.h>

namespace ode_ext::test {
namespace {

class LeakCheck : public testing::Environment {
 public:
  // Ends the program if anything leaked. The check at exit does not follow.
  void TearDown() override { __lsan_do_leak_check(); }
};

[[maybe_unused]] testing::Environment* const kLeakCheck =
    testing::AddGlobalTestEnvironment(new LeakCheck);

}  // namespace
}  // namespace ode_ext::test
#endif
