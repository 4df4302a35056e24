// SPDX-License-Identifier: BSD-3-Clause
// What others lie on: how to tell, and how to show it.
#pragma once

#include "falling_objects/show/mesh_of_geom.h"
#include "view/frame.h"

namespace falling_objects {

// A ground reaches under everything that moves.
bool reaches_under(const view::Box& box, const view::Box& moving);

// No corner is above a triangle's plane.
bool is_convex(const IndexedMesh& mesh);

// Seen from beside, the walls and the underside of a bowl would hide what lies in it.
void keep_top(IndexedMesh& mesh);

}  // namespace falling_objects
