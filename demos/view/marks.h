// SPDX-License-Identifier: BSD-3-Clause
// The meshes that overlays are made of.
#pragma once

#include "view/frame.h"
#include "view/shaded_mesh.h"

namespace view {

// From the origin to (0, 0, 1), of which the last third is a head of radius 1.
ShadedMesh arrow_mesh();

// Where it is `thickness` [m] wide.
Pose arrow_pose(const Arrow& arrow, float thickness);

// The twelve edges from (0, 0, 0) to (1, 1, 1), as lines of two vertices.
ShadedMesh box_mesh();

}  // namespace view
