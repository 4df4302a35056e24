// SPDX-License-Identifier: BSD-3-Clause
// Arguments of the programs that measure.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>

// With what the program is to end at once: 0 after --help, 2 after wrong usage, as falling_objects.
inline std::optional<int> parse_arguments(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  return std::nullopt;
}
