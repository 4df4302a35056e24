// SPDX-License-Identifier: BSD-3-Clause
// The two colliders over the same space and the same callback.
#pragma once

#include <ode/ode.h>
#include <ode_ext/ode_ext.h>

#include <string>

#include "simulation/contact_list.h"
#include "simulation/simulation_settings.h"
#include "simulation/step_record.h"

namespace falling_objects {

class Collision {
 public:
  // Creates the batch collider if the settings need it. Throws NoDevice, or std::runtime_error if
  // they ask for ODE's own collider beside it and this ODE does not export it.
  Collision(const SimulationSettings& settings, dSpaceID space);
  ~Collision();
  Collision(const Collision&) = delete;
  Collision& operator=(const Collision&) = delete;

  // Fills `contacts` and returns the wall time [ms]. Throws std::runtime_error on an error.
  double collide(Collider collider, ContactList& contacts);

  // What the last batched pass did; zeroes without a batch collider.
  void note(StepRecord& record) const;
  std::string device() const;  // empty without a batch collider
  bool has_batch() const { return batch_ != nullptr; }
  dBatchColliderID batch() const { return batch_; }

 private:
  dSpaceID space_;
  dBatchColliderID batch_ = nullptr;
};

// Else dCollide is all there is to call, which a batch collider answers.
bool ode_exports_its_collider();

struct NoDevice {
  std::string message;
};

}  // namespace falling_objects
