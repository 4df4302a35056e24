// SPDX-License-Identifier: BSD-3-Clause
// Says on stderr what a program waits for, where that takes longer than two seconds.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace falling_objects {

// From its construction to its destruction. Quiet: it says nothing.
class Waiting {
 public:
  Waiting(bool quiet, std::string for_what);
  ~Waiting();
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable ended_;
  bool is_over_ = false;
  std::thread teller_;
};

}  // namespace falling_objects
