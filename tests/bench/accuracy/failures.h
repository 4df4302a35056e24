// SPDX-License-Identifier: BSD-3-Clause
// The pairs at which a trial found something wrong, with all that is needed to look at one again.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "support/ode_world.h"

namespace ode_ext::accuracy {

// Of both: position, rotation (row-major), and how many triangles, which tells the mesh.
nlohmann::json poses_of(const test::GeomPair& geoms);

// "12.3 % too deep, 4.5 degrees off".
std::string describe(const dContactGeom* deepest, const test::Point& direction, double depth);

class Failures {
 public:
  void add(const std::string& what, const test::GeomPair& geoms);
  nlohmann::json json() const;  // the first hundred, and how many there were

 private:
  nlohmann::json first_ = nlohmann::json::array();
  std::size_t count_ = 0;
};

}  // namespace ode_ext::accuracy
