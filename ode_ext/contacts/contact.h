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
  // Of overlap: one number for all contacts of the pair in one region, another in every run.
  std::uint32_t region = 0;
  // Where nothing crosses in the region: of which mesh, 1 or 2, a part is inside the other; else 0.
  std::uint32_t within = 0;
};

// What is found of the pairs of a scene.
struct PairContacts {
  struct Range {
    std::size_t first;
    std::uint32_t count;
    std::uint32_t features = 0;  // that were found of the pair, by which it took its time
  };
  std::vector<Range> ranges;  // one per pair
  std::vector<Contact> contacts;

  void clear() {
    ranges.clear();
    contacts.clear();
  }
};

}  // namespace ode_ext
