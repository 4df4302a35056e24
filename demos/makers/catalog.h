// SPDX-License-Identifier: BSD-3-Clause
// The shapes that a scene file can name, and their parameters.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "meshes/triangle_mesh.h"

namespace falling_objects {

struct ShapeParameter {
  const char* name;
  double fallback;  // lengths in meters
  double least, most;
  bool whole = false;
};

struct ShapeMaker {
  const char* name;
  const char* meaning;  // a phrase
  std::vector<ShapeParameter> parameters;
  // Values in the order of the parameters. Throws std::invalid_argument where they do not fit each
  // other.
  std::function<TriangleMesh(std::span<const double>)> make;
};

const std::vector<ShapeMaker>& shape_makers();

// nullptr: there is none of this name.
const ShapeMaker* find_shape_maker(const std::string& name);

}  // namespace falling_objects
