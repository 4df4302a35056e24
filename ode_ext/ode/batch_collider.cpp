// SPDX-License-Identifier: BSD-3-Clause
#include "ode/batch_collider.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "ode/contact_export.h"
#include "ode/contact_ids.h"
#include "ode/messages.h"
#include "ode/pass_stats.h"
#include "ode/pose_of.h"
#include "ode/program_callbacks.h"
#include "ode/stock_collider.h"
#include "ode/stopwatch.h"
#include "ode/trace.h"
#include "opencl/error.h"

namespace ode_ext {
namespace {

// How many pairs ahead answers are fetched, which have left the caches since the last pass: about
// what memory takes to come.
constexpr std::size_t kAhead = 8;

// How many answers computed outside of any pass are kept, for programs that never make one.
constexpr std::uint64_t kAnswersOutside = 65536;

// So many questions in one pass, of so many pairs that nobody asked for of late, are taken for a
// pile that wakes up: what else was not computed ahead then is, in one batch. A few of very many
// are what a program picks that filters its pairs.
bool is_a_pile_that_wakes(std::uint64_t questions, std::size_t pairs) {
  return questions >= std::max<std::uint64_t>(4, pairs / 256);
}

// Temporal data of spaces beside the one that is collided: what a device can easily spare.
std::size_t most_temporal_bytes(const DeviceInfo& info) {
  return static_cast<std::size_t>(info.largest_buffer / 16);
}

PlacedGeom placed(dGeomID geom) { return {geom, geom}; }

// What dCollide itself checks before it asks a collider.
bool can_collide(dGeomID g1, dGeomID g2) {
  return g1 != g2 && (dGeomGetBody(g1) == nullptr || dGeomGetBody(g1) != dGeomGetBody(g2));
}

// Whoever waits is told for what: a driver that has not seen the kernels before takes seconds.
const ColliderOptions& announced(const ColliderOptions& options) {
  const DeviceInfo info = choose_device(options.device);
  log(LogLevel::kInfo, "building the kernels for device '" + info.name + "' of " +
                           info.platform_name + ", driver " + info.driver + ", " + info.version +
                           "; this may take seconds, most of all the first time");
  return options;
}

}  // namespace

BatchCollider::BatchCollider(const ColliderOptions& options, float open_thickness,
                             bool trust_meshes, bool triangle_callbacks)
    : collider_(announced(options)),
      meshes_({.open_thickness = open_thickness}, trust_meshes),
      triangle_callbacks_(triangle_callbacks) {
  const DeviceInfo& info = collider_.device_info();
  log(LogLevel::kInfo, "the kernels are ready");
  device_name_ = info.name;
}

bool BatchCollider::claim() {
  const std::lock_guard lock(mutex_);
  if (depth_ != 0 && pass_thread_ != std::this_thread::get_id())
    throw std::runtime_error(
        "another thread runs a pass of this collider; give each thread a collider of its own");
  pass_thread_ = std::this_thread::get_id();
  if (depth_++ == 0) {
    ++pass_;
    asked_unasked_ = 0;
    unasked_pairs_.clear();
    unasked_members_.clear();
  }
  ++look_;
  return failed_;
}

void BatchCollider::unclaim(bool outer_failed) {
  const std::lock_guard lock(mutex_);
  --depth_;
  failed_ = outer_failed;
}

bool BatchCollider::run_batch(const PassRoot& root, std::span<const PassRoot> traversed) {
  const Stopwatch whole;
  // ODE's broad phase asks geoms of the program's own classes for their boxes, which is code of the
  // program: it runs before the lock is taken.
  std::vector<GatheredPair> pairs;
  const bool may_hold_pair = may_hold_mesh_pair(root);
  if (may_hold_pair) pairs = gather_pairs(root, traversed);
  const double ms_gather = whole.milliseconds();

  const HeldMessages held;
  const std::lock_guard lock(mutex_);
  ++look_;
  failed_ = false;
  asked_outside_ = 0;
  begin_stats(depth_ > 1);  // this pass is one of them
  if (!may_hold_pair) {
    stats_.status |= dBatchStatusGatherSkipped;
  } else {
    stats_.ms_gather = ms_gather;
    try {
      compute_ahead(pairs, root);
      if (stats_.pairs_computed != 0) failure_said_ = false;  // the device works
    } catch (const std::exception& error) {
      failed_ = true;
      fail(error);
    }
  }
  answers_.prune(pass_);
  members_.prune(pass_);
  meshes_.prune(pass_);
  memories_.prune(pass_, most_temporal_bytes(collider_.device_info()));
  stats_.meshes = static_cast<std::int64_t>(meshes_.size());
  stats_.ms_pass = whole.milliseconds();
  stats_.sum_up();
  trace_pass(whole.start(), stats_);
  return (stats_.status & dBatchStatusBacktracked) != 0;
}

void BatchCollider::compute_ahead(std::span<const GatheredPair> pairs, const PassRoot& root) {
  const Stopwatch reading;
  scene_.begin();
  std::vector<Answer*> entries;
  for (const GatheredPair& pair : pairs)
    entries.push_back(&answers_.entry(pair.first.geom, pair.second.geom));
  std::size_t gathered = 0;
  long long unasked_colliding = 0;  // as far as is known
  bool familiar = pairs.empty();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (i + kAhead < pairs.size()) entries[i + kAhead]->prefetch();
    const GatheredPair& pair = pairs[i];
    Answer& answer = *entries[i];
    if (answer.gathering == look_) continue;
    answer.gathering = look_;
    ++gathered;
    familiar = familiar || answer.gathered_pass != 0;
    if (answer.gathered_pass != pass_) ++answer.passes_unasked;
    answer.gathered_pass = answer.last_pass = pass_;
    // A program filters pairs in its callback; what it never asks for is not worth computing ahead.
    if (answer.passes_unasked <= kPassesRemembered) {
      add(answer, member_of(pair.first), member_of(pair.second));
    } else {
      note_unasked(answer, pair);
      unasked_colliding += answer.valid && !answer.contacts.empty() ? 1 : 0;
    }
  }
  stats_.pairs = static_cast<long long>(gathered);
  stats_.ms_meshes = reading.milliseconds();
  collide_scene(&memories_.of(root, pass_, familiar));
  note_report();
  stats_.pairs_colliding = scene_.colliding() + unasked_colliding;
}

