// SPDX-License-Identifier: BSD-3-Clause
// Contacts of two meshes by features, regions, planes, manifolds and reduction, as an oracle: plain
// double precision, one thread, no code shared with the library. For rigid meshes, closed or open;
// sheets and deformable meshes are not distinguished.
//
// Every step is a definition of its own (contact_pair.h, contact_features.h, contact_planes.h,
// contact_manifolds.h), and its result is kept, so that it can be compared with another's. What is
// chosen is chosen under a total order of values and places: the order in which a program lists
// its triangles does not show.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "reference/contact_features.h"
#include "reference/contact_manifolds.h"
#include "reference/contact_mesh.h"

namespace ode_ext::test {

struct ReferenceContact {
  Point position, normal;        // world; the normal is unit and into A
  double depth;                  // [m]
  std::array<int, 2> triangles;  // of A and of B, as in their TestMesh
  std::size_t region, manifold;
  std::size_t feature;  // kNowhere: midway between two edges
};

struct ReferenceContacts {
  double epsilon;  // [m]
  ContactFeatures found;
  std::vector<ContactManifold> manifolds;
  std::vector<ReferenceContact> all;       // of all manifolds, the deepest first
  std::vector<ReferenceContact> contacts;  // at most max_contacts, such that any prefix is good
};

ReferenceContacts reference_contacts(const ContactMesh& a, const TestPose& pa, const ContactMesh& b,
                                     const TestPose& pb, const ContactOptions& options = {});

// What the manifolds have in contact, each feature with its own depth, the deepest first.
std::vector<ReferenceContact> contacts_of(const ContactPair& pair, const ContactFeatures& features,
                                          const std::vector<ContactManifold>& manifolds);

// The deepest of all, of each region, of each manifold, each time of those at least half as deep as
// the deepest that is left what is farthest from those that are kept; then whatever is left, the
// farthest first; of contacts in order. Those closer to one that is kept than the distance for its
// normal hold no better [m].
using MergeDistance = std::function<double(const Point& normal)>;
std::vector<ReferenceContact> reduced(const std::vector<ReferenceContact>& all,
                                      std::size_t max_contacts, const MergeDistance& merge);

}  // namespace ode_ext::test
