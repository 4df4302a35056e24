// SPDX-License-Identifier: BSD-3-Clause
// What is known of how deep two meshes are in each other.
#pragma once

#include <array>

#include "contacts/contact.h"
#include "search/scene.h"

namespace ode_ext {

// A mesh, and the pose of what it was made of.
struct PlacedMesh {
  const Mesh& mesh;
  const Pose& pose;
};

// The depth of a contact [m], less what is not known of it: so much the bodies stay in each other,
// for ODE to see that they touch.
double known_depth(const Contact& contact, const std::array<PlacedMesh, 2>& pair);

}  // namespace ode_ext
