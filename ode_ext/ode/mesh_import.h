// SPDX-License-Identifier: BSD-3-Clause
// The triangles of a dTriMeshData. ODE has no call that gives them; a geom of the data at the
// identity pose does, bit for bit as ODE itself rounds them (to float).
#pragma once

#include <ode/ode.h>

#include "geometry/mesh.h"

namespace ode_ext {

// Overwrites `soup`. The geom lives only in here, in no space; allowed inside callbacks. Returns
// whether the corners are finite and some lie outside of the box that ODE took of the data when it
// was built, by which it finds pairs.
bool read_triangles(dTriMeshDataID data, TriangleSoup& soup);

}  // namespace ode_ext
