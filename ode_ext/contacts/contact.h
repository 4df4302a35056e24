// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/vec.h"

namespace ode_ext {

// World frame [m]; the normal points into the first object of the pair, and moving that object by
// depth * normal clears the contact. Triangles are the program's indices.
struct Contact {
  Vec3d position;
  Vec3d normal;
  double depth;
  std::array<std::uint32_t, 2> triangles;
  std::array<std::uint32_t, 2> features;  // what it is of in each mesh (contact_features.h)
};

// What is found of the pairs of a scene.
struct PairContacts {
  struct Range {
    std::size_t first;
    std::uint32_t count;
  };
  std::vector<Range> ranges;  // one per pair
  std::vector<Contact> contacts;

  void clear() {
    ranges.clear();
    contacts.clear();
  }
};

}  // namespace ode_ext
