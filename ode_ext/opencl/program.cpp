// SPDX-License-Identifier: BSD-3-Clause
#include "opencl/program.h"

#include <algorithm>
#include <string_view>

#include "opencl/choice.h"
#include "opencl/embedded_kernels.h"
#include "opencl/error.h"

namespace ode_ext {
namespace {

// What a work-group goes through together where OX_LANES_ARE_GROUP (kernels/lib/group.h).
constexpr std::string_view kOfGroups[] = {"cull.cl", "flood.cl", "contacts/choose.cl",
                                          "contacts/reduce.cl"};

// Where a file is left out; nullptr: nowhere. Of groups those, and what they are made of.
const char* left_out(std::string_view name) {
  if (name == "self_test_group.cl") return "#ifdef OX_LANES_ARE_GROUP\n";
  if (std::find(std::begin(kOfGroups), std::end(kOfGroups), name) != std::end(kOfGroups))
    return "#ifndef OX_GROUPS_APART\n";
  if (name.starts_with("paper/")) return "#if defined(OX_PAPER) && !defined(OX_LANES_ARE_GROUP)\n";
  if (name.ends_with(".cl") || name == "lib/intersect.h" || name == "lib/cross.h")
    return "#ifndef OX_LANES_ARE_GROUP\n";
  return nullptr;
}

void append_file(std::string& source, const EmbeddedKernel& file) {
  const char* condition = left_out(file.name);
  if (condition != nullptr) source += condition;
  source += "#line 1 \"" + std::string(file.name) + "\"\n";
  std::string_view rest(reinterpret_cast<const char*>(file.text), file.size);
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    // A dropped line leaves its line end, so that the numbers in the build log stay right.
    if (!line.starts_with("#include \"")) source += line;
    source += '\n';
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
  }
  if (condition != nullptr) source += "#endif\n";
}

// For a message about a failed build, so a failure of its own is only told.
std::string build_log(cl_program program, cl_device_id device) {
  std::size_t size = 0;
  clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, 0, nullptr, &size);
  std::string log(size, '\0');
  const int code =
      clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, size, log.data(), nullptr);
  return code == CL_SUCCESS ? log.c_str() : "(the driver does not give it)";
}

std::string with_vector_width(const DeviceInfo& device, const std::string& options) {
  const char* const macro = "-DOX_VECTOR_WIDTH=";
  if (options.find(macro) != std::string::npos) return options;
  return options + " " + macro + std::to_string(suitable_vector_width(device));
}

}  // namespace

unsigned suitable_vector_width(const DeviceInfo& device) {
  for (const unsigned width : {16u, 8u, 4u})
    if (device.vector_width >= width) return width;
  return 1;
}

std::string embedded_source() {
  std::string source;
  for (std::size_t i = 0; i < kEmbeddedKernelCount; ++i) append_file(source, kEmbeddedKernels[i]);
  return source;
}

Program::Program(Device& device, const std::string& options)
    : Program(device, embedded_source(), with_vector_width(device.info(), options)) {}

Program::Program(Device& device, const std::string& source, const std::string& options)
    : device_(&device) {
  const char* text = source.data();
  const std::size_t size = source.size();
  cl_int code = CL_SUCCESS;
  program_.reset(clCreateProgramWithSource(device.context(), 1, &text, &size, &code));
  device.check_call(code, "clCreateProgramWithSource");

  // Nothing that relaxes the arithmetic: watertight rays need every operation rounded as written.
  // Quotients and roots too, where the device can: then contacts are the same on all of those.
  const std::string rounded =
      device.info().rounds_quotients ? " -cl-fp32-correctly-rounded-divide-sqrt" : "";
  const std::string all_options = "-cl-std=CL1.2 " + options + rounded;
  const cl_device_id id = device.info().id;
  code = clBuildProgram(program_.get(), 1, &id, all_options.c_str(), nullptr, nullptr);
  device.check_call(code, "clBuildProgram", [&] {
    return "Options: " + all_options + "\nBuild log:\n" + build_log(program_.get(), id) +
           platform_advice(device.info().platform_name);
  });
}

}  // namespace ode_ext
