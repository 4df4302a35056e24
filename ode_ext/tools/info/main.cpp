// SPDX-License-Identifier: BSD-3-Clause
// What ode_ext sees on this machine: versions, OpenCL devices, which one it chooses and why, and
// whether a collider can be created on it.
#include <ode/ode.h>
#include <ode_ext/ode_ext.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <iostream>
#include <string>

namespace {

enum ExitCode { kExitOk = 0, kExitUsage = 2, kExitNoDevice = 3 };

std::string describe_devices(const char* selection) {
  const int length = dBatchColliderDescribeDevices(selection, nullptr, 0);
  if (length < 0) return std::string(dBatchColliderGetLastErrorMessage()) + "\n";
  std::string text(static_cast<std::size_t>(length) + 1, '\0');
  dBatchColliderDescribeDevices(selection, text.data(), text.size());
  text.pop_back();  // the terminator
  return text;
}

// `code`, or where what was printed is lost another.
int ended(int code) {
  if (std::cout.flush()) return code;
  std::cerr << "ode_ext-info: the list could not be written\n";
  return kExitUsage;
}

// The settings of dBatchColliderParams::config.
void list_settings() {
  for (int i = 0; dBatchConfigName(i) != nullptr; ++i) {
    std::cout << dBatchConfigName(i) << " = " << dBatchConfigValues(i) << "  (default "
              << dBatchConfigDefault(i) << ")\n    " << dBatchConfigMeaning(i) << '\n';
  }
}

// A device may be listed and yet fail: its compiler may refuse the kernels, or its arithmetic.
int try_to_create(const char* selection) {
  dBatchColliderParams params;
  dBatchColliderParamsInit(&params);
  params.device = selection;
  const dBatchColliderID collider = dBatchColliderCreate(&params);
  if (collider == nullptr) {
    std::cout << "no collider: " << dBatchColliderGetLastErrorMessage() << '\n';
    return kExitNoDevice;
  }
  std::cout << "a collider works on " << dBatchColliderGetDeviceName(collider) << '\n';
  dBatchColliderDestroy(collider);
  return kExitOk;
}

}  // namespace

int main(int argc, char** argv) {
  setenv("POCL_AFFINITY", "1", 0);  // as in falling_objects: read when OpenCL starts
  // Files of another program, which the collider that is tried here would begin anew.
  unsetenv("ODE_EXT_CAPTURE");
  unsetenv("ODE_EXT_TRACE");
  CLI::App app("Prints the OpenCL devices that ode_ext sees, the one it chooses, and why.",
               "ode_ext-info");
  app.footer(
      "Without --device the environment variable ODE_EXT_DEVICE counts; without that a GPU is\n"
      "preferred to an accelerator and that to a CPU.\n"
      "Exit codes: 0 a collider works, 2 wrong usage or a list that could not be written,\n"
      "3 no device.");
  std::string device;
  app.add_option("--device", device, "As ODE_EXT_DEVICE: platform:type:name, or an index");
  bool settings = false;
  app.add_flag("--settings", settings,
               "List what dBatchColliderParams::config and falling_objects --config take, and end");
  app.set_version_flag("--version", ODE_EXT_VERSION);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? kExitOk : kExitUsage;
  }
  if (settings) {
    list_settings();
    return ended(kExitOk);
  }
  const char* selection = app.count("--device") > 0 ? device.c_str() : nullptr;
  dInitODE2(0);
  std::cout << "ode_ext " << ODE_EXT_VERSION << '\n'
            << "ODE     " << dGetConfiguration() << '\n'
            << describe_devices(selection);
  // Where none can be chosen the description has said why.
  const int exit_code =
      dBatchDeviceChoose(selection) < 0 ? kExitNoDevice : try_to_create(selection);
  dCloseODE();
  return ended(exit_code);
}
