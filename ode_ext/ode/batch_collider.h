// SPDX-License-Identifier: BSD-3-Clause
// What is behind a dBatchColliderID: the lock, passes, and answers to dCollide. What it knows of
// pairs is in KnownPairs.
#pragma once

#include <ode/ode.h>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <unordered_map>
#include <utility>
#include <vector>

#include "ode/device_health.h"
#include "ode/known_pairs.h"
#include "ode/pair_output.h"
#include "ode/pass_stats.h"
#include "ode/space_memories.h"
#include "ode/unasked_pairs.h"
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
  bool holds(dGeomID g1, dGeomID g2, bool waits);

  // The ids of contacts of any pairs; returns how many are known. Nothing is computed, and no geom
  // dereferenced.
  int contact_ids(const dContactGeom* contacts, int count, int skip, dBatchContactId* ids);
  // Likewise of which regions of overlap they are.
  int contact_regions(const dContactGeom* contacts, int count, int skip,
                      dBatchContactRegion* regions);
  // Of each triangle the meshlet; returns how many there are, 0: the mesh is not known.
  int meshlets(dTriMeshDataID data, int triangle_count, int* meshlets);

  bool is_passing() const { return depth_ != 0; }

  void announce_change(dTriMeshDataID data);
  void set_deformable(dTriMeshDataID data, bool deformable);
  void forget(dTriMeshDataID data);
  PassStats stats();
  const std::string& device_name() const { return device_name_; }
  const void* identity() const { return &known_; }  // by which a capture knows it

 private:
  // An answer of which the program's callbacks are to be asked.
  using PairToAsk = std::pair<std::size_t, AnswerCopy>;

  // `by_stock`: the pairs that are left to ODE's own collider, since the device fails.
  void collide_batch(std::span<const dGeomID> geoms, PairOutput& output,
                     std::vector<PairToAsk>& to_ask, std::vector<std::size_t>& by_stock);
  // All of these under the lock.
  void compute_ahead(std::span<const GatheredPair> pairs, const PassRoot& root);
  void compute_pairs(std::span<const dGeomID> geoms);
  const Answer* find_or_compute(dGeomID g1, dGeomID g2);
  void age_outside(std::size_t pairs);
  void age_where_many(std::size_t pairs);
  // Whether this thread is; another that asks meanwhile is in none.
  bool is_within_a_pass() const {
    return depth_ != 0 && pass_thread_ == std::this_thread::get_id();
  }
  // visit(i, what is known of the pair of the i-th contact, it).
  template <class Visit>
  void for_each_known(const dContactGeom* contacts, int count, int skip, Visit visit);

  void begin_stats(bool within_a_pass);
  void note_report();
  // `alone`: of a question outside of any pass; that is no longer the status once one is answered.
  void fail(const std::exception& error, bool alone = false);
  void note_given_up(bool alone = false);
  void note_failed_status(const std::string& why, bool alone);
  // A batch that did not fail.
  void note_success();
  void make_anew_what_keeps_failing();
  void hear_announcements();
  void announce(dTriMeshDataID data, bool is_gone);

  // An answer after the program's callbacks had their say; without the lock.
  int export_asked(const AnswerCopy& asked, dGeomID g1, dGeomID g2, int limit,
                   dContactGeom* contacts, int skip) const;

  // Never held while code of the program runs: its callbacks, the box functions of its geom
  // classes, its message handler.
  std::mutex mutex_;
  PassStats stats_;
  KnownPairs known_;
  UnaskedPairs unasked_;    // by the outermost pass
  SpaceMemories memories_;  // of the collider of known_, and gone before it
  const bool triangle_callbacks_;
  const bool finds_crossings_;
  std::string device_name_;

  std::atomic<int> depth_{0};
  std::thread::id pass_thread_;
  // By questions since the last pass that held a pair, or since what is known aged: answers made,
  // and the most asked for at once.
  std::uint64_t made_outside_ = 0, most_at_once_ = 0;
  bool failed_ = false;         // the pass that runs is answered by ODE's own collider
  bool failure_said_ = false;   // one message per run of failures
  bool given_up_said_ = false;  // one as long as passes have pairs that are given up
  bool failed_alone_ = false;   // the status tells of a question outside of any pass
  DeviceHealth health_;

  // What was announced of meshes and not heard yet, each with whether it is gone: whoever announces
  // does not wait for a batch.
  std::mutex announced_mutex_;
  std::unordered_map<dTriMeshDataID, bool> announced_;
  std::atomic<bool> is_announced_{false};  // there are some: each question looks
  std::atomic<std::size_t> gathered_{0};   // by the last pass
};

}  // namespace ode_ext
