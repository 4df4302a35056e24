// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mesh/bvh.h"

namespace ode_ext::test {

// "" if every triangle is in exactly one leaf, every box holds its triangles and children, and
// every skip link leaves its subtree; else the first fault in words.
std::string validate_bvh(const Bvh& bvh, const std::vector<Vec3f>& vertices,
                         const std::vector<Triangle>& triangles);

}  // namespace ode_ext::test
