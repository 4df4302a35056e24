// SPDX-License-Identifier: BSD-3-Clause
// Manifolds: by which planes the regions of a pair are cleared, and what of them is in contact.
#pragma once

#include <cstddef>
#include <vector>

#include "reference/contact_planes.h"

namespace ode_ext::test {

struct ContactManifold {
  std::size_t region;
  ContactPlane plane;
  double depth;                       // [m] moving A by that along the normal clears its units
  std::vector<std::size_t> features;  // what is in contact, ascending
  std::vector<std::size_t> units;     // what it cleared that nothing before it had
};

// Of one region. A plane that opposes one of `taken` has to be so much shallower.
std::vector<ContactManifold> clear_whole(const ContactPair& pair, const ContactFeatures& features,
                                         std::size_t region, const ContactOptions& options,
                                         const std::vector<Point>& taken);
std::vector<ContactManifold> clear_units(const ContactPair& pair, const ContactFeatures& features,
                                         std::size_t region, const ContactOptions& options,
                                         const std::vector<Point>& taken);

// Of all regions, by region. The deepest of all speaks first: of the others none chooses a plane
// that opposes it if another is at most twice as deep.
std::vector<ContactManifold> find_manifolds(const ContactPair& pair,
                                            const ContactFeatures& features,
                                            const ContactOptions& options);

bool opposes(const Point& normal, const std::vector<Point>& taken);

// Whether a feature of `side`, moved past the plane and eps beyond, is still within the other mesh.
bool stays_inside(const ContactPair& pair, std::size_t side, const Point& position,
                  const ContactPlane& plane, double depth);

}  // namespace ode_ext::test
