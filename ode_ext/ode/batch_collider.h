// SPDX-License-Identifier: BSD-3-Clause
// What is behind a dBatchColliderID: gathers the mesh pairs of a pass, has the pipeline collide
// those that have no valid answer yet, keeps the answers, and gives them out when dCollide asks.
#pragma once

#include <ode/ode.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "ode/answers.h"
#include "ode/mesh_store.h"
#include "ode/pair_gather.h"
#include "ode_ext/ode_ext.h"
#include "pipeline/collider.h"

namespace ode_ext {

class BatchCollider {
 public:
  BatchCollider(const ColliderOptions& options, float open_thickness, bool trust_meshes,
                bool triangle_callbacks);

  // A collide pass: the batch is computed where it begins, and while it lives dCollide on this
  // thread asks this collider first. Nests. The collider must outlive it.
  class Pass {
   public:
    // Throws std::runtime_error if another thread runs a pass of this collider. A failing device is
    // not an error: ODE's own collider then answers this pass.
    Pass(BatchCollider& collider, const PassRoot& root);
    ~Pass();
    Pass(const Pass&) = delete;
    Pass& operator=(const Pass&) = delete;
    // ODE's own pass with the program's callback, which may throw. False: nothing is delivered
    // (dBatchMispredictionBacktrack), and no callback was made.
    bool deliver(void* data, dNearCallback* callback);

   private:
    BatchCollider& collider_;
    PassRoot root_;
    bool backtracked_ = false;
    bool outer_failed_ = false;  // what failed_ was in the pass around this one
  };

  // One batch over given mesh pairs; contacts of pair i from index i * (flags & 0xffff) on. Returns
  // the total.
  int collide_pairs(std::span<const dGeomID> geoms, int flags, dContactGeom* contacts, int skip,
                    int* counts);

  // An answer to dCollide(g1, g2), computed now if there is none. -1: ODE's own collider is to
  // answer.
  int answer(dGeomID g1, dGeomID g2, int limit, dContactGeom* contacts, int skip);
  bool holds(dGeomID g1, dGeomID g2);

  bool is_passing() const { return depth_ != 0; }
  static BatchCollider* passing_on_this_thread();

  void announce_change(dTriMeshDataID data);
  void set_deformable(dTriMeshDataID data, bool deformable);
  void forget(dTriMeshDataID data);
  dBatchColliderStats stats();

 private:
  struct RootLess {
    bool operator()(const PassRoot& a, const PassRoot& b) const;
  };

  void run_batch(const PassRoot& root);
  void compute_ahead(std::span<const GatheredPair> pairs, PassMemory& memory);
  void compute_pairs(std::span<const dGeomID> geoms);
  // An answer after the program's callbacks had their say; without the lock.
  int export_asked(const Answer& asked, dGeomID g1, dGeomID g2, int limit, dContactGeom* contacts,
                   int skip) const;
  void count_outside(std::size_t pairs);
  void compute_alone(Answer& answer, const GatheredPair& pair);

  // A scene of what has no valid answer: begin, add, then collide and keep the answers.
  void begin_scene();
  void add_unless_answered(Answer& answer, const GatheredPair& pair);
  void collide_scene(PassMemory* memory);
  std::uint32_t member_of(const PlacedGeom& placed);

  void begin_stats();
  void note_report();
  void fail(const std::exception& error);

  std::recursive_mutex
      mutex_;  // ODE's broad phase may call a program's user classes, which may ask
  Collider collider_;
  MeshStore meshes_;
  Answers answers_;
  const bool triangle_callbacks_;
  std::map<PassRoot, PassMemory, RootLess> memories_;  // of collider_, and gone before it

  std::atomic<int> depth_{0};
  std::thread::id pass_thread_;
  std::uint64_t pass_ = 0;  // outermost passes
  std::uint64_t look_ = 0;  // meshes are read anew when it changes
  std::uint64_t asked_outside_ = 0;
  bool failed_ = false;        // the pass that runs is answered by ODE's own collider
  bool failure_said_ = false;  // one message per run of failures

  // The scene being built. Member i is object i.
  Scene scene_;
  std::vector<PairMember> members_;
  std::unordered_map<dGeomID, std::uint32_t> member_index_;
  std::vector<Answer*> pending_;  // pair i of the scene is for this entry
  dBatchColliderStats stats_{};
};

}  // namespace ode_ext
