// SPDX-License-Identifier: BSD-3-Clause
#include "paper/machine.h"

#include <ode_ext/ode_ext.h>

#include <chrono>
#include <ctime>
#include <fstream>
#include <sstream>
#include <thread>

#ifndef PAPER_COMMIT
#define PAPER_COMMIT "unknown"
#endif
#ifndef PAPER_BUILD_TYPE
#define PAPER_BUILD_TYPE "unknown"
#endif

namespace paper {
namespace {

#if defined(__clang__)
constexpr const char* kCompiler = "clang " __clang_version__;
#elif defined(__GNUC__)
constexpr const char* kCompiler = "gcc " __VERSION__;
#else
constexpr const char* kCompiler = "unknown";
#endif

std::string describe_devices(const std::string& selection) {
  const char* chosen = selection.empty() ? nullptr : selection.c_str();
  const int length = dBatchColliderDescribeDevices(chosen, nullptr, 0);
  if (length < 0) return dBatchColliderGetLastErrorMessage();
  std::string text(static_cast<std::size_t>(length) + 1, '\0');
  dBatchColliderDescribeDevices(chosen, text.data(), text.size());
  text.pop_back();  // the terminator
  return text;
}

std::string cpu_model() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string now() {
  const std::time_t time = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  char text[32] = "unknown";
  std::strftime(text, sizeof(text), "%Y-%m-%d %H:%M UTC", std::gmtime(&time));
  return text;
}

// What lies between `before` and `after`, or the end.
std::string between(const std::string& text, const std::string& before, const std::string& after) {
  const std::size_t found = text.find(before);
  if (found == std::string::npos) return "";
  const std::size_t first = found + before.size();
  const std::size_t end = text.find(after, first);
  return text.substr(first, end == std::string::npos ? end : end - first);
}

}  // namespace

// "* 0  cpu  NAME  (PLATFORM)  driver DRIVER, VERSION, 2 compute units, ..."
DeviceLine parse_chosen_device(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("* ") || line.find("  driver ") == std::string::npos) continue;
    DeviceLine device;
    std::istringstream words(line);
    std::string star, index;
    words >> star >> index >> device.type;
    device.name = between(line, "  " + device.type + "  ", "  (");
    device.platform = between(line, "  (", ")  driver ");
    device.driver = between(line, ")  driver ", ", ");
    device.version = between(line, "driver " + device.driver + ", ", ", ");
    return device;
  }
  return {};
}

nlohmann::ordered_json describe_machine(const std::string& device, const std::string& selection,
                                        const std::string& command) {
  const std::string devices = describe_devices(selection);
  const DeviceLine line = parse_chosen_device(devices);
  const auto or_unknown = [](const std::string& text) { return text.empty() ? "unknown" : text; };
  nlohmann::ordered_json json;
  json["device"] = device;
  json["device_type"] = or_unknown(line.type);
  json["platform"] = or_unknown(line.platform);
  json["driver"] = or_unknown(line.driver);
  json["opencl"] = or_unknown(line.version);
  json["devices"] = devices;
  json["cpu"] = cpu_model();
  json["cores"] = std::thread::hardware_concurrency();
  json["ode"] = dGetConfiguration();
  json["ode_ext"] = ODE_EXT_VERSION;
  json["compiler"] = kCompiler;
  json["build_type"] = PAPER_BUILD_TYPE;
  json["commit"] = PAPER_COMMIT;
  json["date"] = now();
  json["command"] = command;
  return json;
}

}  // namespace paper
