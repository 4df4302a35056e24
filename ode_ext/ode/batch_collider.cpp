// SPDX-License-Identifier: BSD-3-Clause
#include "ode/batch_collider.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <tuple>

#include "device/error.h"
#include "ode/contact_export.h"
#include "ode/messages.h"
#include "ode/pose_of.h"
#include "ode/program_callbacks.h"
#include "ode/stock_collider.h"
#include "ode/trace.h"

namespace ode_ext {
namespace {

// How many answers computed outside of any pass are kept, for programs that never make one.
constexpr std::uint64_t kAnswersOutside = 65536;

// The passes running on this thread, outermost first.
thread_local std::vector<std::pair<BatchCollider*, PassRoot>> running;

class Stopwatch {
 public:
  double milliseconds() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_)
        .count();
  }

  std::chrono::steady_clock::time_point start() const { return start_; }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Positions a float can hold with room for sums; beyond, and for NaN, there is nothing to compute.
bool is_usable(const Pose& pose) {
  for (const double r : pose.rotation)
    if (!std::isfinite(r)) return false;
  for (std::size_t k = 0; k < 3; ++k)
    if (!(std::fabs(pose.position[k]) < 1e37)) return false;
  return true;
}

PlacedGeom placed(dGeomID geom) { return {geom, pose_of(geom)}; }

// What dCollide itself checks before it asks a collider.
bool can_collide(dGeomID g1, dGeomID g2) {
  return g1 != g2 && (dGeomGetBody(g1) == nullptr || dGeomGetBody(g1) != dGeomGetBody(g2));
}

PairMember known_member(const MeshStore& meshes, dGeomID geom) {
  const dTriMeshDataID data = dGeomTriMeshGetData(geom);
  return {geom, data, meshes.known(data, dGeomTriMeshGetTriangleCount(geom)), pose_of(geom)};
}

}  // namespace

BatchCollider::Pass::Pass(BatchCollider& collider, const PassRoot& root)
    : collider_(collider), root_(root) {
  const std::lock_guard lock(collider_.mutex_);
  outer_failed_ = collider_.failed_;
  if (collider_.depth_ != 0 && collider_.pass_thread_ != std::this_thread::get_id())
    throw std::runtime_error(
        "another thread runs a pass of this collider; give each thread a collider of its own");
  collider_.run_batch(root);
  backtracked_ = (collider_.stats_.status & dBatchStatusBacktracked) != 0;
  running.emplace_back(&collider_, root);
  collider_.pass_thread_ = std::this_thread::get_id();
  ++collider_.depth_;
}

BatchCollider::Pass::~Pass() {
  running.pop_back();
  --collider_.depth_;
  collider_.failed_ = outer_failed_;
}

bool BatchCollider::Pass::deliver(void* data, dNearCallback* callback) {
  if (backtracked_) return false;
  if (root_.second == nullptr)
    dSpaceCollide(reinterpret_cast<dSpaceID>(root_.first), data, callback);
  else
    dSpaceCollide2(root_.first, root_.second, data, callback);
  return true;
}

bool BatchCollider::RootLess::operator()(const PassRoot& a, const PassRoot& b) const {
  return std::tie(a.first, a.second) < std::tie(b.first, b.second);
}

BatchCollider* BatchCollider::passing_on_this_thread() {
  return running.empty() ? nullptr : running.back().first;
}

BatchCollider::BatchCollider(const ColliderOptions& options, float open_thickness,
                             bool trust_meshes, bool triangle_callbacks)
    : collider_(options),
      meshes_(open_thickness, trust_meshes),
      triangle_callbacks_(triangle_callbacks) {
  const DeviceInfo& info = collider_.device_info();
  log(LogLevel::kInfo, "device '" + info.name + "' of " + info.platform_name + ", driver " +
                           info.driver + ", " + info.version);
  std::strncpy(stats_.device, info.name.c_str(), sizeof(stats_.device) - 1);
}

