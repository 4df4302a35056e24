// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

namespace falling_objects {

// The user asked for what cannot be; what() says what to do.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace falling_objects
