// SPDX-License-Identifier: BSD-3-Clause
#include <cstring>
#include <utility>

#include "opencl/error.h"
#include "opencl/program.h"

namespace ode_ext {
namespace {

double duration(const EventHandle& event, Device& device) {
  cl_ulong start = 0, end = 0;  // [ns]
  device.check_call(clGetEventProfilingInfo(event.get(), CL_PROFILING_COMMAND_START, sizeof(start),
                                            &start, nullptr),
                    "clGetEventProfilingInfo");
  device.check_call(
      clGetEventProfilingInfo(event.get(), CL_PROFILING_COMMAND_END, sizeof(end), &end, nullptr),
      "clGetEventProfilingInfo");
  return 1e-6 * static_cast<double>(end - start);
}

}  // namespace

Kernel::Kernel(Program& program, const char* name) : device_(&program.device()), name_(name) {
  cl_int code = CL_SUCCESS;
  kernel_.reset(clCreateKernel(program.get(), name, &code));
  device_->check_call(code, "clCreateKernel", [&] { return "Kernel: " + name_ + "."; });
}

void Kernel::set_argument_bytes(cl_uint index, std::size_t bytes, const void* value,
                                std::uint64_t buffer) {
  if (index >= arguments_.size()) arguments_.resize(index + 1);
  Argument& known = arguments_[index];
  if (bytes == known.bytes && buffer == known.buffer &&
      std::memcmp(known.value.data(), value, bytes) == 0)
    return;
  known.bytes = 0;
  device_->check_call(clSetKernelArg(kernel_.get(), index, bytes, value), "clSetKernelArg", [&] {
    return "Kernel: " + name_ + ", argument " + std::to_string(index) + " of " +
           std::to_string(bytes) + " bytes.";
  });
  if (bytes > known.value.size()) return;
  known.buffer = buffer;
  known.bytes = bytes;
  std::memcpy(known.value.data(), value, bytes);
}

void Kernel::enqueue(std::size_t groups, std::size_t local) {
  if (groups == 0) return;  // OpenCL 1.2 knows no empty launch
  if (events_.size() == events_.capacity()) add_up_finished();
  const std::size_t global = groups * local;
  cl_event event = nullptr;
  const int code = clEnqueueNDRangeKernel(device_->queue(), kernel_.get(), 1, nullptr, &global,
                                          &local, 0, nullptr, &event);
  EventHandle owned(event);
  device_->check_call(code, "clEnqueueNDRangeKernel", [&] {
    return "Kernel: " + name_ + ", " + std::to_string(groups) + " groups of " +
           std::to_string(local) + ".";
  });
  events_.push_back(std::move(owned));
}

void Kernel::add_up_finished() {
  double sum = 0;
  auto event = events_.begin();
  for (; event != events_.end(); ++event) {
    cl_int status = CL_QUEUED;
    device_->check_call(clGetEventInfo(event->get(), CL_EVENT_COMMAND_EXECUTION_STATUS,
                                       sizeof(status), &status, nullptr),
                        "clGetEventInfo");
    if (status != CL_COMPLETE) break;  // the queue is in order: neither are those behind it
    try {
      sum += duration(*event, *device_);
    } catch (const DeviceError&) {  // for take_milliseconds: a clock must not cost a launch
      clock_failure_ = std::current_exception();
    }
  }
  events_.erase(events_.begin(), event);
  milliseconds_ += sum;
}

double Kernel::take_milliseconds() {
  double sum = std::exchange(milliseconds_, 0);
  try {
    if (clock_failure_) std::rethrow_exception(std::exchange(clock_failure_, nullptr));
    for (const EventHandle& event : events_) sum += duration(event, *device_);
  } catch (...) {  // an event without times must not stay to spoil the next call
    events_.clear();
    throw;
  }
  events_.clear();  // keeps its memory: a batch like the last one allocates nothing here
  return sum;
}

}  // namespace ode_ext
