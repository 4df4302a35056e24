// SPDX-License-Identifier: BSD-3-Clause
#include "ode/batch_collider.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "collide/own_work.h"
#include "ode/contact_export.h"
#include "ode/messages.h"
#include "ode/pass_stats.h"
#include "ode/program_callbacks.h"
#include "ode/stopwatch.h"
#include "ode/trace.h"
#include "opencl/error.h"

namespace ode_ext {
namespace {

// How many answers made outside of any pass are kept, for programs that never make one, or so many
// times the most that are asked for at once.
constexpr std::uint64_t kAnswersOutside = 65536;
constexpr std::uint64_t kTimesAsked = 8;

// Temporal data of spaces beside the one that is collided: what a device can easily spare.
std::size_t most_temporal_bytes(const DeviceInfo& info) {
  return static_cast<std::size_t>(info.largest_buffer / 16);
}

// Whoever waits is told for what: a driver that has not seen the kernels before takes seconds, that
// of NVIDIA a minute.
const ColliderOptions& announced(const ColliderOptions& options) {
  const DeviceInfo info = choose_device(options.device);
  log(LogLevel::kInfo, "building the kernels for device '" + info.name + "' of " +
                           info.platform_name + ", driver " + info.driver + ", " + info.version +
                           "; the first time this may take a minute");
  return options;
}

}  // namespace

BatchCollider::BatchCollider(const ColliderOptions& options, float open_thickness,
                             bool trust_meshes, bool triangle_callbacks)
    : known_(announced(options), open_thickness, trust_meshes, stats_),
      triangle_callbacks_(triangle_callbacks),
      finds_crossings_(options.edges),
      device_name_(known_.collider().device_info().name) {
  log(LogLevel::kInfo, "the kernels are ready");
}

bool BatchCollider::claim() {
  const OwnWork work(mutex_);
  hear_announcements();
  if (depth_ != 0 && pass_thread_ != std::this_thread::get_id())
    throw std::runtime_error(
        "another thread runs a pass of this collider; give each thread a collider of its own");
  pass_thread_ = std::this_thread::get_id();
  if (depth_++ == 0) {
    known_.begin_pass();
    unasked_.clear();
  }
  known_.look_again();
  return failed_;
}

void BatchCollider::unclaim(bool outer_failed) {
  const OwnWork work(mutex_);
  --depth_;
  failed_ = outer_failed;
}

bool BatchCollider::run_batch(const PassRoot& root, std::span<const PassRoot> traversed) {
  const Stopwatch whole;
  // ODE's broad phase asks geoms of the program's own classes for their boxes, which is code of the
  // program: it runs before the lock is taken.
  std::vector<GatheredPair> pairs;
  const bool may_hold_pair = may_hold_mesh_pair(root);
  if (may_hold_pair) pairs = gather_pairs(root, traversed, gathered_);
  gathered_ = pairs.size();
  const double ms_gather = whole.milliseconds();

  const HeldMessages held;
  const OwnWork work(mutex_);
  known_.look_again();
  if (depth_ == 1 && may_hold_pair) {
    known_.note_outermost(root, pairs.size());
    made_outside_ = 0;
  } else if (depth_ == 1) {
    age_where_many(0);
  }
  failed_ = false;
  begin_stats(depth_ > 1);  // this pass is one of them
  if (!may_hold_pair) {
    stats_.status |= dBatchStatusGatherSkipped;
  } else {
    stats_.ms_gather = ms_gather;
    try {
      make_anew_what_keeps_failing();
      compute_ahead(pairs, root);
      note_success();
    } catch (const std::exception& error) {
      failed_ = true;
      fail(error);
    }
  }
  if (depth_ == 1) {  // a pass may hold one for each of its spaces
    known_.prune();
    memories_.prune(known_.pass(), most_temporal_bytes(known_.collider().device_info()));
  }
  stats_.meshes = static_cast<std::int64_t>(known_.meshes().size());
  stats_.ms_pass = whole.milliseconds();
  stats_.sum_up();
  trace_pass(whole.start(), stats_);
  return (stats_.status & dBatchStatusBacktracked) != 0;
}

void BatchCollider::compute_ahead(std::span<const GatheredPair> pairs, const PassRoot& root) {
  const Stopwatch reading;
  known_.begin_batch(true);
  std::vector<Answer*> entries;
  entries.reserve(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (i + kAhead < pairs.size())
      known_.prefetch(pairs[i + kAhead].first.geom, pairs[i + kAhead].second.geom);
    entries.push_back(&known_.entry(pairs[i].first.geom, pairs[i].second.geom));
  }
  const std::uint64_t pass = known_.pass();
  const std::uint64_t members = known_.members().generation();
  std::size_t gathered = 0;
  std::size_t room_for_unasked = kUnaskedAhead;
  long long unasked_colliding = 0;  // as far as is known
  bool familiar = pairs.empty();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (i + 2 * kAhead < pairs.size()) entries[i + 2 * kAhead]->prefetch();
    if (i + kAhead < pairs.size()) entries[i + kAhead]->prefetch_seen(members);
    const GatheredPair& pair = pairs[i];
    Answer& answer = *entries[i];
    if (answer.gathering == known_.look()) continue;
    answer.gathering = known_.look();
    ++gathered;
    familiar = familiar || answer.gathered_pass != 0;
    const bool was_asked = answer.gathered_pass != 0 && answer.passes_unasked == 0;
    if (answer.gathered_pass != pass) ++answer.passes_unasked;
    answer.gathered_pass = pass;
    answer.last_round = known_.round();
    // A program filters pairs in its callback; what it never asks for is not worth computing ahead.
    if (was_asked || (answer.passes_unasked <= kPassesUnasked && room_for_unasked > 0)) {
      room_for_unasked = was_asked ? room_for_unasked + 1 : room_for_unasked - 1;
      known_.add(answer, pair);
    } else {
      unasked_.note(answer, pair, known_);
      unasked_colliding += answer.collides() ? 1 : 0;
    }
  }
  stats_.pairs = static_cast<long long>(gathered);
  stats_.ms_meshes = reading.milliseconds();
  known_.compute(&memories_.of(root, pass, familiar, pairs));
  note_report();
  stats_.pairs_colliding = known_.colliding() + unasked_colliding;
}

