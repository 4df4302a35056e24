// SPDX-License-Identifier: BSD-3-Clause
// From what the device found to contacts in the world.
#pragma once

#include <span>

#include "abi/types.h"
#include "contacts/contact.h"
#include "search/device_meshes.h"
#include "search/scene.h"

namespace ode_ext {

// Appends the contacts of the pairs from `first_pair` on: one range for each of them. Contacts of a
// pair with a deformable mesh come in no order; here they are sorted, the deepest first, if `sort`.
void append_contacts(const Scene& scene, const DeviceMeshes& meshes, std::size_t first_pair,
                     std::span<const ox_range> ranges, std::span<const ox_contact> contacts,
                     bool sort, PairContacts& result);

}  // namespace ode_ext
