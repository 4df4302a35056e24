// SPDX-License-Identifier: BSD-3-Clause
// The triangles that a contact stands for, where there are several: all at a vertex, the two at an
// edge.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ode/answers.h"

namespace ode_ext {

// Those of members[side], the program's indices, ascending; contact.triangles[side] is among them.
// Looks at every triangle of the mesh, so only for those who ask.
std::vector<std::uint32_t> triangles_of(const AnswerCopy& answer, const Contact& contact,
                                        std::size_t side);

}  // namespace ode_ext
