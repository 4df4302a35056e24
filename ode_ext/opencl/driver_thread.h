// SPDX-License-Identifier: BSD-3-Clause
// Where drivers are loaded and kernels built. A driver takes for its own what is the program's:
// PoCL and the compiler in it set handlers for fifteen signals and another stack for these, wait
// for children (the linker), start threads that take the signals which the thread that starts them
// lets in and go on by its arithmetic, and need 128 KiB of stack. So they get a thread of their
// own, as a process has it that does nothing else, and what they set of the process is as it was
// afterwards.
#pragma once

#include <functional>
#include <optional>
#include <utility>

namespace ode_ext {

// Calls it there and waits; what it throws is thrown here. One call at a time, others wait; one
// within another is made where it is. No code of the program's may run in it. Where no thread can
// be had it is called here.
// While it runs a signal may find the driver's handler, what another thread does with signals is
// undone afterwards, and SIGCHLD has its default: a handler of the program's is called once after
// it, and where it is ignored a child that ends meanwhile stays until the process does.
void run_in_driver_thread(const std::function<void()>& call);

// Likewise, with what it returns.
template <class Call>
auto from_driver_thread(Call call) {
  std::optional<decltype(call())> result;
  run_in_driver_thread([&] { result.emplace(call()); });
  return std::move(*result);
}

}  // namespace ode_ext
