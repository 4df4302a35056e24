// SPDX-License-Identifier: BSD-3-Clause
// The kinds of mesh that are put to the question: from 12 to 70,000 triangles, flat, thin, pointed,
// hollow and bumpy, closed and open. All are about 1 m large.
#pragma once

#include <string>
#include <vector>

#include "support/mesh_makers.h"

namespace ode_ext::audit {

struct Kind {
  std::string name;
  test::TestMesh mesh;
};

std::vector<Kind> make_kinds();

}  // namespace ode_ext::audit
