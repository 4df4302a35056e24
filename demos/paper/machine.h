// SPDX-License-Identifier: BSD-3-Clause
// What the figures were measured on.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace paper {

// `device`: the name of the device that is used; `selection`: as --device, may be empty.
nlohmann::ordered_json describe_machine(const std::string& device, const std::string& selection,
                                        const std::string& command);

struct DeviceLine {
  std::string type, name, platform, driver, version;  // empty: not known
};

// From the text of dBatchColliderDescribeDevices: the line of the chosen device.
DeviceLine parse_chosen_device(const std::string& text);

}  // namespace paper
