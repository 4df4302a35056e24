// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "falling_objects/options.h"
#include "simulation/step_record.h"

namespace falling_objects {

// What a picture says of a world: which collider drives it, how deep its bodies are in one another
// as measured on the meshes [m], if it was, how fast they are, what colliding them took.
std::vector<std::string> caption(const Options& options, const StepRecord& record,
                                 std::optional<double> deepest);

// "6.2 mm", "0.71 m"
std::string length_text(double meters);

}  // namespace falling_objects
