// SPDX-License-Identifier: BSD-3-Clause
// Speeds of the objects, and the little statistics that reports are made of.
#pragma once

#include <vector>

#include "simulation/scene.h"

namespace falling_objects {

// Of the centres of mass of what can move [m/s].
std::vector<double> speeds(const Scene& scene);

// 0 of nothing.
double mean(const std::vector<double>& values);
// The value that a share of `fraction` of all is not above: 0.5 is the median. 0 of nothing.
double quantile(std::vector<double> values, double fraction);

}  // namespace falling_objects
