// SPDX-License-Identifier: BSD-3-Clause
// What a program asks of answers and meshes that are known. Nothing is computed.
#include <algorithm>

#include "collide/own_work.h"
#include "ode/batch_collider.h"
#include "ode/known_contacts.h"

namespace ode_ext {

template <class Visit>
void BatchCollider::for_each_known(const dContactGeom* contacts, int count, int skip, Visit visit) {
  const OwnWork work(mutex_);
  const auto* bytes = reinterpret_cast<const unsigned char*>(contacts);
  const dContactGeom* before = nullptr;
  KnownContacts of_pair({}, nullptr);
  for (int i = 0; i < count; ++i) {
    const auto& contact =
        *reinterpret_cast<const dContactGeom*>(bytes + static_cast<std::ptrdiff_t>(i) * skip);
    if (before == nullptr || before->g1 != contact.g1 || before->g2 != contact.g2) {
      const Answer* known = known_.find(contact.g1, contact.g2);
      of_pair = known == nullptr ? KnownContacts({}, nullptr)
                                 : KnownContacts(known->contacts, known->geoms[0]);
    }
    before = &contact;
    visit(i, of_pair, contact);
  }
}

int BatchCollider::contact_ids(const dContactGeom* contacts, int count, int skip,
                               dBatchContactId* ids) {
  int found = 0;
  for_each_known(contacts, count, skip, [&](int i, KnownContacts& known, const dContactGeom& c) {
    ids[i] = known.id_of(c);
    found += ids[i].feature1 != dBatchFeatureNone ? 1 : 0;
  });
  return found;
}

int BatchCollider::contact_regions(const dContactGeom* contacts, int count, int skip,
                                   dBatchContactRegion* regions) {
  int found = 0;
  for_each_known(contacts, count, skip, [&](int i, KnownContacts& known, const dContactGeom& c) {
    regions[i] = known.region_of(c);
    if (!finds_crossings_) regions[i].overlap = dBatchOverlapNone;
    found += regions[i].region >= 0 ? 1 : 0;
  });
  return found;
}

int BatchCollider::meshlets(dTriMeshDataID data, int triangle_count, int* meshlets) {
  const OwnWork work(mutex_);
  hear_announcements();
  std::fill_n(meshlets, triangle_count, -1);
  const std::shared_ptr<const Mesh> mesh = known_.meshes().known(data, triangle_count);
  if (mesh == nullptr) return 0;
  const MeshTopology& built = *mesh->topology;
  const auto& all = built.meshlets.meshlets;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::uint32_t k = 0; k < all[i].triangle_count; ++k)
      meshlets[built.source_triangle[built.meshlets.triangles[all[i].triangle_first + k]]] =
          static_cast<int>(i);
  return static_cast<int>(all.size());
}

}  // namespace ode_ext
