// SPDX-License-Identifier: BSD-3-Clause
#include "paper/contestant.h"

#include <stdexcept>

#include "simulation/collision.h"

namespace paper {
namespace {

dBatchColliderID create(const Configuration& configuration, const std::string& device) {
  const std::string config = configuration.config();
  dBatchColliderParams params;
  dBatchColliderParamsInit(&params);
  if (!device.empty()) params.device = device.c_str();
  params.config = config.c_str();
  const dBatchColliderID collider = dBatchColliderCreate(&params);
  if (collider == nullptr)
    throw falling_objects::NoDevice{configuration.name() + ": " +
                                    dBatchColliderGetLastErrorMessage()};
  return collider;
}

void near(void* contacts, dGeomID g1, dGeomID g2) {
  static_cast<falling_objects::ContactList*>(contacts)->collide(g1, g2, &dCollide);
}

}  // namespace

Contestant::Contestant(const Configuration& configuration, const std::string& device,
                       int max_contacts)
    : configuration_(configuration),
      collider_(create(configuration, device)),
      contacts_(max_contacts) {}

Contestant::~Contestant() { dBatchColliderDestroy(collider_); }

void Contestant::collide(dSpaceID space) {
  contacts_.clear();
  if (dBatchColliderSpaceCollide(collider_, space, &contacts_, &near) < 0)
    throw std::runtime_error(configuration_.name() + ": " + dBatchColliderGetLastErrorMessage());
  if ((dBatchColliderGetStatus(collider_) & dBatchStatusDeviceFailed) != 0)
    throw std::runtime_error(configuration_.name() + ": the device failed");
  hash_ = falling_objects::hash_contacts(contacts(), falling_objects::kHashStart);
  running_hash_ = falling_objects::hash_contacts(contacts(), running_hash_);
}

}  // namespace paper
