// SPDX-License-Identifier: BSD-3-Clause
// An OpenCL device: which one, and the context and in-order profiling queue on it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "opencl/error.h"
#include "opencl/handle.h"
#include "opencl/opencl.h"

namespace ode_ext {

struct DeviceInfo {
  cl_platform_id platform = nullptr;
  cl_device_id id = nullptr;
  cl_device_type type = 0;
  int index = 0;  // among all devices of all platforms, the number ODE_EXT_DEVICE takes
  std::string platform_name, name, vendor, driver, version;
  cl_uint compute_units = 0;
  cl_ulong global_memory = 0;   // [bytes]
  cl_ulong largest_buffer = 0;  // [bytes]
  std::size_t work_group_limit = 0;
  // Whether what is written by one of host and device is there for the other, without transfers
  // (fine-grained shared virtual memory); asked of processors only.
  bool shares_memory = false;
  cl_uint compute_capability = 0;  // NVIDIA's, the number before the point; 0: another's
  bool rounds_quotients = false;   // quotients and roots of floats too, where it is asked to
  cl_uint vector_width = 1;        // floats that an operation takes at once; 1 on most GPUs
  bool available = true, has_compiler = true, little_endian = true;
};

// All devices of all platforms, in the loader's order; empty if there is no platform. A platform
// that cannot list or describe its devices is left out.
std::vector<DeviceInfo> list_devices();

// The device that `selection` names: "platform:type:name" (parts may be empty; substrings, case
// ignored; the type is gpu, accelerator or cpu), an index, or, without a colon, part of a
// platform's or device's name. Of several, and of all for "": a GPU, then an accelerator, then a
// CPU; ties by compute units, then by index. Throws DeviceError listing what exists if nothing
// matches, or if what matches cannot be used (OpenCL 1.2, little-endian, a compiler).
DeviceInfo choose_device(const std::string& selection);

// The list in words, one device a line, the one that choose_device(selection) takes marked with
// '*', and why on the last line. Never throws: where something is wrong, the text says what.
std::string describe_devices(const std::string& selection);

// Buffers, programs and kernels refer to their Device and must go before it. Distinct devices may
// be used from distinct threads.
class Device {
 public:
  // Chooses; throws DeviceError. For tests of what happens on other devices, `largest_buffer`
  // [bytes]: no buffer is to be larger, 0: as the device has it; `may_share`: false: it shares no
  // memory, whatever it could.
  explicit Device(const std::string& selection, std::uint64_t largest_buffer = 0,
                  bool may_share = true);
  ~Device();  // waits until the device no longer touches any host memory
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const DeviceInfo& info() const { return info_; }
  const std::string& label() const { return label_; }  // name, driver and platform, for messages
  cl_context context() const { return context_.get(); }
  // To enqueue one command; to be taken anew for each, or the device passes for idle.
  cl_command_queue queue() {
    idle_ = false;
    return queue_.get();
  }
  // Whether nothing has been enqueued since the queue was last waited for.
  bool is_idle() const { return idle_; }

  // As check() (opencl/error.h), for calls on this device. Waits for the queue before it throws, so
  // that host memory given to Buffer::read and write may go while the exception passes.
  void check_call(int code, const char* call) {
    check_call(code, call, [] { return std::string(); });
  }
  template <class Describe>
  void check_call(int code, const char* call, const Describe& describe) {
    try {
      check(code, call, label_, describe);
    } catch (const DeviceError&) {
      settle();
      throw;
    }
  }
  void settle() noexcept;  // waits for the queue, and does not mind if that fails

  void finish();  // waits for everything enqueued; counts as one synchronization
  long long synchronizations() const { return synchronizations_; }
  void count_synchronization() { ++synchronizations_; }

 private:
  DeviceInfo info_;
  std::string label_;
  ContextHandle context_;
  QueueHandle queue_;
  bool idle_ = true;
  long long synchronizations_ = 0;
};

}  // namespace ode_ext