void BatchCollider::run_batch(const PassRoot& root) {
  const std::lock_guard lock(mutex_);
  const Stopwatch whole;
  if (depth_ == 0) ++pass_;
  ++look_;
  failed_ = false;
  asked_outside_ = 0;
  begin_stats();

  if (!may_hold_mesh_pair(root)) {
    stats_.status |= dBatchStatusGatherSkipped;
  } else {
    std::vector<PassRoot> traversed;
    for (const auto& [collider, outer] : running) traversed.push_back(outer);
    const Stopwatch gathering;
    const std::vector<GatheredPair> pairs = gather_pairs(root, traversed);
    stats_.ms[dBatchStageGather] = gathering.milliseconds();
    if (memories_.size() > 4096) memories_.clear();  // spaces come and go; these are only hints
    try {
      compute_ahead(pairs, memories_[root]);
      if (stats_.pairs_computed != 0) failure_said_ = false;  // the device works
    } catch (const std::exception& error) {
      failed_ = true;
      fail(error);
    }
  }
  answers_.prune(pass_);
  meshes_.prune(pass_);
  stats_.meshes = static_cast<int>(meshes_.size());
  stats_.ms[dBatchStagePass] = whole.milliseconds();
  trace_pass(whole.start(), stats_);
}

void BatchCollider::compute_ahead(std::span<const GatheredPair> pairs, PassMemory& memory) {
  const Stopwatch reading;
  begin_scene();
  std::vector<const Answer*> gathered;
  for (const GatheredPair& pair : pairs) {
    Answer& answer = answers_.entry(pair.first.geom, pair.second.geom);
    if (answer.gathering == look_) continue;
    answer.gathering = look_;
    gathered.push_back(&answer);
    if (answer.gathered_pass != pass_) ++answer.passes_unasked;
    answer.gathered_pass = answer.last_pass = pass_;
    // A program filters pairs in its callback; what it never asks for is not worth computing ahead.
    if (answer.passes_unasked <= kPassesRemembered) add_unless_answered(answer, pair);
  }
  stats_.pairs = static_cast<long long>(gathered.size());
  stats_.ms[dBatchStageMeshes] = reading.milliseconds();
  collide_scene(&memory);
  note_report();
  stats_.pairs_colliding = std::count_if(
      gathered.begin(), gathered.end(),
      [](const Answer* answer) { return answer->valid && !answer->contacts.empty(); });
}

// Bounds what is kept for a program that never makes a pass, where nothing else is forgotten.
void BatchCollider::count_outside(std::size_t pairs) {
  asked_outside_ += pairs;
  if (asked_outside_ <= kAnswersOutside) return;
  answers_.clear();
  meshes_.clear();
  asked_outside_ = 0;
}

void BatchCollider::compute_alone(Answer& answer, const GatheredPair& pair) {
  if (depth_ == 0) ++look_;
  begin_scene();
  add_unless_answered(answer, pair);
  collide_scene(nullptr);
}

void BatchCollider::begin_scene() {
  scene_.objects.clear();
  scene_.pairs.clear();
  members_.clear();
  member_index_.clear();
  pending_.clear();
}

void BatchCollider::add_unless_answered(Answer& answer, const GatheredPair& pair) {
  std::uint32_t a = member_of(pair.first);
  std::uint32_t b = member_of(pair.second);
  if (answer.holds(members_[a], members_[b])) return;
  if (!in_canonical_order(members_[a], members_[b])) std::swap(a, b);
  answer.valid = false;
  answer.members = {members_[a], members_[b]};
  answer.contacts.clear();
  if (!is_usable(members_[a].pose) || !is_usable(members_[b].pose)) {
    answer.valid = true;
    return;
  }
  scene_.pairs.push_back({a, b});
  pending_.push_back(&answer);
}

std::uint32_t BatchCollider::member_of(const PlacedGeom& placed) {
  const auto [place, is_new] =
      member_index_.try_emplace(placed.geom, static_cast<std::uint32_t>(members_.size()));
  if (is_new) {
    const dTriMeshDataID data = dGeomTriMeshGetData(placed.geom);
    const auto& mesh = meshes_.refresh(data, look_, pass_);
    if (!mesh->finite) stats_.status |= dBatchStatusMeshRefused;
    if (meshes_.has_left_box(data)) stats_.status |= dBatchStatusMeshLeftBox;
    members_.push_back({placed.geom, data, mesh, placed.pose});
  }
  return place->second;
}

void BatchCollider::collide_scene(PassMemory* memory) {
  scene_.meshes = meshes_.resident();
  for (const PairMember& member : members_)
    scene_.objects.push_back({member.pose, meshes_.index_of(member.mesh.get()),
                              reinterpret_cast<std::uintptr_t>(member.geom)});
  const PairContacts& found = collider_.collide(scene_, memory);
  if (collider_.report().backtracked) return;  // nothing to keep
  const Stopwatch storing;
  for (std::size_t i = 0; i < pending_.size(); ++i) {
    const PairContacts::Range range = found.ranges[i];
    const auto first = found.contacts.begin() + static_cast<std::ptrdiff_t>(range.first);
    pending_[i]->contacts.assign(first, first + range.count);
    pending_[i]->valid = true;
  }
  if (memory != nullptr) stats_.ms[dBatchStageExport] = storing.milliseconds();
}

