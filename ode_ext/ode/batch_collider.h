// SPDX-License-Identifier: BSD-3-Clause
// What is behind a dBatchColliderID: gathers the mesh pairs of a pass, has the pipeline collide
// those that have no valid answer yet, keeps the answers, and gives them out when dCollide asks.
#pragma once

#include <ode/ode.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <unordered_map>
#include <vector>

#include "collide/collider.h"
#include "ode/answers.h"
#include "ode/members.h"
#include "ode/mesh_store.h"
#include "ode/pair_gather.h"
#include "ode/pair_scene.h"
#include "ode/pass_stats.h"
#include "ode/space_memories.h"
#include "ode_ext/ode_ext.h"

namespace ode_ext {

class BatchCollider {
 public:
  BatchCollider(const ColliderOptions& options, float open_thickness, bool trust_meshes,
                bool triangle_callbacks);

  // The parts of a Pass (ode/pass.h). The beginning of a pass on this thread, which the collider
  // then belongs to until unclaim(). Returns whether the pass around it failed, for unclaim. Throws
  // std::runtime_error if another thread runs a pass of this collider.
  bool claim();
  void unclaim(bool outer_failed);
  // Gathers and computes; `traversed`: what the passes of this thread traverse. True: nothing is to
  // be delivered. A failing device is noted, not thrown.
  bool run_batch(const PassRoot& root, std::span<const PassRoot> traversed);

  // One batch over given mesh pairs; contacts of pair i from index i * (flags & 0xffff) on. Returns
  // the total.
  int collide_pairs(std::span<const dGeomID> geoms, int flags, dContactGeom* contacts, int skip,
                    int* counts);

  // An answer to dCollide(g1, g2), computed now if there is none. -1: ODE's own collider is to
  // answer.
  int answer(dGeomID g1, dGeomID g2, int limit, dContactGeom* contacts, int skip);
  bool holds(dGeomID g1, dGeomID g2);

  // The ids of contacts of any pairs; returns how many are known. Nothing is computed, and no geom
  // dereferenced.
  int contact_ids(const dContactGeom* contacts, int count, int skip, dBatchContactId* ids);

  bool is_passing() const { return depth_ != 0; }

  void announce_change(dTriMeshDataID data);
  void set_deformable(dTriMeshDataID data, bool deformable);
  void forget(dTriMeshDataID data);
  PassStats stats();
  const std::string& device_name() const { return device_name_; }
  const void* identity() const { return &collider_; }  // by which a capture knows it

 private:
  // All of these under the lock.
  void compute_ahead(std::span<const GatheredPair> pairs, const PassRoot& root);
  void note_unasked(Answer& answer, const GatheredPair& pair);
  void compute_unasked();
  void compute_pairs(std::span<const dGeomID> geoms);
  const Answer* find_or_compute(dGeomID g1, dGeomID g2);
  void count_outside(std::size_t pairs);
  void compute_alone(Answer& answer, const GatheredPair& pair);
  // The geom, if it is as it was when last seen.
  const PairMember* current_member(dGeomID geom);
  bool holds(const Answer& answer, dGeomID g1, dGeomID g2);
  AnswerCopy copy_of(const Answer& answer);
  // An answer after the program's callbacks had their say; without the lock.
  int export_asked(const AnswerCopy& asked, dGeomID g1, dGeomID g2, int limit,
                   dContactGeom* contacts, int skip) const;

  // To the scene, unless it is answered.
  void add(Answer& answer, PairMember& a, PairMember& b);
  void collide_scene(PassMemory* memory);
  // A geom as it is, looked at once for each scene.
  PairMember& member_of(const PlacedGeom& placed);

  void begin_stats(bool within_a_pass);
  void note_report();
  void fail(const std::exception& error);

  // Never held while code of the program runs: its callbacks, the box functions of its geom
  // classes, its message handler.
  std::mutex mutex_;
  Collider collider_;
  MeshStore meshes_;
  Members members_;
  Answers answers_;
  const bool triangle_callbacks_;
  SpaceMemories memories_;  // of collider_, and gone before it

  std::atomic<int> depth_{0};
  std::thread::id pass_thread_;
  std::uint64_t pass_ = 0;  // outermost passes
  std::uint64_t look_ = 0;  // meshes are read anew when it changes
  std::uint64_t asked_outside_ = 0;
  // What the outermost pass met and did not compute ahead, and how often it was asked for.
  std::vector<std::array<dGeomID, 2>> unasked_pairs_;
  std::unordered_map<dGeomID, PairMember> unasked_members_;  // data, mesh and given pose
  std::uint64_t asked_unasked_ = 0;
  bool failed_ = false;        // the pass that runs is answered by ODE's own collider
  bool failure_said_ = false;  // one message per run of failures

  PairScene scene_;  // that is being built
  PassStats stats_;
  std::string device_name_;
};

}  // namespace ode_ext
