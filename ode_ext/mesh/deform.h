// SPDX-License-Identifier: BSD-3-Clause
// Deformable meshes whose vertices moved.
#pragma once

#include <memory>

#include "mesh/mesh.h"

namespace ode_ext {

// The shape that a deformable mesh of this topology takes with its corners at `source`; null if
// there is none, so that it has to be built anew: there are more or fewer triangles; corners that
// were one vertex no longer are at one place, or vertices came together; a triangle collapsed (two
// of its corners came together) or is no longer collapsed; a closed mesh was turned inside out, or
// had to be reoriented when it was built, since that depends on the shape; or its meshlets have
// come apart (meshlet_spread). Corners that are not finite give a mesh as build_mesh gives it, of
// no topology. `open_thickness` as in MeshOptions.
std::shared_ptr<const Mesh> deformed(const std::shared_ptr<const MeshTopology>& topology,
                                     const SourceTriangles& source, float open_thickness);

}  // namespace ode_ext
