// SPDX-License-Identifier: BSD-3-Clause
// Boxes along the axes.
#pragma once

#include <ode/ode.h>

#include <vector>

#include "view/frame.h"

namespace falling_objects {

// As ODE has it.
view::Box box_of(dGeomID geom);

view::Box around(const std::vector<glm::vec3>& points);
view::Box around(const std::vector<view::Box>& boxes);

// Of a ball in which most of it is [m].
float radius_of(const view::Box& box);

// `inner` touches no side of `outer`.
bool holds(const view::Box& outer, const view::Box& inner);

}  // namespace falling_objects
