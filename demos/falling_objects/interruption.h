// SPDX-License-Identifier: BSD-3-Clause
// Ctrl-C, or a terminal that is closed: a run ends after the step that it is in, and writes what
// there is.
#pragma once

#include <array>
#include <csignal>

namespace falling_objects {

// As long as one lives, SIGINT, SIGTERM and SIGHUP are noted. After any of them SIGINT and SIGTERM
// end the program at once, and SIGHUP is ignored.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  int signal() const;  // that came, or 0

 private:
  std::array<struct sigaction, 3> before_;
};

}  // namespace falling_objects
