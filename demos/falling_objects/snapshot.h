// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <ostream>
#include <vector>

#include "cloth/sheet.h"
#include "simulation/scene.h"

namespace falling_objects {

// All meshes where they are, as one OBJ file with a group each.
void write_snapshot(std::ostream& out, const Scene& scene,
                    const std::vector<std::unique_ptr<Sheet>>& sheets);

}  // namespace falling_objects
