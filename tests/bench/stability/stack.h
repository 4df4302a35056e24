// SPDX-License-Identifier: BSD-3-Clause
// Where the cubes of a stack start, and whether they still stand.
#pragma once

#include <vector>

#include "bench/stability/shape.h"

namespace ode_ext::stability {

inline constexpr double kSide = 0.2;  // [m], of a cube

// One on the other, each moved and turned a little about the axis of the tower: by up to `offset`
// sides in x and in y and up to `yaw` [rad]. 0: exactly in line.
std::vector<TestPose> tower(int height, double offset, double yaw, Random& random);
// Rows of `base`, base - 1, ..., 1 cubes, each on two of the row below, a gap of a tenth between
// neighbours.
std::vector<TestPose> pyramid(int base);

class Stack {
 public:
  explicit Stack(const std::vector<TestPose>& start);

  // To be called with the places of all cubes after every step. A stack has fallen once its
  // highest cube is lower by a tenth of a side, or any has moved sideways by a quarter of one.
  void look(const std::vector<Point>& now, double time);

  bool stands() const { return fell_at_ < 0; }
  double fell_at() const { return fell_at_; }  // [s]; negative: it has not
  double drift() const { return drift_; }      // [m]: the most that any cube was moved sideways

 private:
  std::vector<Point> start_;
  std::size_t top_ = 0;
  double fell_at_ = -1;
  double drift_ = 0;
};

}  // namespace ode_ext::stability
