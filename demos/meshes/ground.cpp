// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "meshes/random.h"

namespace falling_objects {
namespace {

constexpr double kCell = 0.375;   // [m]: 64 cells on the 24 m of the full scene
constexpr double kBottom = -3.0;  // [m]: deep enough that nothing finds the bottom the nearer side
constexpr int kWaves = 24;

struct Wave {
  double kx, ky, phase, amplitude;
};

std::vector<Wave> make_waves(std::uint64_t seed) {
  Random random(seed);
  std::vector<Wave> waves;
  for (int i = 0; i < kWaves; ++i) {
    const double angle = random.between(0, 2 * std::numbers::pi);
    const double length = random.between(1.5, 5.0);  // [m]: at least four cells
    const double k = 2 * std::numbers::pi / length;
    // As steep whatever their length: about 0.2 m high in all.
    waves.push_back({k * std::cos(angle), k * std::sin(angle),
                     random.between(0, 2 * std::numbers::pi), 0.018 * length});
  }
  return waves;
}

}  // namespace

Ground::Ground(double half_size, std::uint64_t seed, double steepness)
    : half_size_(half_size),
      cells_(static_cast<std::size_t>(std::ceil(2 * half_size / kCell))),
      cell_(2 * half_size / static_cast<double>(cells_)) {
  const std::vector<Wave> waves = make_waves(seed);
  for (std::size_t j = 0; j <= cells_; ++j) {
    for (std::size_t i = 0; i <= cells_; ++i) {
      const double x = static_cast<double>(i) * cell_ - half_size_;
      const double y = static_cast<double>(j) * cell_ - half_size_;
      double z = steepness * (x * x + y * y) / half_size_;
      for (const Wave& wave : waves) {
        z += wave.amplitude * std::sin(wave.kx * x + wave.ky * y + wave.phase);
      }
      heights_.push_back(z);
    }
  }
  make_mesh();
}

// Triangles split each cell from (0, 0) to (1, 1), as make_mesh does.
double Ground::height(double x, double y) const {
  if (empty()) return -std::numeric_limits<double>::infinity();
  const auto along = [&](double at, double& rest) {
    const double last = static_cast<double>(cells_);
    const double in_cells = std::clamp((at + half_size_) / cell_, 0.0, last);
    const double first = std::min(std::floor(in_cells), last - 1);
    rest = in_cells - first;
    return static_cast<std::size_t>(first);
  };
  double u = 0, v = 0;
  const std::size_t i = along(x, u), j = along(y, v);
  const double z00 = corner_height(i, j), z11 = corner_height(i + 1, j + 1);
  if (u > v) {
    const double z10 = corner_height(i + 1, j);
    return z00 + u * (z10 - z00) + v * (z11 - z10);
  }
  const double z01 = corner_height(i, j + 1);
  return z00 + v * (z01 - z00) + u * (z11 - z01);
}

// The surface is highest at a corner of a cell or on the circle; half a cell more reaches a corner
// of every cell that the circle touches.
double Ground::highest_near(double x, double y, double radius) const {
  double highest = height(x, y);
  const double reach = radius + cell_;
  for (double dx = -reach; dx <= reach; dx += cell_ / 2) {
    for (double dy = -reach; dy <= reach; dy += cell_ / 2) {
      highest = std::max(highest, height(x + dx, y + dy));
    }
  }
  return highest;
}

void Ground::make_mesh() {
  const std::size_t side = cells_ + 1;
  const auto top = [&](std::size_t i, std::size_t j) {
    return static_cast<unsigned>(j * side + i);
  };
  for (std::size_t j = 0; j < side; ++j) {
    for (std::size_t i = 0; i < side; ++i) {
      mesh_.add_vertex({static_cast<double>(i) * cell_ - half_size_,
                        static_cast<double>(j) * cell_ - half_size_, corner_height(i, j)});
    }
  }
  for (std::size_t j = 0; j < cells_; ++j) {
    for (std::size_t i = 0; i < cells_; ++i) {
      mesh_.add_quad(top(i, j), top(i + 1, j), top(i + 1, j + 1), top(i, j + 1));
    }
  }
  // The border counter-clockwise seen from above, and the same again at the bottom.
  std::vector<unsigned> border;
  for (std::size_t i = 0; i < cells_; ++i) border.push_back(top(i, 0));
  for (std::size_t j = 0; j < cells_; ++j) border.push_back(top(cells_, j));
  for (std::size_t i = cells_; i > 0; --i) border.push_back(top(i, cells_));
  for (std::size_t j = cells_; j > 0; --j) border.push_back(top(0, j));
  const auto below = static_cast<unsigned>(mesh_.vertex_count());
  for (const unsigned v : border) {
    const Point p = mesh_.vertex(v);
    mesh_.add_vertex({p[0], p[1], kBottom});
  }
  const unsigned middle = mesh_.add_vertex({0, 0, kBottom});
  const auto count = static_cast<unsigned>(border.size());
  for (unsigned k = 0; k < count; ++k) {
    const unsigned next = (k + 1) % count;
    mesh_.add_quad(below + k, below + next, border[next], border[k]);
    mesh_.add_triangle(below + next, below + k, middle);
  }
}

}  // namespace falling_objects
