// SPDX-License-Identifier: BSD-3-Clause
// ODE's own trimesh-trimesh collider.
#pragma once

#include <ode/ode.h>

namespace ode_ext {

// What dCollide(g1, g2, ...) gives without this library, byte for byte; 0 contacts for two meshes
// of a single triangle, which crash it. One thread at a time is let in: it keeps a global cache.
int stock_collide(dGeomID g1, dGeomID g2, int flags, dContactGeom* contacts, int skip);

}  // namespace ode_ext
