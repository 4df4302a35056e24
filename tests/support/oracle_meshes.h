// SPDX-License-Identifier: BSD-3-Clause
// Simple closed meshes with known distances, for the tests of the oracle.
#pragma once

#include "geometry/mesh_oracle.h"

namespace ode_ext::oracle {

// An axis-aligned box around the origin; two triangles a side.
Mesh make_box(Vector half_size);

// Latitudes and longitudes; inscribed, so its surface is at most `sphere_sag` below the true one.
Mesh make_sphere(double radius, unsigned rings, unsigned sides);
double sphere_sag(double radius, unsigned rings, unsigned sides);

// Around the z axis.
Mesh make_torus(double ring_radius, double tube_radius, unsigned rings, unsigned sides);

}  // namespace ode_ext::oracle
