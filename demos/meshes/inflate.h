// SPDX-License-Identifier: BSD-3-Clause
// A skin around a closed mesh. The collider answers for vertices that are inside only, and what a
// vertex rests on it therefore rests in; a sheet that rests on the skin is outside of the mesh, and
// so are its triangles where they cut a corner short.
#pragma once

#include "meshes/triangle_mesh.h"

namespace falling_objects {

// Every vertex moved outwards so that all faces around it move by at least `margin` [m], at sharp
// corners by less than they would have to: no vertex moves by more than twice the margin.
TriangleMesh inflate(const TriangleMesh& mesh, double margin);

}  // namespace falling_objects