int BatchCollider::answer(dGeomID g1, dGeomID g2, int limit, dContactGeom* contacts, int skip) {
  std::unique_lock lock(mutex_);
  Answer* known = answers_.find(g1, g2);
  if (known != nullptr) {
    known->last_pass = pass_;
    known->passes_unasked = 0;
  }
  if (known == nullptr || !known->holds(known_member(meshes_, g1), known_member(meshes_, g2))) {
    if (depth_ != 0 && failed_) {
      ++stats_.pairs_stock;
      return -1;
    }
    count_outside(1);
    known = &answers_.entry(g1, g2);
    known->last_pass = pass_;
    try {
      compute_alone(*known, {placed(g1), placed(g2)});
    } catch (const std::exception& error) {
      if (depth_ != 0) failed_ = true;  // one attempt is enough for this pass
      fail(error);
      ++stats_.pairs_stock;
      return -1;
    }
    ++stats_.pairs_alone;
  }
  if (!has_callbacks(g1, g2, triangle_callbacks_))
    return export_contacts(known->contacts, known->members[0].geom, g1, g2, limit, contacts, skip);
  const Answer asked = *known;
  lock.unlock();
  return export_asked(asked, g1, g2, limit, contacts, skip);
}

int BatchCollider::export_asked(const Answer& asked, dGeomID g1, dGeomID g2, int limit,
                                dContactGeom* contacts, int skip) const {
  return export_contacts(ask_program(asked, limit, triangle_callbacks_), asked.members[0].geom, g1,
                         g2, limit, contacts, skip);
}

bool BatchCollider::holds(dGeomID g1, dGeomID g2) {
  const std::lock_guard lock(mutex_);
  const Answer* known = answers_.find(g1, g2);
  return known != nullptr && known->holds(known_member(meshes_, g1), known_member(meshes_, g2));
}

int BatchCollider::collide_pairs(std::span<const dGeomID> geoms, int flags, dContactGeom* contacts,
                                 int skip, int* counts) {
  std::unique_lock lock(mutex_);
  const Stopwatch whole;
  begin_stats();
  bool stock = false;
  try {
    compute_pairs(geoms);
    if (stats_.pairs_computed != 0) failure_said_ = false;
  } catch (const std::exception& error) {
    fail(error);
    stock = true;
  }

  const int limit = flags & 0xffff;
  const auto target = [&](std::size_t pair) {
    auto* bytes = reinterpret_cast<unsigned char*>(contacts);
    return reinterpret_cast<dContactGeom*>(bytes +
                                           static_cast<std::ptrdiff_t>(pair) * limit * skip);
  };
  int total = 0;
  const auto note_count = [&](std::size_t pair, int count) {
    if (counts != nullptr) counts[pair] = count;
    total += count;
  };
  std::vector<std::pair<std::size_t, Answer>> to_ask;  // callbacks, when the lock is gone
  for (std::size_t i = 0; i < geoms.size() / 2; ++i) {
    const dGeomID g1 = geoms[2 * i];
    const dGeomID g2 = geoms[2 * i + 1];
    int count = 0;
    if (can_collide(g1, g2)) {
      const Answer& answer = answers_.entry(g1, g2);
      if (!stock && has_callbacks(g1, g2, triangle_callbacks_)) {
        if (!answer.contacts.empty()) ++stats_.pairs_colliding;
        to_ask.emplace_back(i, answer);
        continue;
      }
      count = stock ? stock_collide(g1, g2, flags, target(i), skip)
                    : export_contacts(answer.contacts, answer.members[0].geom, g1, g2, limit,
                                      target(i), skip);
      if (stock) ++stats_.pairs_stock;
    }
    if (count > 0) ++stats_.pairs_colliding;
    note_count(i, count);
  }
  stats_.meshes = static_cast<int>(meshes_.size());
  stats_.ms[dBatchStagePass] = whole.milliseconds();
  lock.unlock();
  for (const auto& [i, answer] : to_ask)
    note_count(i, export_asked(answer, geoms[2 * i], geoms[2 * i + 1], limit, target(i), skip));
  return total;
}

