// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/waiting.h"

#include <chrono>
#include <cstdio>
#include <utility>

namespace falling_objects {

Waiting::Waiting(bool quiet, std::string for_what) {
  if (quiet) return;
  teller_ = std::thread([this, what = std::move(for_what)] {
    std::unique_lock lock(mutex_);
    if (!ended_.wait_for(lock, std::chrono::seconds(2), [this] { return is_over_; }))
      std::fprintf(stderr, "%s\n", what.c_str());
  });
}

Waiting::~Waiting() {
  if (!teller_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  ended_.notify_one();
  teller_.join();
}

}  // namespace falling_objects