// Geoms and meshes may be gone when the program asks, so all that is needed is kept, the mesh as it
// was last read: where it has changed since, the answer will not hold.
void BatchCollider::note_unasked(Answer& answer, const GatheredPair& pair) {
  if (answer.noted_pass == pass_) return;  // in a pass around this one
  answer.noted_pass = pass_;
  for (const PlacedGeom& placed : {pair.first, pair.second}) {
    const auto [place, is_new] = unasked_members_.try_emplace(placed.geom);
    if (!is_new) continue;
    members_.find(placed.geom, pass_);  // its answers may be asked for again
    const dTriMeshDataID data = dGeomTriMeshGetData(placed.geom);
    place->second.data = data;
    place->second.mesh = meshes_.keep(data, pass_);
    place->second.given = pose_of(placed);
  }
  unasked_pairs_.push_back({pair.first.geom, pair.second.geom});
}

void BatchCollider::compute_unasked() {
  scene_.begin();
  for (const auto& [first, second] : unasked_pairs_) {
    const PairMember &a = unasked_members_.at(first), &b = unasked_members_.at(second);
    if (meshes_.is_as_known(a.data, a.mesh) && meshes_.is_as_known(b.data, b.mesh))
      add(answers_.entry(first, second), members_.note(first, a.data, a.mesh, a.given, pass_),
          members_.note(second, b.data, b.mesh, b.given, pass_));
  }
  unasked_pairs_.clear();
  unasked_members_.clear();
  collide_scene(nullptr);
  stats_.count_more(static_cast<std::int64_t>(collider_.report().pairs));
}

// Bounds what is kept for a program that never makes a pass, where nothing else is forgotten.
void BatchCollider::count_outside(std::size_t pairs) {
  if (depth_ != 0) return;  // a pass forgets by itself, and needs what it has
  asked_outside_ += pairs;
  if (asked_outside_ <= kAnswersOutside) return;
  answers_.clear();
  members_.clear();
  meshes_.clear();
  asked_outside_ = 0;
}

void BatchCollider::compute_alone(Answer& answer, const GatheredPair& pair) {
  if (depth_ == 0) ++look_;
  scene_.begin();
  add(answer, member_of(pair.first), member_of(pair.second));
  collide_scene(nullptr);
}

void BatchCollider::add(Answer& answer, PairMember& a, PairMember& b) {
  scene_.add(
      answer, a, b,
      a.is_placed && b.is_placed && !meshes_.is_refused(a.data) && !meshes_.is_refused(b.data));
}

PairMember& BatchCollider::member_of(const PlacedGeom& placed) {
  PairMember* seen = members_.find(placed.geom, pass_);
  if (seen != nullptr && seen->scene == scene_.number()) return *seen;
  const dTriMeshDataID data = dGeomTriMeshGetData(placed.geom);
  const auto& mesh = meshes_.refresh(data, look_, pass_);
  PairMember& member = members_.note(placed.geom, data, mesh, pose_of(placed), pass_);
  member.scene = scene_.number();
  if (meshes_.is_refused(data)) stats_.status |= dBatchStatusMeshRefused;
  if (!member.is_placed) stats_.status |= dBatchStatusPoseRefused;
  if (meshes_.has_left_box(data)) stats_.status |= dBatchStatusMeshLeftBox;
  return member;
}

