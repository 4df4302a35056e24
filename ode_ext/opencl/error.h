// SPDX-License-Identifier: BSD-3-Clause
// OpenCL errors as exceptions whose message a user can act on.
#pragma once

#include <stdexcept>
#include <string>

#include "opencl/opencl.h"

namespace ode_ext {

class DeviceError : public std::runtime_error {
 public:
  DeviceError(int code, const std::string& message) : std::runtime_error(message), code_(code) {}
  int code() const { return code_; }  // CL_... ; 0 where no OpenCL call failed

 private:
  int code_;
};

// Codes that say "too large", of which less at a time may be the cure.
bool is_out_of_memory(int code);
// Whether it says that what is asked for has no room. CL_OUT_OF_RESOURCES may say so, or that a
// kernel crashed.
bool is_no_room(int code);

const char* opencl_error_name(int code);  // "CL_OUT_OF_RESOURCES"; never null

// Every OpenCL call of this room that can fail goes through here, but for those of destructors, so
// that the fault injector sees it. `code` is what the call returned; throws DeviceError naming
// `call`, the code, `device` (may be ""; best Device::label(), which names the driver too) and what
// to try.
void check(int code, const char* call, const std::string& device);

// The same, with `describe()` appended to the message. It runs only if the call failed, so that the
// calls of every pass put no text together.
template <class Describe>
void check(int code, const char* call, const std::string& device, const Describe& describe) {
  try {
    check(code, call, device);
  } catch (const DeviceError& error) {
    const std::string more = describe();
    throw DeviceError(error.code(), error.what() + (more.empty() ? "" : " " + more));
  }
}

// For tests: the nth following checked call (1 = the next) is treated as having returned `code`.
// The call itself was made, so whatever it created has to be given back all the same. The state is
// per process; off by default; `calls_checked` counts since the last arm or disarm.
namespace fault_injector {
void arm(long long nth, int code);
void disarm();
long long calls_checked();
}  // namespace fault_injector

}  // namespace ode_ext
