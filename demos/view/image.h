// SPDX-License-Identifier: BSD-3-Clause
// A picture as bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace view {

struct Size {
  int width = 0, height = 0;  // [pixels]

  bool operator==(const Size&) const = default;
};

struct Image {
  Size size;
  std::vector<std::uint8_t> rgb;  // three bytes a pixel, rows from the top
};

// Throws std::runtime_error.
void write_png(const std::string& path, const Image& image);

}  // namespace view
