// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "mesh/deform.h"

namespace ode_ext::test {

// The shape that a deformable mesh, itself built or a shape, takes with its corners at `soup`.
inline std::shared_ptr<const Mesh> deformed(const std::shared_ptr<const Mesh>& mesh,
                                            const TriangleSoup& soup) {
  return ode_ext::deformed(mesh->topology, soup, mesh->open_thickness);
}

}  // namespace ode_ext::test
