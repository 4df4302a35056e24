// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/show/hand.h"

#include "falling_objects/show/mesh_of_geom.h"
#include "simulation/scene.h"

namespace falling_objects {

bool Hand::take(dSpaceID space, glm::vec3 eye, glm::vec3 direction) {
  constexpr double kReach = 1e4;  // [m]
  body_ = nullptr;
  dGeomID ray = dCreateRay(nullptr, kReach);
  dGeomRaySet(ray, eye.x, eye.y, eye.z, direction.x, direction.y, direction.z);
  dGeomRaySetClosestHit(ray, 1);
  double nearest = kReach;
  const int count = dSpaceGetNumGeoms(space);
  for (int i = 0; i < count; ++i) {
    dGeomID geom = dSpaceGetGeom(space, i);
    if ((dGeomGetCategoryBits(geom) & kMeshBit) == 0) continue;
    dContactGeom hit;
    if (dCollide(geom, ray, 1, &hit, sizeof hit) == 0 || hit.depth >= nearest) continue;
    nearest = hit.depth;  // what is in front hides what is behind, even if it cannot be taken
    body_ = dGeomGetBody(geom);
    if (body_ == nullptr) continue;
    if (dBodyIsKinematic(body_) != 0) body_ = nullptr;
    if (body_ != nullptr) dBodyGetPosRelPoint(body_, hit.pos[0], hit.pos[1], hit.pos[2], place_);
  }
  dGeomDestroy(ray);
  distance_ = static_cast<float>(nearest);
  move(eye, direction);
  return holds();
}

void Hand::pull() const {
  if (!holds()) return;
  constexpr double kRate = 12;  // [1/s]
  dVector3 at, velocity;
  dBodyGetRelPointPos(body_, place_[0], place_[1], place_[2], at);
  dBodyGetPointVel(body_, at[0], at[1], at[2], velocity);
  dMass mass;
  dBodyGetMass(body_, &mass);
  dVector3 force;
  for (int k = 0; k < 3; ++k) {
    const double away = static_cast<double>(target_[k]) - at[k];
    force[k] = mass.mass * kRate * (kRate * away - 2 * velocity[k]);
  }
  dBodyEnable(body_);
  dBodyAddForceAtPos(body_, force[0], force[1], force[2], at[0], at[1], at[2]);
  // Held at one place it would swing about it without end.
  const dReal* spin = dBodyGetAngularVel(body_);
  const double damping = 3 * mass.I[0];
  dBodyAddTorque(body_, -damping * spin[0], -damping * spin[1], -damping * spin[2]);
}

}  // namespace falling_objects
