// SPDX-License-Identifier: BSD-3-Clause
// The main path: pairs in, contacts out (GRAPP figure 1). Knows OpenCL and geometry, not ODE.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "device/buffer.h"
#include "device/program.h"
#include "pipeline/append_buffer.h"
#include "pipeline/device_meshes.h"
#include "pipeline/options.h"
#include "pipeline/prediction.h"
#include "pipeline/scene.h"
#include "pipeline/step_report.h"
#include "pipeline/steps.h"

namespace ode_ext {

class Collider {
 public:
  // Chooses the device, builds the kernels, tests and warms them up. Throws DeviceError.
  explicit Collider(const ColliderOptions& options);

  // Collides all pairs of the scene. `history` is read for the prediction and updated; nullptr: a
  // call outside of any pass. Throws DeviceError; the next call then starts afresh. Result and
  // scene index alike: contacts of pair i are result.ranges[i] into result.contacts.
  const PairContacts& collide(const Scene& scene, History* history);

  const StepReport& report() const { return report_; }
  const DeviceInfo& device_info() const { return device_.info(); }

  // For tests: what the last tile of the last step appended, in whatever order.
  std::vector<ox_chunk_task> read_tasks();
  std::vector<ox_ray> read_rays();
  std::vector<ox_hit> read_hits();

 private:
  struct Tile {
    std::size_t first, count;  // pairs
  };

  std::vector<Tile> cut_into_tiles(const Scene& scene) const;
  // What a tile can append at the very most.
  ArrowCounts bounds(const Scene& scene, Tile tile) const;
  void collide_tile(const Scene& scene, Tile tile, const ArrowCounts& predicted);
  ArrowCounts run_tile(const Scene& scene, Tile tile, const ArrowCounts& predicted);
  void reserve(const ArrowCounts& counts);
  bool overflowed(const ArrowCounts& counts) const;
  std::size_t launch_size(Arrow arrow, const ArrowCounts& predicted);
  void upload(const Scene& scene, Tile tile);
  void append_contacts(const Scene& scene, Tile tile, const ArrowCounts& actual);
  void warm_up();
  void take_kernel_times();

  ColliderOptions options_;
  Device device_;
  Program program_;
  Steps steps_;
  DeviceMeshes meshes_;

  Buffer counters_;
  Buffer objects_, pair_objects_;
  Buffer pairs_, pair_hits_, pair_ranges_, pair_segments_, candidates_;
  AppendBuffer tasks_, rays_, hits_, contacts_;
  PinnedMemory read_counters_, read_ranges_, read_contacts_;

  std::vector<ox_object> host_objects_;
  std::vector<ox_u32> host_pair_objects_;
  PairContacts result_;
  StepReport report_;
};

}  // namespace ode_ext
