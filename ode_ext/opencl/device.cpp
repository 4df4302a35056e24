// SPDX-License-Identifier: BSD-3-Clause
#include "opencl/device.h"

#include <algorithm>

namespace ode_ext {

Device::Device(const std::string& selection, std::uint64_t largest_buffer, bool may_share)
    : info_(choose_device(selection)),
      label_(info_.name + " (driver " + info_.driver + ", " + info_.platform_name + ")") {
  if (largest_buffer != 0)
    info_.largest_buffer = std::min<cl_ulong>(info_.largest_buffer, largest_buffer);
  info_.shares_memory &= may_share;
  const cl_context_properties properties[] = {
      CL_CONTEXT_PLATFORM, reinterpret_cast<cl_context_properties>(info_.platform), 0};
  cl_int code = CL_SUCCESS;
  context_.reset(clCreateContext(properties, 1, &info_.id, nullptr, nullptr, &code));
  check(code, "clCreateContext", label_);
  // In order: each step of the pipeline needs what the step before it wrote.
  queue_.reset(clCreateCommandQueue(context_.get(), info_.id, CL_QUEUE_PROFILING_ENABLE, &code));
  check(code, "clCreateCommandQueue", label_);
}

Device::~Device() { settle(); }

void Device::settle() noexcept { idle_ = clFinish(queue_.get()) == CL_SUCCESS; }

void Device::finish() {
  ++synchronizations_;
  check_call(clFinish(queue_.get()), "clFinish");
  idle_ = true;
}

}  // namespace ode_ext