// Within a pass every mesh is looked at once.
const PairMember* BatchCollider::current_member(dGeomID geom) {
  const dTriMeshDataID data = dGeomTriMeshGetData(geom);
  const std::shared_ptr<const Mesh> mesh =
      depth_ != 0 ? meshes_.refresh(data, look_, pass_)
                  : meshes_.known(data, dGeomTriMeshGetTriangleCount(geom));
  if (mesh == nullptr) return nullptr;
  return members_.find_same(geom, data, mesh.get(), pose_of(geom), pass_);
}

bool BatchCollider::holds(const Answer& answer, dGeomID g1, dGeomID g2) {
  const PairMember* a = current_member(g1);
  const PairMember* b = a != nullptr ? current_member(g2) : nullptr;
  return b != nullptr && answer.holds(*a, *b);
}

// Of one that holds.
AnswerCopy BatchCollider::copy_of(const Answer& answer) {
  return {{members_.at(answer.geoms[0], answer.stamps[0]),
           members_.at(answer.geoms[1], answer.stamps[1])},
          answer.contacts};
}

void BatchCollider::collide_scene(PassMemory* memory) {
  const PairContacts& found = scene_.collide(collider_, meshes_, memory);
  if (collider_.report().backtracked) {  // nothing to keep
    scene_.drop();
    return;
  }
  const Stopwatch storing;
  scene_.store(found);
  if (memory != nullptr) stats_.ms_export = storing.milliseconds();
}

int BatchCollider::answer(dGeomID g1, dGeomID g2, int limit, dContactGeom* contacts, int skip) {
  AnswerCopy asked;  // for the program's callbacks to be asked without the lock
  {
    const HeldMessages held;
    const std::lock_guard lock(mutex_);
    const Answer* known = find_or_compute(g1, g2);
    if (known == nullptr) {
      ++stats_.pairs_stock;
      return -1;
    }
    if (!has_callbacks(g1, g2, triangle_callbacks_))
      return stats_.totals.note_answer(
          export_contacts(known->contacts, known->geoms[0], g1, g2, limit, contacts, skip));
    asked = copy_of(*known);
  }
  const int count = export_asked(asked, g1, g2, limit, contacts, skip);
  const std::lock_guard lock(mutex_);
  return stats_.totals.note_answer(count);
}