void BatchCollider::compute_pairs(std::span<const dGeomID> geoms) {
  if (depth_ == 0) ++look_;
  count_outside(geoms.size() / 2);
  begin_scene();
  for (std::size_t i = 0; i < geoms.size() / 2; ++i) {
    const dGeomID g1 = geoms[2 * i];
    const dGeomID g2 = geoms[2 * i + 1];
    if (!can_collide(g1, g2)) continue;
    Answer& answer = answers_.entry(g1, g2);
    answer.last_pass = pass_;
    answer.passes_unasked = 0;
    add_unless_answered(answer, {placed(g1), placed(g2)});
  }
  stats_.pairs = static_cast<long long>(geoms.size() / 2);
  collide_scene(nullptr);
  note_report();
}

void BatchCollider::fail(const std::exception& error) {
  stats_.status |= dBatchStatusDeviceFailed;
  set_last_error(error.what());
  if (!failure_said_)
    log(LogLevel::kError, std::string(error.what()) + " Meanwhile ODE's own collider answers.");
  failure_said_ = true;
}

void BatchCollider::begin_stats() {
  dBatchColliderStats fresh{};
  if (depth_ != 0)
    fresh.status = stats_.status & ~unsigned{dBatchStatusGatherSkipped | dBatchStatusBacktracked};
  fresh.passes = static_cast<long long>(pass_);
  fresh.pairs_alone = stats_.pairs_alone;
  fresh.pairs_stock = stats_.pairs_stock;
  std::memcpy(fresh.device, stats_.device, sizeof(fresh.device));
  stats_ = fresh;
}

void BatchCollider::note_report() {
  const StepReport& report = collider_.report();
  if (report.redone != 0) stats_.status |= dBatchStatusRedone;
  stats_.redone = report.redone;
  stats_.synchronizations = report.synchronizations;
  stats_.pairs_computed = static_cast<long long>(report.pairs);
  stats_.pairs_bounded = static_cast<long long>(report.pairs_bounded);
  for (std::size_t i = 0; i < kArrowCount; ++i) {
    stats_.predicted[i] = static_cast<long long>(report.predicted[i]);
    stats_.actual[i] = static_cast<long long>(report.actual[i]);
    stats_.capacity[i] = static_cast<long long>(report.capacity[i]);
  }
  if (report.missed != 0) stats_.status |= dBatchStatusMissed;
  if (report.backtracked) stats_.status |= dBatchStatusBacktracked;
  stats_.missed = static_cast<long long>(report.missed);
  stats_.iterative_unproven = static_cast<long long>(report.unproven);
  stats_.dropped = static_cast<long long>(report.dropped);
  stats_.temporal_pairs = static_cast<long long>(report.temporal_pairs);
  for (std::size_t i = 0; i < kWorkerCount; ++i) {
    const WorkCount& work = report.work[i];
    stats_.work[i] = {static_cast<long long>(work.items), static_cast<long long>(work.units),
                      static_cast<long long>(work.lockstep32),
                      static_cast<long long>(work.lockstep64)};
  }
  stats_.deformed = static_cast<long long>(meshes_.take_deformed());
  stats_.ms[dBatchStageDeformStep] = report.ms_deform_step;
  stats_.ms[dBatchStagePairStep] = report.ms_pair_step;
  stats_.ms[dBatchStageVertexStep] = report.ms_vertex_step;
  stats_.ms[dBatchStageIterativeRays] = report.ms_iterative_rays;
  stats_.ms[dBatchStageBvhRays] = report.ms_bvh_rays;
  stats_.ms[dBatchStageBasicRays] = report.ms_basic_rays;
  stats_.ms[dBatchStageMonolithic] = report.ms_monolithic;
  stats_.ms[dBatchStageEdgeStep] = report.ms_edge_step;
  stats_.ms[dBatchStageEdgeRays] = report.ms_edge_rays;
  stats_.ms[dBatchStageEdgeContacts] = report.ms_edge_contacts;
  stats_.ms[dBatchStageContactStep] = report.ms_contact_step;
  stats_.ms[dBatchStageDevice] = report.ms_total;
}

void BatchCollider::announce_change(dTriMeshDataID data) {
  const std::lock_guard lock(mutex_);
  meshes_.announce_change(data);
}

void BatchCollider::set_deformable(dTriMeshDataID data, bool deformable) {
  const std::lock_guard lock(mutex_);
  meshes_.set_deformable(data, deformable);
}

void BatchCollider::forget(dTriMeshDataID data) {
  const std::lock_guard lock(mutex_);
  meshes_.forget(data);
}

dBatchColliderStats BatchCollider::stats() {
  const std::lock_guard lock(mutex_);
  return stats_;
}

}  // namespace ode_ext