// `pairs`: that are asked for at once. While a pass runs it needs what it has.
void BatchCollider::age_outside(std::size_t pairs) {
  most_at_once_ = std::max<std::uint64_t>(most_at_once_, pairs);
  if (depth_ == 0) age_where_many(pairs);
}

// Bounds what is kept for a program whose passes hold no pair, where nothing else is forgotten.
void BatchCollider::age_where_many(std::size_t pairs) {
  if (made_outside_ <= std::max(kAnswersOutside, kTimesAsked * most_at_once_)) return;
  known_.age();
  made_outside_ = 0;
  most_at_once_ = pairs;
}

int BatchCollider::answer(dGeomID g1, dGeomID g2, int limit, dContactGeom* contacts, int skip) {
  AnswerCopy asked;  // for the program's callbacks to be asked without the lock
  {
    const HeldMessages held;
    const OwnWork work(mutex_);
    hear_announcements();
    const Answer* known = find_or_compute(g1, g2);
    if (known == nullptr) {
      ++stats_.pairs_stock;
      return -1;
    }
    if (!has_callbacks(g1, g2, triangle_callbacks_))
      return stats_.totals.note_answer(
          export_contacts(known->contacts, known->geoms[0], g1, g2, limit, contacts, skip));
    asked = known_.copy_of(*known);
  }
  const int count = export_asked(asked, g1, g2, limit, contacts, skip);
  const OwnWork work(mutex_);
  return stats_.totals.note_answer(count);
}

