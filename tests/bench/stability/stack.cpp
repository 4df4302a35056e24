// SPDX-License-Identifier: BSD-3-Clause
#include "bench/stability/stack.h"

#include <algorithm>
#include <cmath>

namespace ode_ext::stability {

std::vector<TestPose> tower(int height, double offset, double yaw, Random& random) {
  std::vector<TestPose> poses;
  for (int i = 0; i < height; ++i) {
    const double x = kSide * random.uniform(-offset, offset);
    const double y = kSide * random.uniform(-offset, offset);
    const double turn = random.uniform(-yaw, yaw);
    poses.push_back(turned({0, 0, 1}, turn, {x, y, kSide * (i + 0.5)}));
  }
  return poses;
}

std::vector<TestPose> pyramid(int base) {
  const double pitch = 1.1 * kSide;
  std::vector<TestPose> poses;
  for (int row = 0; row < base; ++row) {
    const int count = base - row;
    for (int i = 0; i < count; ++i) {
      poses.push_back(at(pitch * (i - (count - 1) / 2.0), 0, kSide * (row + 0.5)));
    }
  }
  return poses;
}

Stack::Stack(const std::vector<TestPose>& start) {
  for (const TestPose& pose : start) start_.push_back(pose.position);
  const auto top = std::max_element(start_.begin(), start_.end(),
                                    [](const Point& a, const Point& b) { return a[2] < b[2]; });
  top_ = static_cast<std::size_t>(top - start_.begin());
}

void Stack::look(const std::vector<Point>& now, double time) {
  if (!stands()) return;
  for (std::size_t i = 0; i < start_.size(); ++i) {
    const double sideways = std::hypot(now[i][0] - start_[i][0], now[i][1] - start_[i][1]);
    // Not finite is fallen, too.
    if (!(sideways <= kSide / 4)) fell_at_ = time;
    drift_ = std::max(drift_, sideways);
  }
  if (!(start_[top_][2] - now[top_][2] < kSide / 10)) fell_at_ = time;
}

}  // namespace ode_ext::stability
