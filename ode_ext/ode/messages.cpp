// SPDX-License-Identifier: BSD-3-Clause
#include "ode/messages.h"

#include <ode/ode.h>

#include <atomic>
#include <cstdlib>
#include <stdexcept>

namespace ode_ext {
namespace {

std::string& this_threads_error() {
  thread_local std::string message;
  return message;
}

std::atomic<LogLevel> level_in_force{LogLevel::kWarning};

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
  dMessage(0, "ode_ext: %s", message.c_str());
}

}  // namespace ode_ext
