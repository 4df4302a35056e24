// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/show/caption.h"

#include <cstdio>

namespace falling_objects {
namespace {

std::string text_of(const char* format, double value) {
  std::string text(64, '\0');
  text.resize(static_cast<std::size_t>(std::snprintf(text.data(), text.size(), format, value)));
  return text;
}

}  // namespace

std::string length_text(double meters) {
  if (meters >= 0.1) return text_of("%.2f m", meters);
  return text_of(meters >= 0.01 ? "%.0f mm" : "%.1f mm", 1000 * meters);
}

std::vector<std::string> caption(const Options& options, const StepRecord& record,
                                 std::optional<double> deepest) {
  return {options.collider == Collider::kBatch ? "ode_ext" : "ODE's own collider",
          "deepest penetration  " + (deepest ? length_text(*deepest) : "not measured"),
          "mean speed  " + text_of("%.2f m/s", record.mean_speed),
          "colliding  " + text_of("%.1f ms", record.collide_ms) + ", " +
              std::to_string(record.contacts) + " contacts"};
}

}  // namespace falling_objects
