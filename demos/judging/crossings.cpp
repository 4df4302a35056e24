// SPDX-License-Identifier: BSD-3-Clause
#include "judging/crossings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace falling_objects {
namespace {

using ode_ext::oracle::Triangle;
using ode_ext::oracle::Vector;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::array<double Vector::*, 3> kAxes{&Vector::x, &Vector::y, &Vector::z};

// Six times the volume of a tetrahedron: positive if d is on the side that a, b, c turn to.
double volume(Vector a, Vector b, Vector c, Vector d) { return dot(cross(b - a, c - a), d - a); }

// The ends are on two sides of the plane, and the line passes all edges on the same side.
bool goes_through(Vector from, Vector to, const Triangle& t) {
  if (volume(t[0], t[1], t[2], from) * volume(t[0], t[1], t[2], to) >= 0) return false;
  const double a = volume(from, to, t[0], t[1]), b = volume(from, to, t[1], t[2]),
               c = volume(from, to, t[2], t[0]);
  return (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
}

void bounds(const Triangle& t, Vector& low, Vector& high) {
  for (const Vector& p : t) {
    for (const auto axis : kAxes) {
      low.*axis = std::min(low.*axis, p.*axis);
      high.*axis = std::max(high.*axis, p.*axis);
    }
  }
}

}  // namespace

bool triangles_cross(const Triangle& a, const Triangle& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (goes_through(a[k], a[next], b) || goes_through(b[k], b[next], a)) return true;
  }
  return false;
}

CrossingFinder::CrossingFinder(std::vector<Triangle> surface)
    : surface_(std::move(surface)),
      low_{kInfinity, kInfinity, kInfinity},
      high_{-kInfinity, -kInfinity, -kInfinity} {
  double edges = 0;
  for (const Triangle& t : surface_) {
    bounds(t, low_, high_);
    edges += length(t[1] - t[0]);
  }
  // A cell as large as a triangle holds a few.
  cell_ = edges / static_cast<double>(surface_.size());
  for (std::size_t k = 0; k < 3; ++k) {
    cells_[k] = static_cast<std::size_t>((high_.*kAxes[k] - low_.*kAxes[k]) / cell_) + 1;
  }
  in_cell_.resize(cells_[0] * cells_[1] * cells_[2]);
  for (std::uint32_t i = 0; i < surface_.size(); ++i) {
    Cell first, last, at;
    cells_of(surface_[i], first, last);
    for (at[2] = first[2]; at[2] <= last[2]; ++at[2]) {
      for (at[1] = first[1]; at[1] <= last[1]; ++at[1]) {
        for (at[0] = first[0]; at[0] <= last[0]; ++at[0]) in_cell_[number(at)].push_back(i);
      }
    }
  }
}

// False: the triangle is beyond the grid.
bool CrossingFinder::cells_of(const Triangle& triangle, Cell& first, Cell& last) const {
  Vector low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
  bounds(triangle, low, high);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = kAxes[k];
    if (high.*axis < low_.*axis || low.*axis > high_.*axis) return false;
    const auto cell = [&](double at) {
      return std::min(cells_[k] - 1,
                      static_cast<std::size_t>(std::max(0.0, at - low_.*axis) / cell_));
    };
    first[k] = cell(low.*axis);
    last[k] = cell(high.*axis);
  }
  return true;
}

bool CrossingFinder::crossed_by(const Triangle& triangle) const {
  Cell first, last, at;
  if (!cells_of(triangle, first, last)) return false;
  for (at[2] = first[2]; at[2] <= last[2]; ++at[2]) {
    for (at[1] = first[1]; at[1] <= last[1]; ++at[1]) {
      for (at[0] = first[0]; at[0] <= last[0]; ++at[0]) {
        for (const std::uint32_t i : in_cell_[number(at)]) {
          if (triangles_cross(triangle, surface_[i])) return true;
        }
      }
    }
  }
  return false;
}

}  // namespace falling_objects
