// SPDX-License-Identifier: BSD-3-Clause
// ODE's own trimesh-trimesh collider.
#pragma once

#include <ode/ode.h>

namespace ode_ext {

// What dCollide(g1, g2, ...) gives without this library, byte for byte; 0 contacts for two meshes
// of a single triangle, which crash it. One thread at a time is let in, since it keeps a cache for
// all threads; but not where a geom has a merge callback, which is never called under a lock: then,
// as with ODE alone, the program sees to it that no other thread collides meshes.
int stock_collide(dGeomID g1, dGeomID g2, int flags, dContactGeom* contacts, int skip);

}  // namespace ode_ext
