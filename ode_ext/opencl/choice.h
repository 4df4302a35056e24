// SPDX-License-Identifier: BSD-3-Clause
// How a device is chosen from a list: no OpenCL calls, so that it can be tested with any list.
#pragma once

#include <string>
#include <vector>

#include "opencl/device.h"

namespace ode_ext {

struct Choice {
  const DeviceInfo* device = nullptr;  // into the list; null if nothing can be chosen
  std::string reason;                  // how it was chosen, or why nothing was: a sentence's middle
};

Choice choose_among(const std::vector<DeviceInfo>& devices, const std::string& selection);

// Those that can be used, in the order in which they are taken where nothing is selected.
std::vector<DeviceInfo> in_default_order(const std::vector<DeviceInfo>& devices);

// What chooses a device again: its number, where that is still one like it, for there may be others
// of its name; else its names.
std::string selection_of(const DeviceInfo& device, const std::vector<DeviceInfo>& devices);

// "gpu", "accelerator", "cpu" or "other".
const char* type_name(cl_device_type type);

// Why this library cannot use the device, or "" if it can.
std::string why_unusable(const DeviceInfo& device);

// What may be the matter where a platform shows no device, or builds nothing: a sentence, after a
// space, or "".
std::string platform_advice(const std::string& platform_name);

// One line a device, `chosen` (may be null) marked with '*'.
std::string device_lines(const std::vector<DeviceInfo>& devices, const DeviceInfo* chosen);

}  // namespace ode_ext
