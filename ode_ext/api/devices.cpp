// SPDX-License-Identifier: BSD-3-Clause
// The OpenCL devices, as data and in words.
#include <algorithm>
#include <cstring>
#include <vector>

#include "api/guarded.h"
#include "api/params.h"
#include "ode/thread_state.h"
#include "opencl/choice.h"
#include "opencl/device.h"

using namespace ode_ext::api;

namespace {

struct Device {
  ode_ext::DeviceInfo info;
  std::string problem;
};

// What the last dBatchDeviceCount of this thread found.
std::vector<Device>& devices_of_this_thread() {
  return ode_ext::of_this_thread<std::vector<Device>>();
}

Device& device_numbered(int index) {
  std::vector<Device>& devices = devices_of_this_thread();
  if (index < 0 || static_cast<std::size_t>(index) >= devices.size())
    refuse("there is no device " + std::to_string(index) + "; the last dBatchDeviceCount found " +
           std::to_string(devices.size()));
  return devices[static_cast<std::size_t>(index)];
}

}  // namespace

extern "C" {

int dBatchDeviceCount(void) {
  return guarded("dBatchDeviceCount", -1, [&] {
    refuse_in_a_fork();
    std::vector<Device>& devices = devices_of_this_thread();
    devices.clear();
    for (const ode_ext::DeviceInfo& info : ode_ext::list_devices())
      devices.push_back({info, ode_ext::why_unusable(info)});
    return static_cast<int>(devices.size());
  });
}

const char* dBatchDeviceGetText(int device, int property) {
  return guarded("dBatchDeviceGetText", static_cast<const char*>(nullptr), [&] {
    Device& found = device_numbered(device);
    switch (property) {
      case dBatchDevicePlatform:
        return found.info.platform_name.c_str();
      case dBatchDeviceName:
        return found.info.name.c_str();
      case dBatchDeviceVendor:
        return found.info.vendor.c_str();
      case dBatchDeviceType:
        return ode_ext::type_name(found.info.type);
      case dBatchDeviceDriver:
        return found.info.driver.c_str();
      case dBatchDeviceVersion:
        return found.info.version.c_str();
      case dBatchDeviceProblem:
        return found.problem.c_str();
      default:
        refuse("a device has no text " + std::to_string(property));
    }
  });
}

long long dBatchDeviceGetNumber(int device, int property) {
  return guarded("dBatchDeviceGetNumber", -1LL, [&] {
    const ode_ext::DeviceInfo& info = device_numbered(device).info;
    switch (property) {
      case dBatchDeviceComputeUnits:
        return static_cast<long long>(info.compute_units);
      case dBatchDeviceMemory:
        return static_cast<long long>(info.global_memory);
      case dBatchDeviceLargestBuffer:
        return static_cast<long long>(info.largest_buffer);
      default:
        refuse("a device has no number " + std::to_string(property));
    }
  });
}

int dBatchDeviceChoose(const char* selection) {
  return guarded("dBatchDeviceChoose", -1, [&] {
    refuse_in_a_fork();
    return ode_ext::choose_device(selection_or_environment(selection)).index;
  });
}

int dBatchColliderDescribeDevices(const char* selection, char* text, size_t size) {
  if (text != nullptr && size > 0) *text = '\0';
  return guarded("dBatchColliderDescribeDevices", -1, [&] {
    refuse_in_a_fork();
    const std::string description = ode_ext::describe_devices(selection_or_environment(selection));
    if (text != nullptr && size > 0) {
      const std::size_t count = std::min(description.size(), size - 1);
      std::memcpy(text, description.data(), count);
      text[count] = '\0';
    }
    return static_cast<int>(description.size());
  });
}

}  // extern "C"
