// SPDX-License-Identifier: BSD-3-Clause
// Where the objects start: in layers that follow the bowl, their bounding spheres apart.
#pragma once

#include <cstddef>
#include <vector>

#include "meshes/ground.h"
#include "meshes/random.h"
#include "scene_file/scene_description.h"

namespace falling_objects {

struct Placement {
  Point position;  // [m]
  Quaternion rotation;
  std::size_t shape;
};

// Half the side of a ground that is wide enough for so many objects [m].
double ground_half_size(std::size_t count);

std::vector<Placement> place_objects(std::size_t count, std::size_t shape_count,
                                     const Ground& ground, Random& random);

}  // namespace falling_objects
