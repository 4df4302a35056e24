// SPDX-License-Identifier: BSD-3-Clause
// Meshes of the user's own.
#pragma once

#include <string>

#include "meshes/triangle_mesh.h"

namespace falling_objects {

// Reads whatever Assimp reads: all meshes of the file as one, in their places, welded, each
// part wound outwards. Throws std::runtime_error with a sentence that names the file.
TriangleMesh read_mesh_file(const std::string& path);

// The same, centred and scaled like the demo's own shapes.
TriangleMesh load_mesh(const std::string& path);

// Throws std::runtime_error where the library has no contacts for a mesh, since it reaches too far
// from its origin.
void check_reach(const TriangleMesh& mesh, const std::string& path);

// Throws std::runtime_error where ODE would find no mass in a mesh of this shape and size, or
// nothing could touch it.
void check_has_volume(const TriangleMesh& mesh, const std::string& path);

}  // namespace falling_objects
