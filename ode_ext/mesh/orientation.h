// SPDX-License-Identifier: BSD-3-Clause
// Whether triangles bound a solid, and their winding.
#pragma once

#include <vector>

#include "mesh/half_edges.h"
#include "mesh/vec.h"

namespace ode_ext {

struct Orientation {
  bool closed = false;      // each edge is run as often one way as the other, and no two triangles
                            // have the same corners
  bool reoriented = false;  // the windings contradicted each other and were made consistent
  bool inverted = false;    // all windings were turned: the volume was negative
};

// Makes the normals of a closed mesh point outward by turning triangles (swapping two corners).
// A consistent winding is trusted: a part inside another may be a cavity, so only the sign of the
// whole volume counts. An inconsistent one says nothing, so each connected part is made consistent
// and turned to a positive volume by itself; not where an edge has more than two triangles, of
// which it is not known which are neighbours. A mesh that is open or not orientable is left alone.
// The half-edges follow the triangles.
Orientation orient(const std::vector<Vec3f>& vertices, std::vector<Triangle>& triangles,
                   std::vector<HalfEdge>& half_edges);

// Six times the volume that the triangles of a closed mesh enclose.
double signed_volume(const std::vector<Vec3f>& vertices, const std::vector<Triangle>& triangles);

}  // namespace ode_ext
