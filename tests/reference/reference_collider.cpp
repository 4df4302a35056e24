// SPDX-License-Identifier: BSD-3-Clause
#include "reference/reference_collider.h"

#include <algorithm>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>

namespace ode_ext::test {
namespace {

ContactOptions current;
std::map<dTriMeshDataID, std::unique_ptr<const ContactMesh>> meshes;

// ODE gives triangles in the world alone, so they are read of a geom of their own that lies at the
// origin.
TestMesh read(dTriMeshDataID data) {
  const dGeomID geom = dCreateTriMesh(nullptr, data, nullptr, nullptr, nullptr);
  TestMesh mesh;
  for (int t = 0; t < dGeomTriMeshGetTriangleCount(geom); ++t) {
    dVector3 corners[3];
    dGeomTriMeshGetTriangle(geom, t, &corners[0], &corners[1], &corners[2]);
    for (const auto& corner : corners) {
      mesh.indices.push_back(static_cast<unsigned>(mesh.vertices.size() / 3));
      for (std::size_t k = 0; k < 3; ++k) mesh.vertices.push_back(static_cast<float>(corner[k]));
    }
  }
  dGeomDestroy(geom);
  return mesh;
}

const ContactMesh& mesh_of(dGeomID geom) {
  auto& known = meshes[dGeomTriMeshGetTriMeshDataID(geom)];
  if (!known) known = std::make_unique<const ContactMesh>(read(dGeomTriMeshGetTriMeshDataID(geom)));
  return *known;
}

// Which mesh is made larger shows in the last digits: always the one whose vertices are less.
bool in_order(const ContactMesh& a, const ContactMesh& b) { return !(b.vertices < a.vertices); }

void set(dContactGeom& contact, const ReferenceContact& from, dGeomID g1, dGeomID g2) {
  for (std::size_t k = 0; k < 3; ++k) {
    contact.pos[k] = from.position[k];
    contact.normal[k] = from.normal[k];
  }
  contact.depth = from.depth;
  contact.g1 = g1;
  contact.g2 = g2;
  contact.side1 = from.triangles[0];
  contact.side2 = from.triangles[1];
}

// As an override it is called with the geoms exchanged, and what it answers is turned round.
int answer(dGeomID g1, dGeomID g2, int flags, dContactGeom* contacts, int skip) {
  const Contacts found = ReferenceCollider::collide(g1, g2, current);
  const std::size_t count = std::min(found.size(), static_cast<std::size_t>(flags & 0xffff));
  auto* bytes = reinterpret_cast<unsigned char*>(contacts);
  for (std::size_t i = 0; i < count; ++i)
    *reinterpret_cast<dContactGeom*>(bytes + i * static_cast<std::size_t>(skip)) = found[i];
  return static_cast<int>(count);
}

}  // namespace

ReferenceCollider::ReferenceCollider(const ContactOptions& options) {
  current = options;
  forget();
  dSetColliderOverride(dTriMeshClass, dTriMeshClass, &answer);
}

// ODE keeps an override until it is initialised anew.
ReferenceCollider::~ReferenceCollider() { forget(); }

void ReferenceCollider::forget() { meshes.clear(); }

Contacts ReferenceCollider::collide(dGeomID g1, dGeomID g2, const ContactOptions& options) {
  const ContactMesh &m1 = mesh_of(g1), &m2 = mesh_of(g2);
  const bool ordered = in_order(m1, m2);
  const auto found = ordered ? reference_contacts(m1, pose_of(g1), m2, pose_of(g2), options)
                             : reference_contacts(m2, pose_of(g2), m1, pose_of(g1), options);
  Contacts contacts;
  for (ReferenceContact c : found.contacts) {
    if (!ordered) {
      c.normal = -1 * c.normal;
      std::swap(c.triangles[0], c.triangles[1]);
    }
    contacts.emplace_back();
    set(contacts.back(), c, g1, g2);
  }
  return contacts;
}

}  // namespace ode_ext::test
