// SPDX-License-Identifier: BSD-3-Clause
#include "judging/near_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_map>

namespace falling_objects {
namespace {

using ode_ext::oracle::Vector;
using Cell = std::array<std::int64_t, 3>;

struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    std::uint64_t hash = 0;
    for (const std::int64_t k : cell) {
      hash = (hash ^ static_cast<std::uint64_t>(k)) * 0x9e3779b97f4a7c15;
      hash ^= hash >> 29;
    }
    return static_cast<std::size_t>(hash);
  }
};

// Balls of about one size: radius above 2^(level - 1), at most 2^level [m].
using Grid = std::unordered_map<Cell, std::vector<std::size_t>, CellHash>;

int level_of(double radius) { return static_cast<int>(std::ceil(std::log2(radius))); }

// As wide as such a ball at most, so that it and one that is no larger touch only if they are in
// cells next to one another.
Cell cell_at(const Vector& place, int level) {
  const auto along = [&](double x) {
    constexpr double kFar = 1e15;  // cells: what is farther shares the last
    const double cell = std::floor(std::ldexp(x, -level - 1));
    return static_cast<std::int64_t>(std::clamp(cell, -kFar, kFar));
  };
  return {along(place.x), along(place.y), along(place.z)};
}

bool is_finite(const Ball& ball) {
  return std::isfinite(dot(ball.middle, ball.middle)) && std::isfinite(ball.radius);
}

bool touch(const Ball& a, const Ball& b) {
  const Vector apart = a.middle - b.middle;
  const double reach = a.radius + b.radius;
  return dot(apart, apart) <= reach * reach;
}

}  // namespace

std::vector<std::array<std::size_t, 2>> near_pairs(std::span<const Ball> balls) {
  std::map<int, Grid> grids;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    if (!is_finite(balls[i])) continue;
    const int level = level_of(balls[i].radius);
    grids[level][cell_at(balls[i].middle, level)].push_back(i);
  }
  std::vector<std::array<std::size_t, 2>> pairs;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    if (!is_finite(balls[i])) continue;
    const int own = level_of(balls[i].radius);
    // Each finds those of its own size and the larger ones.
    for (auto grid = grids.find(own); grid != grids.end(); ++grid) {
      const Cell middle = cell_at(balls[i].middle, grid->first);
      for (int k = 0; k < 27; ++k) {
        const Cell cell{middle[0] + k % 3 - 1, middle[1] + k / 3 % 3 - 1, middle[2] + k / 9 - 1};
        const auto found = grid->second.find(cell);
        if (found == grid->second.end()) continue;
        for (const std::size_t j : found->second) {
          if (grid->first == own && j <= i) continue;  // found by j, or itself
          if (touch(balls[i], balls[j])) pairs.push_back({std::min(i, j), std::max(i, j)});
        }
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace falling_objects
