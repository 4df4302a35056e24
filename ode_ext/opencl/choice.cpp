// SPDX-License-Identifier: BSD-3-Clause
#include "opencl/choice.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <tuple>

namespace ode_ext {
namespace {

constexpr const char* kSyntax =
    "write \"platform:type:name\" (any part may be empty: \":gpu:\" is any GPU), an index, or part "
    "of "
    "a platform's or device's name";

// In any locale of the program's: in a Turkish one 'I' has no dot to lose.
std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

bool contains(const std::string& text, const std::string& lower_case_part) {
  return lower(text).find(lower_case_part) != std::string::npos;
}

// A selection taken apart; an empty part fits everything.
struct Pattern {
  bool is_index = false;
  int index = -1;
  std::string platform, type, name;
  std::string anywhere;  // in the platform's or the device's name

  explicit Pattern(const std::string& selection) {
    const std::string text = lower(trimmed(selection));
    const char* end = text.data() + text.size();
    is_index = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
    if (is_index) {
      // A number too large for int leaves -1, which is no device's index.
      std::from_chars(text.data(), end, index);
      return;
    }
    const auto colon = text.find(':');
    if (colon == std::string::npos) {
      anywhere = text;
      return;
    }
    platform = trimmed(text.substr(0, colon));
    const auto second = text.find(':', colon + 1);
    type = trimmed(text.substr(colon + 1, second - colon - 1));
    if (second != std::string::npos) name = trimmed(text.substr(second + 1));
  }

  bool fits(const DeviceInfo& device) const {
    if (is_index) return device.index == index;
    if (!type.empty() && type != type_name(device.type)) return false;
    return contains(device.platform_name, platform) && contains(device.name, name) &&
           (contains(device.platform_name, anywhere) || contains(device.name, anywhere));
  }
};

// Smaller comes first: usable, GPU, accelerator, CPU, many compute units, the loader's order.
auto rank(const DeviceInfo& device) {
  const int kind = device.type & CL_DEVICE_TYPE_GPU           ? 0
                   : device.type & CL_DEVICE_TYPE_ACCELERATOR ? 1
                   : device.type & CL_DEVICE_TYPE_CPU         ? 2
                                                              : 3;
  return std::tuple(!why_unusable(device).empty(), kind,
                    -static_cast<long long>(device.compute_units), device.index);
}

}  // namespace

std::string selection_of(const DeviceInfo& device, const std::vector<DeviceInfo>& devices) {
  const auto is_it = [&](const DeviceInfo& other) {
    return other.index == device.index && other.type == device.type && other.name == device.name &&
           other.platform_name == device.platform_name;
  };
  if (std::any_of(devices.begin(), devices.end(), is_it)) return std::to_string(device.index);
  return device.platform_name + ":" + type_name(device.type) + ":" + device.name;
}

const char* type_name(cl_device_type type) {
  if (type & CL_DEVICE_TYPE_GPU) return "gpu";
  if (type & CL_DEVICE_TYPE_ACCELERATOR) return "accelerator";
  if (type & CL_DEVICE_TYPE_CPU) return "cpu";
  return "other";
}

std::string why_unusable(const DeviceInfo& device) {
  int major = 0, minor = 0;
  // The standard fixes the form: "OpenCL 1.2 whatever the vendor likes".
  if (std::sscanf(device.version.c_str(), "OpenCL %d.%d", &major, &minor) != 2 ||
      std::tuple(major, minor) < std::tuple(1, 2)) {
    return "it offers \"" + device.version + "\", and OpenCL 1.2 is needed";
  }
  if (!device.little_endian) return "it is big-endian, and a little-endian device is needed";
  if (!device.has_compiler) return "its driver has no compiler for OpenCL C";
  if (!device.available) return "its driver says that it is not available at present";
  return "";
}

std::string platform_advice(const std::string& platform_name) {
  if (platform_name != "Portable Computing Language") return "";
  const char* directory = std::getenv("POCL_CACHE_DIR");
  const std::string now =
      directory != nullptr ? "now '" + std::string(directory) + "'" : "not set: ~/.cache/pocl";
  return " PoCL fails without a word where it cannot write its cache: let POCL_CACHE_DIR (" + now +
         ") name a directory that can be written.";
}

Choice choose_among(const std::vector<DeviceInfo>& devices, const std::string& selection) {
  if (devices.empty()) return {nullptr, "no OpenCL platform has a device"};
  const Pattern pattern(selection);
  const DeviceInfo* best = nullptr;
  for (const DeviceInfo& device : devices) {
    if (pattern.fits(device) && (!best || rank(device) < rank(*best))) best = &device;
  }
  const std::string quoted = "\"" + trimmed(selection) + "\"";
  if (!best) return {nullptr, "no OpenCL device matches " + quoted + "; " + kSyntax};
  const std::string problem = why_unusable(*best);
  if (!problem.empty()) return {nullptr, best->name + " cannot be used: " + problem};
  if (trimmed(selection).empty()) return {best, "the default order GPU, accelerator, CPU"};
  const char* variable = std::getenv("ODE_EXT_DEVICE");
  const bool from_environment = variable && selection == variable;
  return {best, (from_environment ? "ODE_EXT_DEVICE=" : "the program's selection ") + quoted};
}

std::vector<DeviceInfo> in_default_order(const std::vector<DeviceInfo>& devices) {
  std::vector<DeviceInfo> usable;
  std::copy_if(devices.begin(), devices.end(), std::back_inserter(usable),
               [](const DeviceInfo& device) { return why_unusable(device).empty(); });
  std::sort(usable.begin(), usable.end(),
            [](const DeviceInfo& a, const DeviceInfo& b) { return rank(a) < rank(b); });
  return usable;
}

std::string device_lines(const std::vector<DeviceInfo>& devices, const DeviceInfo* chosen) {
  constexpr double kGiB = 1024.0 * 1024.0 * 1024.0;
  std::string lines;
  for (const DeviceInfo& device : devices) {
    char memory[96];
    std::snprintf(memory, sizeof(memory), "%u compute units, %.1f GiB (%.1f GiB in one buffer)",
                  device.compute_units, static_cast<double>(device.global_memory) / kGiB,
                  static_cast<double>(device.largest_buffer) / kGiB);
    const std::string problem = why_unusable(device);
    lines += std::string(&device == chosen ? "* " : "  ") + std::to_string(device.index) + "  " +
             type_name(device.type) + "  " + device.name + "  (" + device.platform_name +
             ")  driver " + device.driver + ", " + device.version + ", " + memory +
             (problem.empty() ? "" : "; unusable: " + problem) + "\n";
  }
  return lines;
}

}  // namespace ode_ext
