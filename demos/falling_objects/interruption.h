// SPDX-License-Identifier: BSD-3-Clause
// Ctrl-C: a run ends after the step that it is in, and writes what there is.
#pragma once

#include <csignal>

namespace falling_objects {

// As long as one lives, SIGINT and SIGTERM are noted. A second one ends the program at once.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  int signal() const;  // that came, or 0

 private:
  struct sigaction before_[2];
};

}  // namespace falling_objects
