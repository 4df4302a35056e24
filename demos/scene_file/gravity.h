// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace falling_objects {

inline constexpr double kGravity = 9.81;  // [m/s^2]

}  // namespace falling_objects
