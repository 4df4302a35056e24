// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string>

namespace falling_objects {

// As printf, up to 255 characters.
template <class... Values>
std::string format(const char* pattern, Values... values) {
  std::string text(256, '\0');
  const int length = std::snprintf(text.data(), text.size(), pattern, values...);
  text.resize(std::min(text.size() - 1, static_cast<std::size_t>(std::max(length, 0))));
  return text;
}

}  // namespace falling_objects
