// SPDX-License-Identifier: BSD-3-Clause
#include "support/region_contacts.h"

#include <algorithm>

namespace ode_ext::test {

std::vector<Region> without_contact(std::span<const Region> regions,
                                    std::span<const dContactGeom> contacts, const TestPose& pb,
                                    double smaller_size) {
  const double margin = kSamePlace * smaller_size;
  std::vector<Region> bare;
  for (const Region& region : regions) {
    const bool covered = std::any_of(contacts.begin(), contacts.end(), [&](const auto& contact) {
      const Point way = contact.depth * normal(contact);
      return region.is_near(to_local(pb, pos(contact) - way), to_local(pb, pos(contact) + way),
                            margin);
    });
    if (!covered) bare.push_back(region);
  }
  return bare;
}

}  // namespace ode_ext::test
