// SPDX-License-Identifier: BSD-3-Clause
// Collides the passes of one captured collider again, through the public API alone.
#pragma once

#include <ode_ext/ode_ext.h>

#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "tools/replay/capture_file.h"

namespace ode_ext::replay {

// No collider can be created, or the device fails.
class DeviceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Played {
  std::vector<std::uint32_t> counts;  // a pair
  std::vector<capture::Contact> contacts;
  double ms = 0;  // of the calls that collide
};

class PlayedMesh;

class Player {
 public:
  // `device` as ODE_EXT_DEVICE, null: the environment; `config` null: as captured. Meshes are those
  // of the capture, which grow while it is read.
  Player(const ColliderRecord& record, const std::vector<MeshRecord>& meshes, const char* device,
         const char* config);
  ~Player();
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  const char* device_name() const;
  // Once for each repetition: with geoms of their own, so that no answer is known before.
  std::vector<Played> play(const PassRecord& pass, int repetitions);

 private:
  PlayedMesh& mesh(std::uint32_t number);
  std::vector<dGeomID> place(const PassRecord& pass);
  Played collide(const std::vector<dGeomID>& geoms, std::span<const capture::Pair> pairs);
  void collide_call(std::span<const dGeomID> geoms, int limit, std::vector<int>& counts);
  void forget_shapes();

  const std::vector<MeshRecord>& records_;
  dBatchColliderID collider_;
  dSpaceID empty_;
  int max_contacts_;
  std::map<std::uint32_t, std::unique_ptr<PlayedMesh>> meshes_;
  std::vector<dContactGeom> contacts_;
};

}  // namespace ode_ext::replay
