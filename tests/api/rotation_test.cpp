// SPDX-License-Identifier: BSD-3-Clause
#include "ode/rotation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ode_ext {
namespace {

const double c = std::cos(0.3), s = std::sin(0.3);
const Matrix kTurned{c, -s, 0, s, c, 0, 0, 0, 1};

TEST(Rotation, ThatIsOneStaysAsItIs) {
  EXPECT_LT(off_rotation(kTurned), 1e-15);
  EXPECT_EQ(nearest_rotation(kTurned), kTurned);
}

TEST(Rotation, WrittenWithThreeDigitsIsTheOneThatIsMeant) {
  const Matrix rounded{0.955, -0.296, 0, 0.296, 0.955, 0, 0, 0, 1};
  EXPECT_GT(off_rotation(rounded), 1e-4);
  const Matrix meant = nearest_rotation(rounded);
  EXPECT_LT(off_rotation(meant), 1e-15);
  for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(meant[k], kTurned[k], 1e-3);
}

TEST(Rotation, IsNotAMirrorOrLargerOrAskewOrNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Matrix& matrix :
       {Matrix{1, 0, 0, 0, 1, 0, 0, 0, -1}, Matrix{2, 0, 0, 0, 2, 0, 0, 0, 2},
        Matrix{1, 0, 0.1, 0, 1, 0, 0, 0, 1}, Matrix{}}) {
    EXPECT_GT(off_rotation(matrix), kMostOff);
    EXPECT_EQ(nearest_rotation(matrix), matrix);
  }
  for (std::size_t k = 0; k < 9; ++k) {
    Matrix matrix = kTurned;
    matrix[k] = nan;
    EXPECT_GT(off_rotation(matrix), kMostOff) << k;
  }
}

}  // namespace
}  // namespace ode_ext
