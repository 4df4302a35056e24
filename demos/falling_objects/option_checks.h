// SPDX-License-Identifier: BSD-3-Clause
// Checks of options.
#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <string>

namespace falling_objects {

// CLI::Range takes what is not a number for one within.
inline CLI::Validator within(double least, double most) {
  const std::string from = CLI::detail::to_string(least), to = CLI::detail::to_string(most);
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        double value = 0;
        const bool is_number = CLI::detail::lexical_cast(text, value);
        if (is_number && value >= least && value <= most) return "";
        return "'" + text + "' is no number from " + from + " to " + to;
      },
      "in [" + from + " - " + to + "]");
}

// CLI11 takes -1 for the largest.
inline CLI::Validator is_seed() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        std::uint64_t value = 0;
        const char* const end = text.data() + text.size();
        const auto read = std::from_chars(text.data(), end, value);
        if (read.ec == std::errc() && read.ptr == end) return "";
        return "'" + text + "' is no whole number from 0 to 18446744073709551615";
      },
      "");
}

}  // namespace falling_objects
