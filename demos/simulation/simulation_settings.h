// SPDX-License-Identifier: BSD-3-Clause
// What a simulation takes beside its scene.
#pragma once

#include <cstdint>
#include <string>

namespace falling_objects {

enum class Collider { kBatch, kOde };

struct SimulationSettings {
  int objects = 1000;  // how many are dropped
  int sheets = 0;
  double hz = 60;
  std::uint64_t seed = 1;

  Collider collider = Collider::kBatch;  // the one whose contacts drive the simulation
  bool compare = false;                  // collide every step with both
  int max_contacts = 16;                 // per pair
  std::string device;                    // empty: the environment, else the library's choice
  std::string config;                    // as dBatchColliderParams::config
  bool trust_meshes = false;

  bool has_sheets() const { return sheets > 0; }
};

}  // namespace falling_objects
