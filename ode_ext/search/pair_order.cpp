// SPDX-License-Identifier: BSD-3-Clause
#include "search/pair_order.h"

#include <array>
#include <bit>
#include <cstddef>
#include <limits>

namespace ode_ext {
namespace {

constexpr int kClasses = std::numeric_limits<std::uint32_t>::digits + 1;

std::size_t class_of(std::uint32_t features) {
  return static_cast<std::size_t>(kClasses - 1 - std::bit_width(features));
}

}  // namespace

void put_longest_first(std::span<const std::uint32_t> features, std::vector<std::uint32_t>& order) {
  order.clear();
  std::array<std::size_t, kClasses> next{};
  for (const std::uint32_t count : features) ++next[class_of(count)];
  std::size_t first = 0;
  for (std::size_t& place : next) {
    if (place == features.size()) return;
    const std::size_t count = place;
    place = first;
    first += count;
  }
  order.resize(features.size());
  for (std::size_t i = 0; i < features.size(); ++i)
    order[next[class_of(features[i])]++] = static_cast<std::uint32_t>(i);
}

}  // namespace ode_ext
