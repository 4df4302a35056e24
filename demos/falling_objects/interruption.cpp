// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/interruption.h"

#include <cstddef>
#include <iterator>
#include <tuple>

namespace falling_objects {
namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

volatile std::sig_atomic_t noted = 0;

// That a terminal is closed both the shell and the kernel say.
void note(int signal) {
  noted = signal;
  for (const int any : kSignals) std::signal(any, any == SIGHUP ? SIG_IGN : SIG_DFL);
}

}  // namespace

Interruption::Interruption() {
  noted = 0;
  struct sigaction action {};
  action.sa_handler = &note;
  action.sa_flags = SA_RESTART;
  static_assert(std::size(kSignals) == std::tuple_size_v<decltype(before_)>);
  for (std::size_t i = 0; i < before_.size(); ++i) {
    sigaction(kSignals[i], nullptr, &before_[i]);
    // A shell's background jobs ignore Ctrl-C, and those of nohup a hang-up, and go on doing so.
    if (before_[i].sa_handler != SIG_IGN) sigaction(kSignals[i], &action, nullptr);
  }
}

Interruption::~Interruption() {
  for (std::size_t i = 0; i < before_.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
}

int Interruption::signal() const { return noted; }

}  // namespace falling_objects
