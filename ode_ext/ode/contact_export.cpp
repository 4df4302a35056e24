// SPDX-License-Identifier: BSD-3-Clause
#include "ode/contact_export.h"

#include <algorithm>
#include <utility>

namespace ode_ext {

std::string fault_of_stride(int skip) {
  if (skip >= static_cast<int>(sizeof(dContactGeom))) return "";
  return "skip is " + std::to_string(skip) +
         ", less than sizeof(dContactGeom) = " + std::to_string(sizeof(dContactGeom));
}

int export_contacts(std::span<const Contact> contacts, dGeomID first, dGeomID g1, dGeomID g2,
                    int limit, dContactGeom* target, int skip) {
  const bool swapped = g1 != first;
  const int count = static_cast<int>(std::min(contacts.size(), static_cast<std::size_t>(limit)));
  auto* bytes = reinterpret_cast<unsigned char*>(target);
  for (int i = 0; i < count; ++i) {
    const Contact& contact = contacts[static_cast<std::size_t>(i)];
    auto& geom = *reinterpret_cast<dContactGeom*>(bytes + static_cast<std::ptrdiff_t>(i) * skip);
    for (std::size_t k = 0; k < 3; ++k) {
      geom.pos[k] = static_cast<dReal>(contact.position[k]);
      geom.normal[k] = static_cast<dReal>(swapped ? -contact.normal[k] : contact.normal[k]);
    }
    geom.pos[3] = 0;
    geom.normal[3] = 0;
    geom.depth = static_cast<dReal>(contact.depth);
    geom.g1 = g1;
    geom.g2 = g2;
    geom.side1 = static_cast<int>(contact.triangles[swapped ? 1 : 0]);
    geom.side2 = static_cast<int>(contact.triangles[swapped ? 0 : 1]);
  }
  return count;
}

void turn_round(dContactGeom& contact) {
  for (int k = 0; k < 3; ++k) contact.normal[k] = -contact.normal[k];
  std::swap(contact.g1, contact.g2);
  std::swap(contact.side1, contact.side2);
}

}  // namespace ode_ext
