// SPDX-License-Identifier: BSD-3-Clause
// How large and how small meshes may be for their contacts to be right in floats.
#pragma once

#include <string>

#include "mesh/mesh.h"

namespace ode_ext {

// The largest product in the kernels is one of three lengths (lib/ray_triangle.h), summed over
// three corners: u * z with u = a * b - c * d. (Where two of four are compared, in
// paper/iterative_ray.h, the larger overflows first, and what underflows is cast in full.) Meshes
// whose boxes touch, turned by matrices of entries up to 2, have no two points farther apart than
// 20 times the larger extent E, and a sheared coordinate is twice that at most. So it stays below 6
// * sqrt(3) * (40 E)^3 < 2^20 E^3, which a float holds up to E = 2^36.
inline constexpr float kFarthestCorner = 0x1p36f;  // [m] from the mesh's own origin, 6.9e10

// For the same product not to underflow where it matters: of a triangle that is 2^-8 of the mesh
// wide and high, to within epsilon, 2^-20 of the mesh, it is 2^-36 of the cube of the mesh's size,
// and a float that is not denormal (which devices may flush) holds 2^-126.
inline constexpr float kSmallestMesh = 0x1p-30f;  // [m] diagonal of the box, 9.3e-10

// Why contacts of a mesh are not computed, as what a sentence about it says; empty: they are.
std::string why_refused(const SourceTriangles& source);

}  // namespace ode_ext
