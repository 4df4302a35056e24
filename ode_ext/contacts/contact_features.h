// SPDX-License-Identifier: BSD-3-Clause
// What contacts are of in each mesh (feature_number.h). So they tell which contact of a pair is
// which of those it had in the pass before.
#pragma once

#include <cstdint>
#include <span>

#include "contacts/contact.h"
#include "mesh/feature_number.h"
#include "search/device_meshes.h"

namespace ode_ext {

// Of what the device says (OX_OF) of mesh `mesh`.
std::uint32_t feature_of(const DeviceMeshes& meshes, std::uint32_t mesh, std::uint32_t word);

// Two contacts of a pair may be of the same two features: an edge crosses a facet that is not quite
// flat more than once, two edges come near one another in two regions. The second gets numbers
// beyond those of all features, the third beyond those, and so on in the order of the contacts.
void number_repeats(std::span<Contact> contacts, const Mesh& a, const Mesh& b);

}  // namespace ode_ext
