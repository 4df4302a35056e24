// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ode/ode.h>

#include <glm/glm.hpp>
#include <vector>

#include "view/frame.h"

namespace falling_objects {

struct IndexedMesh {
  std::vector<glm::vec3> positions;
  std::vector<unsigned> triangles;  // three vertices each
  bool closed = false;
};

// A trimesh as ODE has it, in its own frame. Vertices in one place are one.
IndexedMesh mesh_of(dTriMeshDataID data);

view::Pose pose_of(dGeomID geom);

inline glm::vec3 to_glm(const dReal* v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

}  // namespace falling_objects
