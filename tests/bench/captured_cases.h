// SPDX-License-Identifier: BSD-3-Clause
// Pairs that a program collided, from its capture, to time colliders by.
#pragma once

#include <string>
#include <vector>

#include "bench/pair_cases.h"

namespace ode_ext::bench {

// One case for each two meshes that met, those that met most first, of at most `pairs` of their
// poses, spread over the capture. Throws std::runtime_error with a sentence.
std::vector<PairCase> captured_cases(const std::string& file, int pairs);

}  // namespace ode_ext::bench