// Null: the device fails, or has no room for the pair.
const Answer* BatchCollider::find_or_compute(dGeomID g1, dGeomID g2) {
  const std::uint64_t pass = known_.pass();
  const bool alone = !is_within_a_pass();
  Answer* known = known_.find(g1, g2);
  bool was_unasked = false;
  if (known != nullptr) {
    was_unasked = (!alone || depth_ == 0) && known->noted_pass == pass;
    known->last_round = known_.round();
    known->passes_unasked = 0;
    if (was_unasked) unasked_.note_question();
  }
  // Outside of any pass nothing has read the meshes since the last question.
  std::optional<KnownPairs::LookBetween> look;
  if (alone) look.emplace(known_);
  const auto holds_now = [&] { return known != nullptr && known_.holds(*known, g1, g2, true); };
  const auto is_given_up = [&] { return !alone && known != nullptr && known_.is_given_up(*known); };
  try {
    if (holds_now()) return known;
    if ((!alone && failed_) || is_given_up()) return nullptr;
    if (was_unasked && unasked_.expects_others()) {
      stats_.pairs_colliding += unasked_.compute_from(*known, known_);
      stats_.count_more(static_cast<std::int64_t>(known_.collider().report().pairs) -
                        known_.given_up());
      if (!known_.why_given_up().empty()) note_given_up();
      if (holds_now()) return known;
      if (is_given_up()) return nullptr;
      // It has been moved since the pass, and so may the others.
      if (alone) unasked_.clear();
    }
    if (alone) make_anew_what_keeps_failing();
    age_outside(1);
    ++made_outside_;
    known = &known_.entry(g1, g2);
    if (was_unasked) stats_.pairs_colliding -= known->collides() ? 1 : 0;
    known->last_round = known_.round();
    known_.begin_batch(false);
    known_.add(*known, GatheredPair{{g1, g1}, {g2, g2}});
    known_.compute(nullptr);
    if (!known->valid) {
      note_given_up(alone);
      return nullptr;
    }
    if (was_unasked) stats_.pairs_colliding += known_.colliding();
    health_.note_success();
    if (alone) failure_said_ = false;
    if (std::exchange(failed_alone_, false)) stats_.status &= ~unsigned{dBatchStatusDeviceFailed};
  } catch (const std::exception& error) {
    if (!alone) failed_ = true;  // one attempt is enough for this pass
    fail(error, alone);
    return nullptr;
  }
  ++stats_.pairs_alone;
  return known;
}

int BatchCollider::export_asked(const AnswerCopy& asked, dGeomID g1, dGeomID g2, int limit,
                                dContactGeom* contacts, int skip) const {
  return export_contacts(ask_program(asked, limit, triangle_callbacks_), asked.members[0].geom, g1,
                         g2, limit, contacts, skip);
}

bool BatchCollider::holds(dGeomID g1, dGeomID g2, bool waits) {
  const HeldMessages held;
  const NotCancelled not_cancelled;
  std::unique_lock lock(mutex_, std::defer_lock);
  if (waits)
    lock.lock();
  else if (!lock.try_lock())
    return false;
  const DefaultArithmetic arithmetic;
  hear_announcements();
  Answer* known = known_.find(g1, g2);
  return known != nullptr && known_.holds(*known, g1, g2, is_within_a_pass());
}

void BatchCollider::begin_stats(bool within_a_pass) {
  failed_alone_ = false;
  PassStats fresh{};
  if (within_a_pass)
    fresh.status = stats_.status & ~unsigned{dBatchStatusGatherSkipped | dBatchStatusBacktracked};
  fresh.passes = static_cast<long long>(known_.pass());
  fresh.pairs_alone = stats_.pairs_alone;
  fresh.pairs_stock = stats_.pairs_stock;
  fresh.totals = stats_.totals;
  stats_ = fresh;
}

void BatchCollider::note_report() {
  ode_ext::note_report(known_.collider().report(), stats_);
  stats_.pairs_computed -= known_.given_up();
  stats_.deformed = static_cast<long long>(known_.meshes().take_deformed());
}

void BatchCollider::announce_change(dTriMeshDataID data) { announce(data, false); }
void BatchCollider::forget(dTriMeshDataID data) { announce(data, true); }

// Heard at once, so that what is gone takes no memory, or where another thread has the lock by who
// takes it next.
void BatchCollider::announce(dTriMeshDataID data, bool is_gone) {
  {
    const std::lock_guard lock(announced_mutex_);
    announced_[data] |= is_gone;
    is_announced_ = true;
  }
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (lock) hear_announcements();
}

// Under the lock. What was gone and changed since is gone: nothing is known of it.
void BatchCollider::hear_announcements() {
  if (!is_announced_) return;
  std::unordered_map<dTriMeshDataID, bool> heard;
  {
    const std::lock_guard lock(announced_mutex_);
    is_announced_ = false;
    heard.swap(announced_);
  }
  for (const auto& [data, is_gone] : heard) {
    if (is_gone) {
      known_.meshes().forget(data);
      known_.members().forget(data);
    } else {
      known_.meshes().announce_change(data);
    }
  }
}

void BatchCollider::set_deformable(dTriMeshDataID data, bool deformable) {
  const OwnWork work(mutex_);
  hear_announcements();
  known_.meshes().set_deformable(data, deformable);
}

PassStats BatchCollider::stats() {
  const OwnWork work(mutex_);
  return stats_;
}

}  // namespace ode_ext
