// SPDX-License-Identifier: BSD-3-Clause
// Which matrices are rotations. Turned by another one a mesh is in one place in the frame of the
// other mesh and in another place in its own, and it would depend on the pass which of them counts.
#pragma once

#include <array>

namespace ode_ext {

using Matrix = std::array<double, 9>;  // row-major

// A thousandth is what a rotation written with three digits may be off.
inline constexpr double kMostOff = 1e-3;

// The largest component of R * transpose(R) - 1; infinite for a mirror and what is not finite.
double off_rotation(const Matrix& matrix);

// The rotation that is meant by a matrix off by up to kMostOff: its rows made orthogonal and unit,
// one after the other (Gram and Schmidt). Others come back as they are, and so do those that are
// off by no more than a float can tell: ODE's own are.
Matrix nearest_rotation(const Matrix& matrix);

}  // namespace ode_ext
