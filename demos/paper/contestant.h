// SPDX-License-Identifier: BSD-3-Clause
// A configuration at work: its collider, and the contacts it found last.
#pragma once

#include <ode/ode.h>
#include <ode_ext/ode_ext.h>

#include <cstdint>
#include <span>
#include <string>

#include "paper/configuration.h"
#include "simulation/contact_list.h"

namespace paper {

class Contestant {
 public:
  // Throws falling_objects::NoDevice.
  Contestant(const Configuration& configuration, const std::string& device, int max_contacts);
  ~Contestant();
  Contestant(const Contestant&) = delete;
  Contestant& operator=(const Contestant&) = delete;

  // Throws std::runtime_error on an error, and if the device failed: ODE's own collider would have
  // answered.
  void collide(dSpaceID space);

  const Configuration& configuration() const { return configuration_; }
  dBatchColliderID collider() const { return collider_; }
  std::span<const dContactGeom> contacts() const { return contacts_.contacts(); }
  long long colliding_pairs() const { return contacts_.colliding_pairs(); }
  std::uint64_t hash() const { return hash_; }                  // of the last step's contacts
  std::uint64_t running_hash() const { return running_hash_; }  // of all contacts so far

 private:
  Configuration configuration_;
  dBatchColliderID collider_;
  falling_objects::ContactList contacts_;
  std::uint64_t hash_ = falling_objects::kHashStart;
  std::uint64_t running_hash_ = falling_objects::kHashStart;
};

}  // namespace paper
