// SPDX-License-Identifier: BSD-3-Clause
// The main path: pairs in, contacts out (GRAPP figure 1).
#pragma once

#include <memory>
#include <optional>

#include "collide/batch.h"
#include "collide/batch_report.h"
#include "collide/options.h"
#include "collide/pass_memory.h"
#include "collide/read_back.h"
#include "contacts/contact.h"
#include "contacts/plane_assembly.h"
#include "opencl/error.h"
#include "opencl/program.h"
#include "paper/vertex_rays.h"
#include "search/batch_data.h"
#include "search/scene.h"
#include "search/search.h"

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

  const BatchReport& report() const { return report_; }
  const DeviceInfo& device_info() const { return device_.info(); }
  // Its own, of this very device, whatever else there is now.
  ColliderOptions options_here() const;

 private:
  void upload(const Scene& scene);
  void collide_tile(Batch& batch);
  void attempt(Batch& batch);
  void launch_steps(Batch& batch);
  void deliver(Batch& batch);
  bool give_up(Batch& batch, const DeviceError& error);
  void forget_uploads();
  void drop(Batch& batch);
  void finish(Batch& batch);
  StageTimes take_milliseconds();
  void warm_up();
  Program& of_groups() { return group_program_ ? *group_program_ : program_; }

  ColliderOptions options_;
  Device device_;
  std::unique_ptr<Program> group_program_;  // where lanes are groups
  Program program_;
  Search search_;
  PlaneAssembly assembly_;
  BatchData data_;
  // Where options ask for them.
  std::optional<Kernel> whole_step_;  // kernels/whole_step.cl
  std::optional<paper::VertexRays> paper_;
  ReadBack read_back_;
  PairContacts result_;
  BatchReport report_;
  int given_up_in_a_row_ = 0;
};

// A collider that is made in the driver thread (opencl/driver_thread.h): on a thread of the
// program's there is no other way.
std::unique_ptr<Collider> make_collider(const ColliderOptions& options);

}  // namespace ode_ext
