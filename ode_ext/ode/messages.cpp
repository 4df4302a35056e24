// SPDX-License-Identifier: BSD-3-Clause
#include "ode/messages.h"

#include <ode/ode.h>

#include <atomic>
#include <cstdlib>
#include <stdexcept>
#include <utility>
#include <vector>

#include "collide/own_work.h"
#include "ode/thread_state.h"

namespace ode_ext {
namespace {

struct LastError {
  std::string message;
};
std::string& this_threads_error() { return of_this_thread<LastError>().message; }

struct Waiting {
  int holders = 0;
  std::vector<std::string> messages;
};
Waiting& waiting() { return of_this_thread<Waiting>(); }

std::atomic<LogLevel> level_in_force{LogLevel::kWarning};

// A handler writes, where a thread can be cancelled, and the library's frames are around it.
void say(const std::string& message) {
  const NotCancelled not_cancelled;
  dMessage(0, "ode_ext: %s", message.c_str());
}

}  // namespace

void set_last_error(const std::string& message) { this_threads_error() = message; }

const char* last_error() { return this_threads_error().c_str(); }

LogLevel log_level_of_environment() {
  const char* value = std::getenv("ODE_EXT_LOG");
  if (value == nullptr || *value == '\0') return LogLevel::kWarning;
  const std::string name = value;
  if (name == "off") return LogLevel::kOff;
  if (name == "error") return LogLevel::kError;
  if (name == "warning") return LogLevel::kWarning;
  if (name == "info") return LogLevel::kInfo;
  throw std::invalid_argument("ODE_EXT_LOG is '" + name +
                              "'; it takes off, error, warning or info");
}

void set_log_level(LogLevel level) { level_in_force = level; }

void log(LogLevel level, const std::string& message) {
  if (level > level_in_force.load()) return;
  if (waiting().holders != 0)
    waiting().messages.push_back(message);
  else
    say(message);
}

void say_that_a_fork_lost_the_device() {
  static std::atomic<bool> said{false};
  if (said.exchange(true)) return;
  const std::string message =
      "this process was forked from one that had used OpenCL, and its driver does not work here: "
      "ODE's own collider answers. Fork before the first call that looks at devices, or call exec "
      "in the child.";
  set_last_error(message);
  log(LogLevel::kError, message);
}

HeldMessages::HeldMessages() { ++waiting().holders; }

HeldMessages::~HeldMessages() {
  if (--waiting().holders != 0 || waiting().messages.empty()) return;
  // Taken out first: the handler may call what logs again.
  const std::vector<std::string> messages = std::exchange(waiting().messages, {});
  for (const std::string& message : messages) {
    try {
      say(message);
    } catch (...) {  // the program's handler threw; nothing may be thrown from here
    }
  }
}

}  // namespace ode_ext
