// SPDX-License-Identifier: BSD-3-Clause
// Owners of OpenCL objects. Each call that creates one puts it into its handle before its code is
// checked, so that nothing leaks however a creation fails.
#pragma once

#include <memory>
#include <type_traits>

#include "opencl/opencl.h"

namespace ode_ext {

template <auto release>
struct Releaser {
  template <class T>
  void operator()(T* object) const {
    release(object);  // in destructors: there is nobody to tell if it fails
  }
};

template <class T, auto release>
using Handle = std::unique_ptr<std::remove_pointer_t<T>, Releaser<release>>;

using ContextHandle = Handle<cl_context, clReleaseContext>;
using QueueHandle = Handle<cl_command_queue, clReleaseCommandQueue>;
using MemoryHandle = Handle<cl_mem, clReleaseMemObject>;
using ProgramHandle = Handle<cl_program, clReleaseProgram>;
using KernelHandle = Handle<cl_kernel, clReleaseKernel>;
using EventHandle = Handle<cl_event, clReleaseEvent>;

}  // namespace ode_ext
