// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ode_ext/ode_ext.h>

#include <span>
#include <vector>

#include "view/frame.h"

namespace falling_objects {

// As the collider tells of each contact; none of them are known to a collider of 0.
std::vector<dBatchContactRegion> regions_of(dBatchColliderID collider,
                                            std::span<const dContactGeom> contacts);

// The color that a region has in every picture.
view::Color color_of(const dContactGeom& contact, const dBatchContactRegion& region);

// Each region as its contacts span it: a spot of `radius` [m] at each of them, and what is between.
void mark_regions(std::span<const dContactGeom> contacts,
                  std::span<const dBatchContactRegion> regions, float radius,
                  std::vector<view::Patch>& patches);

}  // namespace falling_objects