// Null: the device fails.
const Answer* BatchCollider::find_or_compute(dGeomID g1, dGeomID g2) {
  Answer* known = answers_.find(g1, g2);
  bool was_unasked = false;
  if (known != nullptr) {
    was_unasked = depth_ != 0 && known->noted_pass == pass_;
    known->last_pass = pass_;
    known->passes_unasked = 0;
  }
  const auto holds_now = [&] { return known != nullptr && holds(*known, g1, g2); };
  if (holds_now()) return known;
  if (depth_ != 0 && failed_) return nullptr;
  try {
    if (was_unasked && is_a_pile_that_wakes(++asked_unasked_, unasked_pairs_.size()) &&
        !unasked_pairs_.empty()) {
      compute_unasked();
      if (holds_now()) return known;
    }
    count_outside(1);
    known = &answers_.entry(g1, g2);
    known->last_pass = pass_;
    compute_alone(*known, {placed(g1), placed(g2)});
  } catch (const std::exception& error) {
    if (depth_ != 0) failed_ = true;  // one attempt is enough for this pass
    fail(error);
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

bool BatchCollider::holds(dGeomID g1, dGeomID g2) {
  const HeldMessages held;
  const std::lock_guard lock(mutex_);
  const Answer* known = answers_.find(g1, g2);
  return known != nullptr && holds(*known, g1, g2);
}

int BatchCollider::contact_ids(const dContactGeom* contacts, int count, int skip,
                               dBatchContactId* ids) {
  const std::lock_guard lock(mutex_);
  const auto* bytes = reinterpret_cast<const unsigned char*>(contacts);
  const dContactGeom* before = nullptr;
  ContactIds of_pair({}, nullptr);
  int found = 0;
  for (int i = 0; i < count; ++i) {
    const auto& contact =
        *reinterpret_cast<const dContactGeom*>(bytes + static_cast<std::ptrdiff_t>(i) * skip);
    if (before == nullptr || before->g1 != contact.g1 || before->g2 != contact.g2) {
      const Answer* known = answers_.find(contact.g1, contact.g2);
      of_pair =
          known == nullptr ? ContactIds({}, nullptr) : ContactIds(known->contacts, known->geoms[0]);
    }
    before = &contact;
    ids[i] = of_pair.id_of(contact);
    found += ids[i].feature1 != dBatchFeatureNone ? 1 : 0;
  }
  return found;
}

int BatchCollider::collide_pairs(std::span<const dGeomID> geoms, int flags, dContactGeom* contacts,
                                 int skip, int* counts) {
  const Stopwatch whole;
  const std::size_t pair_count = geoms.size() / 2;
  const int limit = flags & 0xffff;
  int total = 0;
  long long colliding = 0;
  const auto target = [&](std::size_t pair) {
    auto* bytes = reinterpret_cast<unsigned char*>(contacts);
    return reinterpret_cast<dContactGeom*>(bytes +
                                           static_cast<std::ptrdiff_t>(pair) * limit * skip);
  };
  const auto note_count = [&](std::size_t pair, int count) {
    if (counts != nullptr) counts[pair] = count;
    total += count;
    colliding += count > 0;
  };

  // What the program's code has a part in waits until the lock is gone: callbacks, and ODE's own
  // collider, which calls them.
  std::vector<std::pair<std::size_t, AnswerCopy>> to_ask;
  bool stock = false;
  {
    const HeldMessages held;
    const std::lock_guard lock(mutex_);
    begin_stats(depth_ != 0);
    try {
      compute_pairs(geoms);
      if (stats_.pairs_computed != 0) failure_said_ = false;
    } catch (const std::exception& error) {
      fail(error);
      stock = true;
    }
    for (std::size_t i = 0; i < pair_count && !stock; ++i) {
      const dGeomID g1 = geoms[2 * i], g2 = geoms[2 * i + 1];
      if (!can_collide(g1, g2)) {
        note_count(i, 0);
        continue;
      }
      const Answer& answer = answers_.entry(g1, g2);
      if (has_callbacks(g1, g2, triangle_callbacks_))
        to_ask.emplace_back(i, copy_of(answer));
      else
        note_count(
            i, export_contacts(answer.contacts, answer.geoms[0], g1, g2, limit, target(i), skip));
    }
  }
  for (const auto& [i, answer] : to_ask)
    note_count(i, export_asked(answer, geoms[2 * i], geoms[2 * i + 1], limit, target(i), skip));
  long long answered_by_stock = 0;
  for (std::size_t i = 0; i < pair_count && stock; ++i) {
    const dGeomID g1 = geoms[2 * i], g2 = geoms[2 * i + 1];
    if (!can_collide(g1, g2)) {
      note_count(i, 0);
      continue;
    }
    ++answered_by_stock;
    note_count(i, stock_collide(g1, g2, flags, target(i), skip));
  }

  const std::lock_guard lock(mutex_);
  stats_.pairs_colliding = colliding;
  stats_.pairs_stock += answered_by_stock;
  stats_.meshes = static_cast<std::int64_t>(meshes_.size());
  stats_.ms_pass = whole.milliseconds();
  return total;
}

void BatchCollider::compute_pairs(std::span<const dGeomID> geoms) {
  if (depth_ == 0) ++look_;
  count_outside(geoms.size() / 2);
  scene_.begin();
  for (std::size_t i = 0; i < geoms.size() / 2; ++i) {
    const dGeomID g1 = geoms[2 * i];
    const dGeomID g2 = geoms[2 * i + 1];
    if (!can_collide(g1, g2)) continue;
    Answer& answer = answers_.entry(g1, g2);
    answer.last_pass = pass_;
    answer.passes_unasked = 0;
    add(answer, member_of(placed(g1)), member_of(placed(g2)));
  }
  stats_.pairs = static_cast<long long>(geoms.size() / 2);
  collide_scene(nullptr);
  note_report();
}

void BatchCollider::fail(const std::exception& error) {
  scene_.drop();
  stats_.status |= dBatchStatusDeviceFailed;
  set_last_error(error.what());
  if (!failure_said_)
    log(LogLevel::kError, std::string(error.what()) + " Meanwhile ODE's own collider answers.");
  failure_said_ = true;
}

void BatchCollider::begin_stats(bool within_a_pass) {
  PassStats fresh{};
  if (within_a_pass)
    fresh.status = stats_.status & ~unsigned{dBatchStatusGatherSkipped | dBatchStatusBacktracked};
  fresh.passes = static_cast<long long>(pass_);
  fresh.pairs_alone = stats_.pairs_alone;
  fresh.pairs_stock = stats_.pairs_stock;
  fresh.totals = stats_.totals;
  stats_ = fresh;
}

void BatchCollider::note_report() {
  ode_ext::note_report(collider_.report(), stats_);
  stats_.deformed = static_cast<long long>(meshes_.take_deformed());
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

PassStats BatchCollider::stats() {
  const std::lock_guard lock(mutex_);
  return stats_;
}

}  // namespace ode_ext
