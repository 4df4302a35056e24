// SPDX-License-Identifier: BSD-3-Clause
#include "contacts/known_depth.h"

#include <algorithm>
#include <cmath>

namespace ode_ext {
namespace {

// How far a mesh may be out of ODE's box of it where a contact is, along the normal [m]. The
// vertices of the mesh are rounded to floats, by 2^-24 of each coordinate at most, while ODE's
// broad phase sees the program's own: a body that is pushed out of the mesh to the last bit would
// be clear of ODE's box before, and fall. That is so where the surface lies in a side of the box.
// Elsewhere, as on the hills of a terrain, the boxes overlap by more than the contact is deep, and
// nothing has to be left, however far from the origin the terrain is modelled; but for a strip
// along its border, where that may be the side of ODE's box.
double beyond_box(const Contact& contact, const PlacedMesh& placed) {
  const Vec3d place = placed.pose.rotate_back(contact.position - placed.pose.position);
  const Vec3d normal = placed.pose.rotate_back(contact.normal);
  const Box box = box_as_given(placed.mesh);
  double beyond = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    double rounding = 0;
    for (const float side : {box.lo[k], box.hi[k]}) {
      const double of_side = 0x1p-24 * std::fabs(static_cast<double>(side));
      // The contact is on the surface of this mesh or on that of the other.
      if (std::fabs(place[k] - static_cast<double>(side)) <= contact.depth + of_side)
        rounding = std::max(rounding, of_side);
    }
    beyond += std::fabs(normal[k]) * rounding;
  }
  return beyond;
}

}  // namespace

// Nor is a depth known to more than floats hold: 2^-24 of a coordinate of either mesh, which are
// counted from the smaller one where that is small beside the other (kernels/lib/bases.h).
//
// But not all of it is taken off: ODE's dWorldStep finds no solution where two bodies that fall as
// one touch at no depth, as of a stack that is put together without gaps, and lets them through the
// floor. What is left moves a body by what is not known in 2^24 steps and more.
double known_depth(const Contact& contact, const std::array<PlacedMesh, 2>& pair) {
  const float smaller = std::min(pair[0].mesh.radius, pair[1].mesh.radius);
  const double unknown = 0x1p-23 * static_cast<double>(smaller) + beyond_box(contact, pair[0]) +
                         beyond_box(contact, pair[1]);
  return std::max(0x1p-24 * unknown, contact.depth - unknown);
}

}  // namespace ode_ext
