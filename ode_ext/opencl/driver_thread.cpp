// SPDX-License-Identifier: BSD-3-Clause
#include "opencl/driver_thread.h"

#include <pthread.h>
#include <unistd.h>

#include <cfenv>
#include <csignal>
#include <cstddef>
#include <exception>
#include <mutex>
#include <utility>
#include <vector>

#include "opencl/not_cancelled.h"

namespace ode_ext {
namespace {

constexpr std::size_t kStack = 8u << 20;  // what Linux gives the first thread of a process

thread_local bool is_driver_thread = false;

// What the process does with each signal, as it was when this was made.
class Dispositions {
 public:
  Dispositions() {
    for (int signal = 1; signal < NSIG; ++signal) {
      struct sigaction before {};
      // Not of those that the C library keeps for itself.
      if (sigaction(signal, nullptr, &before) == 0) before_.emplace_back(signal, before);
    }
    // A program that ignores the end of children, or waits for any of them, takes that of the
    // linker's from who waits for it.
    sigaction(SIGCHLD, nullptr, &of_children_);
    struct sigaction waits {};
    waits.sa_handler = SIG_DFL;
    sigaction(SIGCHLD, &waits, nullptr);
  }
  ~Dispositions() {
    for (const auto& [signal, before] : before_) {
      struct sigaction now {};
      if (sigaction(signal, nullptr, &now) != 0) continue;
      if (now.sa_handler != before.sa_handler || now.sa_flags != before.sa_flags)
        sigaction(signal, &before, nullptr);
    }
    // Of children of the program's own that ended meanwhile.
    if (of_children_.sa_handler != SIG_IGN && of_children_.sa_handler != SIG_DFL)
      kill(getpid(), SIGCHLD);
  }
  Dispositions(const Dispositions&) = delete;
  Dispositions& operator=(const Dispositions&) = delete;

 private:
  std::vector<std::pair<int, struct sigaction>> before_;  // on no small stack: 10 KiB
  struct sigaction of_children_ {};
};

// Signals are the program's threads', but for those that a thread raises by what it does.
class SignalsBlocked {
 public:
  SignalsBlocked() {
    sigset_t all;
    sigfillset(&all);
    for (const int own : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGABRT, SIGSYS})
      sigdelset(&all, own);
    pthread_sigmask(SIG_BLOCK, &all, &before_);
  }
  ~SignalsBlocked() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;

 private:
  sigset_t before_{};
};

struct Work {
  const std::function<void()>& call;
  std::exception_ptr thrown;
};

// LLVM gives the thread that it is first asked for anything in another stack for signals.
class SignalStack {
 public:
  SignalStack() { sigaltstack(nullptr, &before_); }
  ~SignalStack() { sigaltstack(&before_, nullptr); }
  SignalStack(const SignalStack&) = delete;
  SignalStack& operator=(const SignalStack&) = delete;

 private:
  stack_t before_{};
};

void run_here(Work& work) {
  const SignalStack signal_stack;
  is_driver_thread = true;
  try {
    work.call();
  } catch (...) {
    work.thrown = std::current_exception();
  }
  is_driver_thread = false;
}

void* run(void* work) {
  std::fesetenv(FE_DFL_ENV);
  run_here(*static_cast<Work*>(work));
  return nullptr;
}

bool start(pthread_t& thread, Work& work) {
  const SignalsBlocked blocked;  // as the thread has them, which takes over its starter's
  pthread_attr_t attributes;
  if (pthread_attr_init(&attributes) != 0) return false;
  pthread_attr_setstacksize(&attributes, kStack);
  const bool is_started = pthread_create(&thread, &attributes, &run, &work) == 0;
  pthread_attr_destroy(&attributes);
  return is_started;
}

}  // namespace

void run_in_driver_thread(const std::function<void()>& call) {
  if (is_driver_thread) return call();
  const NotCancelled not_cancelled;
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  const Dispositions dispositions;
  Work work{call, nullptr};
  pthread_t thread{};
  if (start(thread, work))
    pthread_join(thread, nullptr);
  else
    run_here(work);
  if (work.thrown) std::rethrow_exception(work.thrown);
}

}  // namespace ode_ext
