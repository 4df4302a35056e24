// SPDX-License-Identifier: BSD-3-Clause
#include "opencl/error.h"

#include <atomic>

namespace ode_ext {
namespace {

std::atomic<long long> calls{0};
std::atomic<long long> fail_at{0};  // the call that fails; 0: none
std::atomic<int> injected_code{CL_SUCCESS};

const char* what_to_try(int code) {
  switch (code) {
    case CL_PLATFORM_NOT_FOUND_KHR:
      return "Install pocl-opencl-icd (runs on any CPU) or the OpenCL driver (ICD) of your GPU.";
    case CL_MEM_OBJECT_ALLOCATION_FAILURE:
    case CL_INVALID_BUFFER_SIZE:
    case CL_OUT_OF_HOST_MEMORY:
      return "It is short of memory: ask for fewer contacts, make the scene smaller, or choose "
             "another device with ODE_EXT_DEVICE.";
    case CL_OUT_OF_RESOURCES:
      return "It is short of memory, or a kernel crashed: ask for fewer contacts, make the scene "
             "smaller, or choose another device with ODE_EXT_DEVICE.";
    case CL_DEVICE_NOT_FOUND:
    case CL_DEVICE_NOT_AVAILABLE:
      return "Another program may hold it; choose another device with ODE_EXT_DEVICE.";
    case CL_COMPILER_NOT_AVAILABLE:
    case CL_BUILD_PROGRAM_FAILURE:
      return "Update the driver or choose another device with ODE_EXT_DEVICE, and please report "
             "this message.";
    default:
      return "This is a fault of the library or of the driver: please report this message; another "
             "device (ODE_EXT_DEVICE) may work.";
  }
}

}  // namespace

bool is_out_of_memory(int code) {
  return is_no_room(code) || code == CL_OUT_OF_RESOURCES || code == CL_OUT_OF_HOST_MEMORY;
}

bool is_no_room(int code) {
  return code == CL_MEM_OBJECT_ALLOCATION_FAILURE || code == CL_INVALID_BUFFER_SIZE;
}

const char* opencl_error_name(int code) {
#define ODE_EXT_NAME(error) \
  case error:               \
    return #error
  switch (code) {
    ODE_EXT_NAME(CL_SUCCESS);
    ODE_EXT_NAME(CL_DEVICE_NOT_FOUND);
    ODE_EXT_NAME(CL_DEVICE_NOT_AVAILABLE);
    ODE_EXT_NAME(CL_COMPILER_NOT_AVAILABLE);
    ODE_EXT_NAME(CL_MEM_OBJECT_ALLOCATION_FAILURE);
    ODE_EXT_NAME(CL_OUT_OF_RESOURCES);
    ODE_EXT_NAME(CL_OUT_OF_HOST_MEMORY);
    ODE_EXT_NAME(CL_PROFILING_INFO_NOT_AVAILABLE);
    ODE_EXT_NAME(CL_MEM_COPY_OVERLAP);
    ODE_EXT_NAME(CL_IMAGE_FORMAT_MISMATCH);
    ODE_EXT_NAME(CL_IMAGE_FORMAT_NOT_SUPPORTED);
    ODE_EXT_NAME(CL_BUILD_PROGRAM_FAILURE);
    ODE_EXT_NAME(CL_MAP_FAILURE);
    ODE_EXT_NAME(CL_MISALIGNED_SUB_BUFFER_OFFSET);
    ODE_EXT_NAME(CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST);
    ODE_EXT_NAME(CL_COMPILE_PROGRAM_FAILURE);
    ODE_EXT_NAME(CL_LINKER_NOT_AVAILABLE);
    ODE_EXT_NAME(CL_LINK_PROGRAM_FAILURE);
    ODE_EXT_NAME(CL_DEVICE_PARTITION_FAILED);
    ODE_EXT_NAME(CL_KERNEL_ARG_INFO_NOT_AVAILABLE);
    ODE_EXT_NAME(CL_INVALID_VALUE);
    ODE_EXT_NAME(CL_INVALID_DEVICE_TYPE);
    ODE_EXT_NAME(CL_INVALID_PLATFORM);
    ODE_EXT_NAME(CL_INVALID_DEVICE);
    ODE_EXT_NAME(CL_INVALID_CONTEXT);
    ODE_EXT_NAME(CL_INVALID_QUEUE_PROPERTIES);
    ODE_EXT_NAME(CL_INVALID_COMMAND_QUEUE);
    ODE_EXT_NAME(CL_INVALID_HOST_PTR);
    ODE_EXT_NAME(CL_INVALID_MEM_OBJECT);
    ODE_EXT_NAME(CL_INVALID_IMAGE_FORMAT_DESCRIPTOR);
    ODE_EXT_NAME(CL_INVALID_IMAGE_SIZE);
    ODE_EXT_NAME(CL_INVALID_SAMPLER);
    ODE_EXT_NAME(CL_INVALID_BINARY);
    ODE_EXT_NAME(CL_INVALID_BUILD_OPTIONS);
    ODE_EXT_NAME(CL_INVALID_PROGRAM);
    ODE_EXT_NAME(CL_INVALID_PROGRAM_EXECUTABLE);
    ODE_EXT_NAME(CL_INVALID_KERNEL_NAME);
    ODE_EXT_NAME(CL_INVALID_KERNEL_DEFINITION);
    ODE_EXT_NAME(CL_INVALID_KERNEL);
    ODE_EXT_NAME(CL_INVALID_ARG_INDEX);
    ODE_EXT_NAME(CL_INVALID_ARG_VALUE);
    ODE_EXT_NAME(CL_INVALID_ARG_SIZE);
    ODE_EXT_NAME(CL_INVALID_KERNEL_ARGS);
    ODE_EXT_NAME(CL_INVALID_WORK_DIMENSION);
    ODE_EXT_NAME(CL_INVALID_WORK_GROUP_SIZE);
    ODE_EXT_NAME(CL_INVALID_WORK_ITEM_SIZE);
    ODE_EXT_NAME(CL_INVALID_GLOBAL_OFFSET);
    ODE_EXT_NAME(CL_INVALID_EVENT_WAIT_LIST);
    ODE_EXT_NAME(CL_INVALID_EVENT);
    ODE_EXT_NAME(CL_INVALID_OPERATION);
    ODE_EXT_NAME(CL_INVALID_GL_OBJECT);
    ODE_EXT_NAME(CL_INVALID_BUFFER_SIZE);
    ODE_EXT_NAME(CL_INVALID_MIP_LEVEL);
    ODE_EXT_NAME(CL_INVALID_GLOBAL_WORK_SIZE);
    ODE_EXT_NAME(CL_INVALID_PROPERTY);
    ODE_EXT_NAME(CL_INVALID_IMAGE_DESCRIPTOR);
    ODE_EXT_NAME(CL_INVALID_COMPILER_OPTIONS);
    ODE_EXT_NAME(CL_INVALID_LINKER_OPTIONS);
    ODE_EXT_NAME(CL_INVALID_DEVICE_PARTITION_COUNT);
    ODE_EXT_NAME(CL_PLATFORM_NOT_FOUND_KHR);
    default:
      return "a code OpenCL 1.2 does not know";
  }
#undef ODE_EXT_NAME
}

void check(int code, const char* call, const std::string& device) {
  if (calls.fetch_add(1, std::memory_order_relaxed) + 1 ==
      fail_at.load(std::memory_order_relaxed)) {
    code = injected_code.load(std::memory_order_relaxed);
  }
  if (code == CL_SUCCESS) return;
  throw DeviceError(code, std::string(call) + " failed with " + opencl_error_name(code) + " (" +
                              std::to_string(code) + ")" + (device.empty() ? "" : " on " + device) +
                              ". " + what_to_try(code));
}

namespace fault_injector {

void arm(long long nth, int code) {
  injected_code = code;
  fail_at = nth;
  calls = 0;
}

void disarm() { arm(0, CL_SUCCESS); }

long long calls_checked() { return calls; }

}  // namespace fault_injector
}  // namespace ode_ext
