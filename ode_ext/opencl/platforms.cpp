// SPDX-License-Identifier: BSD-3-Clause
// What there is: the platforms and devices that the ICD loader finds.
#include "opencl/choice.h"
#include "opencl/device.h"
#include "opencl/driver_thread.h"
#include "opencl/error.h"
#include "opencl/fork_guard.h"
#include "opencl/opencl.h"

namespace ode_ext {
namespace {

std::string text_of(cl_platform_id platform, cl_platform_info what) {
  std::size_t size = 0;
  check(clGetPlatformInfo(platform, what, 0, nullptr, &size), "clGetPlatformInfo", "");
  std::string text(size, '\0');
  check(clGetPlatformInfo(platform, what, size, text.data(), nullptr), "clGetPlatformInfo", "");
  return text.c_str();  // without the terminating zeros
}

std::string text_of(cl_device_id device, cl_device_info what) {
  std::size_t size = 0;
  check(clGetDeviceInfo(device, what, 0, nullptr, &size), "clGetDeviceInfo", "");
  std::string text(size, '\0');
  check(clGetDeviceInfo(device, what, size, text.data(), nullptr), "clGetDeviceInfo", "");
  return text.c_str();
}

template <class T>
T value_of(cl_device_id device, cl_device_info what) {
  T value{};
  check(clGetDeviceInfo(device, what, sizeof(value), &value, nullptr), "clGetDeviceInfo", "");
  return value;
}

// What a GPU can share it may reach across a bus. Devices of OpenCL 1 do not know the question.
bool shares_memory(cl_device_id device, cl_device_type type) {
  cl_device_svm_capabilities found = 0;
  return (type & CL_DEVICE_TYPE_CPU) != 0 &&
         clGetDeviceInfo(device, CL_DEVICE_SVM_CAPABILITIES, sizeof(found), &found, nullptr) ==
             CL_SUCCESS &&
         (found & CL_DEVICE_SVM_FINE_GRAIN_BUFFER) != 0;
}

std::vector<cl_platform_id> list_platforms() {
  cl_uint count = 0;
  int code = clGetPlatformIDs(0, nullptr, &count);
  if (code == CL_PLATFORM_NOT_FOUND_KHR) code = CL_SUCCESS;  // the loader's way of saying "none"
  check(code, "clGetPlatformIDs", "");
  std::vector<cl_platform_id> platforms(count);
  if (count > 0) check(clGetPlatformIDs(count, platforms.data(), nullptr), "clGetPlatformIDs", "");
  return platforms;
}

// The number before the point; 0: it is not known.
cl_uint compute_capability(cl_device_id id) {
  constexpr cl_device_info kMajor = 0x4000;  // cl_nv_device_attribute_query
  cl_uint major = 0;
  return clGetDeviceInfo(id, kMajor, sizeof(major), &major, nullptr) == CL_SUCCESS ? major : 0;
}

DeviceInfo describe(cl_device_id id) {
  DeviceInfo info;
  info.id = id;
  info.type = value_of<cl_device_type>(id, CL_DEVICE_TYPE);
  info.name = text_of(id, CL_DEVICE_NAME);
  info.vendor = text_of(id, CL_DEVICE_VENDOR);
  info.driver = text_of(id, CL_DRIVER_VERSION);
  info.version = text_of(id, CL_DEVICE_VERSION);
  info.compute_units = value_of<cl_uint>(id, CL_DEVICE_MAX_COMPUTE_UNITS);
  info.global_memory = value_of<cl_ulong>(id, CL_DEVICE_GLOBAL_MEM_SIZE);
  info.largest_buffer = value_of<cl_ulong>(id, CL_DEVICE_MAX_MEM_ALLOC_SIZE);
  info.work_group_limit = value_of<std::size_t>(id, CL_DEVICE_MAX_WORK_GROUP_SIZE);
  info.shares_memory = shares_memory(id, info.type);
  info.rounds_quotients = (value_of<cl_device_fp_config>(id, CL_DEVICE_SINGLE_FP_CONFIG) &
                           CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0;
  info.vector_width = value_of<cl_uint>(id, CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT);
  info.available = value_of<cl_bool>(id, CL_DEVICE_AVAILABLE) == CL_TRUE;
  info.has_compiler = value_of<cl_bool>(id, CL_DEVICE_COMPILER_AVAILABLE) == CL_TRUE;
  info.little_endian = value_of<cl_bool>(id, CL_DEVICE_ENDIAN_LITTLE) == CL_TRUE;
  return info;
}

std::vector<DeviceInfo> devices_of(cl_platform_id platform) {
  cl_uint count = 0;
  int code = clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 0, nullptr, &count);
  if (code == CL_DEVICE_NOT_FOUND) code = CL_SUCCESS;  // none, as of a GPU's driver without the GPU
  check(code, "clGetDeviceIDs", "");
  std::vector<cl_device_id> ids(count);
  if (count > 0) {
    check(clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, count, ids.data(), nullptr),
          "clGetDeviceIDs", "");
  }
  std::vector<DeviceInfo> devices;
  const std::string platform_name = text_of(platform, CL_PLATFORM_NAME);
  for (cl_device_id id : ids) {
    devices.push_back(describe(id));
    devices.back().platform = platform;
    devices.back().platform_name = platform_name;
    if (platform_name == "NVIDIA CUDA") devices.back().compute_capability = compute_capability(id);
  }
  return devices;
}

struct Survey {
  std::size_t platform_count = 0;
  std::vector<DeviceInfo> devices;
  std::string problems;  // a sentence for each platform left out
  std::string advice;    // about those that show no device
};

Survey survey_here() {
  Survey result;
  for (cl_platform_id platform : list_platforms()) {
    try {
      std::vector<DeviceInfo> devices = devices_of(platform);
      if (devices.empty()) result.advice += platform_advice(text_of(platform, CL_PLATFORM_NAME));
      for (DeviceInfo& device : devices) {
        device.index = static_cast<int>(result.devices.size());
        result.devices.push_back(std::move(device));
      }
    } catch (const DeviceError& error) {
      // One broken driver must not take the others' devices away.
      result.problems +=
          "\nPlatform " + std::to_string(result.platform_count) + " was left out: " + error.what();
    }
    ++result.platform_count;
  }
  return result;
}

// One thread at a time, as the driver thread is: platforms set themselves up in the first call, and
// PoCL 3.1 crashes or shows no device where several threads make it at once.
Survey survey() {
  note_opencl_is_used();
  return from_driver_thread(&survey_here);
}

// Why nothing was chosen, and what there is instead.
DeviceError refusal(const Survey& found, const std::string& reason) {
  const std::string install =
      " Install pocl-opencl-icd (runs on any CPU) or the OpenCL driver (ICD) of your GPU.";
  if (found.platform_count == 0)
    return DeviceError(CL_PLATFORM_NOT_FOUND_KHR, "There is no OpenCL platform." + install);
  if (found.devices.empty())
    return DeviceError(0, "No device chosen: " + reason + "." +
                              (found.advice.empty() ? install : found.advice) + found.problems);
  return DeviceError(0, "No device chosen: " + reason + "." + found.advice + " There are:\n" +
                            device_lines(found.devices, nullptr) + found.problems);
}

}  // namespace

std::vector<DeviceInfo> list_devices() { return survey().devices; }

DeviceInfo choose_device(const std::string& selection) {
  const Survey found = survey();
  const Choice choice = choose_among(found.devices, selection);
  if (!choice.device) throw refusal(found, choice.reason);
  return *choice.device;
}

std::string describe_devices(const std::string& selection) {
  try {
    const Survey found = survey();
    const Choice choice = choose_among(found.devices, selection);
    if (!choice.device) return std::string(refusal(found, choice.reason).what()) + "\n";
    return device_lines(found.devices, choice.device) + "* chosen by " + choice.reason +
           found.problems + "\n";
  } catch (const std::exception& error) {
    return std::string(error.what()) + "\n";
  }
}

}  // namespace ode_ext
