// SPDX-License-Identifier: BSD-3-Clause
// What the library says: the last error of each thread, and a log through ODE's message handler.
#pragma once

#include <string>

namespace ode_ext {

// Per thread; read by dBatchColliderGetLastErrorMessage.
void set_last_error(const std::string& message);
const char* last_error();

enum class LogLevel { kOff, kError, kWarning, kInfo };

// From ODE_EXT_LOG (off, error, warning, info); kWarning if unset. Anything else throws
// std::invalid_argument with a sentence.
LogLevel log_level_of_environment();
void set_log_level(LogLevel level);

// Through dMessage, so that a program's own dSetMessageHandler sees it.
void log(LogLevel level, const std::string& message);

// Once a process.
void say_that_a_fork_lost_the_device();

// While one lives, what its thread logs waits. A program's message handler is code of the program,
// which never runs under a lock of ours: one of these stands before each lock.
class HeldMessages {
 public:
  HeldMessages();
  ~HeldMessages();  // says what waited, unless another one lives on this thread
  HeldMessages(const HeldMessages&) = delete;
  HeldMessages& operator=(const HeldMessages&) = delete;
};

}  // namespace ode_ext
