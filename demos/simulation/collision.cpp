// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/collision.h"

#include <chrono>
#include <stdexcept>

#include "cloth/sheet.h"

// ODE's own trimesh-trimesh collider. The batch collider replaces it in the whole process; to time
// both in one run it is called by its exported (C++) name. Weak: an ODE built otherwise has none.
extern "C" int ode_trimesh_trimesh(dGeomID o1, dGeomID o2, int flags, dContactGeom* contacts,
                                   int skip) __asm__("_Z11dCollideTTLP6dxGeomS0_iP12dContactGeomi")
    __attribute__((weak));

namespace falling_objects {
namespace {

// As dCollide of a program that never heard of ode_ext. Two meshes of one triangle each crash ODE
// 0.16: they get no contacts.
int stock_collide(dGeomID g1, dGeomID g2, int flags, dContactGeom* contacts, int skip) {
  if (dGeomTriMeshGetTriangleCount(g1) == 1 && dGeomTriMeshGetTriangleCount(g2) == 1) return 0;
  CollideFunction* collide = ode_trimesh_trimesh != nullptr ? &ode_trimesh_trimesh : &dCollide;
  return collide(g1, g2, flags, contacts, skip);
}

void near_batched(void* contacts, dGeomID g1, dGeomID g2) {
  static_cast<ContactList*>(contacts)->collide(g1, g2, &dCollide);
}

void near_stock(void* contacts, dGeomID g1, dGeomID g2) {
  static_cast<ContactList*>(contacts)->collide(g1, g2, &stock_collide);
}

}  // namespace

bool ode_exports_its_collider() { return ode_trimesh_trimesh != nullptr; }

Collision::Collision(const SimulationSettings& settings, dSpaceID space) : space_(space) {
  if (settings.collider == Collider::kOde && !settings.compare) return;
  if (settings.compare && !ode_exports_its_collider()) {
    throw std::runtime_error("--compare: this ODE does not export its own trimesh collider");
  }
  dBatchColliderParams params;
  dBatchColliderParamsInit(&params);
  if (!settings.device.empty()) params.device = settings.device.c_str();
  params.max_contacts = settings.max_contacts;
  params.config = settings.config.c_str();
  params.trust_meshes = settings.trust_meshes;
  if (settings.has_sheets()) params.open_thickness = kSheetReach;
  batch_ = dBatchColliderCreate(&params);
  if (batch_ == nullptr) throw NoDevice{dBatchColliderGetLastErrorMessage()};
}

Collision::~Collision() { dBatchColliderDestroy(batch_); }

double Collision::collide(Collider collider, ContactList& contacts) {
  contacts.clear();
  // Both start from up-to-date boxes, whichever comes first.
  dSpaceClean(space_);
  const auto start = std::chrono::steady_clock::now();
  if (collider == Collider::kBatch) {
    // 0: nothing was delivered, and there is more room now (misprediction=backtrack).
    int result = 0;
    while (result == 0) {
      result = dBatchColliderSpaceCollide(batch_, space_, &contacts, &near_batched);
    }
    if (result < 0) throw std::runtime_error(dBatchColliderGetLastErrorMessage());
  } else {
    dSpaceCollide(space_, &contacts, &near_stock);
  }
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
  return took.count();
}

std::string Collision::device() const {
  return batch_ == nullptr ? "" : dBatchColliderGetDeviceName(batch_);
}

void Collision::note(StepRecord& record) const {
  record.stage_ms.assign(stages().size(), 0);
  if (batch_ == nullptr) return;
  record.rays = dBatchColliderGetCount(batch_, dBatchBufferRaysIterative) +
                dBatchColliderGetCount(batch_, dBatchBufferRaysBvh) +
                dBatchColliderGetCount(batch_, dBatchBufferRaysBasic) -
                dBatchColliderGetCount(batch_, dBatchCounterIterativeUnproven);
  for (std::size_t i = 0; i < stages().size(); ++i)
    record.stage_ms[i] = dBatchColliderGetTime(batch_, stages()[i]);
  record.status = static_cast<unsigned>(dBatchColliderGetStatus(batch_));
}

}  // namespace falling_objects
