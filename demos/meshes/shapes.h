// SPDX-License-Identifier: BSD-3-Clause
// The four falling shapes. GRAPP section 6 uses non-convex objects of 902, 2,130, 3,264 and 3,458
// triangles; those models are not public, so shapes of exactly these counts are generated. All are
// closed, wound outwards, centred on their centre of mass, of bounding radius 0.5 m, and nowhere
// thinner than 0.15 m. Half have flat faces and sharp edges, the hard case for rays cast from
// vertices; half are rounded.
#pragma once

#include <string>
#include <vector>

#include "meshes/triangle_mesh.h"

namespace falling_objects {

inline constexpr double kShapeRadius = 0.5;  // [m]

TriangleMesh make_horseshoe();    // 902 triangles: a capsule bent into an arc
TriangleMesh make_bumpy_torus();  // 2,130 triangles
TriangleMesh make_jack();         // 3,264 triangles: three square bars crossed, flat faces
TriangleMesh make_gear();         // 3,458 triangles: seven teeth, flat faces

struct NamedMesh {
  std::string name;
  TriangleMesh mesh;
};

std::vector<NamedMesh> make_shapes();

}  // namespace falling_objects
