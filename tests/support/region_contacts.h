// SPDX-License-Identifier: BSD-3-Clause
// Which regions of overlap have a contact?
#pragma once

#include <span>
#include <vector>

#include "support/ode_world.h"
#include "support/regions.h"

namespace ode_ext::test {

// Contacts that are closer together than this share of the smaller mesh's size hold it up in one
// place, so one of them may stand for both: a contact counts for a region that it is this close to.
inline constexpr double kSamePlace = 0.05;

// The regions without a contact; they are in the frame of `pb`, `smaller_size` is in [m].
//
// Two surfaces that overlap by `depth` along `normal` leave it open whether the contact is on the
// one, on the other or between; all of these places are on the segment pos +- depth * normal, and
// one of them is in the overlap. So a contact covers a region whose box that segment comes near.
// (A ball of radius `depth` would not do: one deep contact would cover everything around.)
std::vector<Region> without_contact(std::span<const Region> regions,
                                    std::span<const dContactGeom> contacts, const TestPose& pb,
                                    double smaller_size);

}  // namespace ode_ext::test
