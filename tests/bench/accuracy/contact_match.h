// SPDX-License-Identifier: BSD-3-Clause
// Are two lists of contacts the same but for rounding and order?
#pragma once

#include "support/ode_world.h"

namespace ode_ext::accuracy {

// A unit normal computed from float corners, in any order of these: a few roundings of 6e-8, which
// the cross product of a triangle's sides multiplies by its aspect, at most about 100 here.
inline constexpr double kNormalRounding = 1e-5;

// One to one: each contact of one list has another of the other, with place and depth within
// `tolerance` [m] and the normal within kNormalRounding.
bool same_contacts(const test::Contacts& a, const test::Contacts& b, double tolerance);

}  // namespace ode_ext::accuracy
