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

}  // namespace ode_ext
