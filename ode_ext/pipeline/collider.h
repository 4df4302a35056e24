// SPDX-License-Identifier: BSD-3-Clause
// The main path: pairs in, contacts out (GRAPP figure 1). Knows OpenCL and geometry, not ODE.
#pragma once

#include <cstdint>
#include <vector>

#include "device/buffer.h"
#include "device/program.h"
#include "pipeline/append_lists.h"
#include "pipeline/device_meshes.h"
#include "pipeline/options.h"
#include "pipeline/pair_buffers.h"
#include "pipeline/pass_memory.h"
#include "pipeline/prediction.h"
#include "pipeline/scene.h"
#include "pipeline/step_report.h"
#include "pipeline/steps.h"
#include "pipeline/tiles.h"

namespace ode_ext {

class Collider {
 public:
  // Chooses the device, builds the kernels, tests and warms them up. Throws DeviceError.
  explicit Collider(const ColliderOptions& options);

  // Collides all pairs of the scene. `memory` is what the last pass of the same space left, and is
  // updated; nullptr: a call outside of any pass. Throws DeviceError; the next call then starts
  // afresh. Result and scene index alike: contacts of pair i are result.ranges[i] into
  // result.contacts. No ranges at all: nothing is delivered (Misprediction::kBacktrack).
  const PairContacts& collide(const Scene& scene, PassMemory* memory);

  const StepReport& report() const { return report_; }
  const DeviceInfo& device_info() const { return device_.info(); }

 private:
  void collide_tile(const Scene& scene, Tile tile, const ArrowCounts& predicted);
  ArrowCounts run_tile(const Scene& scene, Tile tile, const ArrowCounts& predicted,
                       const ArrowCounts& most);
  void run_pipelined(const ArrowCounts& predicted);
  void run_monolithic();
  void run_search(const ArrowCounts& predicted);
  ArrowCounts read_back(Tile tile, const ArrowCounts& predicted);
  void reserve(const ArrowCounts& counts);
  void upload(const Scene& scene, Tile tile);
  ArrowCounts stored(const ArrowCounts& actual) const;
  void forget_temporal_data();
  bool remembers() const { return temporal_ != &nothing_; }
  bool may_lose() const { return misprediction_ == Misprediction::kIgnore; }

  // The counters as they are now; waits.
  const ox_u32* wait_for_counters();
  // With the exact workload: waits for the counters that the next launches go by.
  void settle_workload();
  Launch launch(Arrow list, const ArrowCounts& predicted);
  Launch launch_for(std::uint64_t items) const;
  // Room for the work of the kernel to be launched, and what it did.
  void expect_work(std::uint64_t items);
  void take_work(Worker worker, std::uint64_t items);
  // While work is counted: waits, and says how much input the last kernel had.
  std::uint64_t wait_if_counting(Arrow list);

  void warm_up();
  void take_kernel_times();

  ColliderOptions options_;
  StepSettings settings_;
  Device device_;
  Program program_;
  Steps steps_;
  DeviceMeshes meshes_;
  AppendLists lists_;
  PairBuffers pairs_;
  Buffer works_;
  TemporalCache nothing_;                               // of steps that remember nothing
  PassMemory* memory_ = nullptr;                        // of the step that runs
  TemporalCache* temporal_ = &nothing_;                 // of the step that runs
  Misprediction misprediction_ = Misprediction::kRedo;  // in the step that runs
  bool deforms_ = false;                                // whether a mesh of the step is deformable
  PinnedMemory read_counters_, read_ranges_, read_contacts_;

  std::vector<ox_object> host_objects_;
  std::vector<ox_u32> host_members_, host_dense_first_;
  cl_uint dense_tasks_ = 0;
  std::vector<ox_work> host_works_;
  PairContacts result_;
  StepReport report_;
};

}  // namespace ode_ext
