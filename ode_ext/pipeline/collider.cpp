// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/collider.h"

#include <algorithm>
#include <chrono>

#include "device/error.h"
#include "pipeline/contacts.h"

namespace ode_ext {

const PairContacts& Collider::collide(const Scene& scene, PassMemory* memory) {
  const auto start = std::chrono::steady_clock::now();
  const long long synchronizations = device_.synchronizations();
  report_ = {};
  report_.pairs = scene.pairs.size();
  result_.ranges.clear();
  result_.contacts.clear();
  if (scene.pairs.empty()) return result_;

  Step step{scene, memory, report_,
            Workload(options_, device_, data_.lists, scene, memory, report_)};
  try {
    upload(step);
    while (step.workload.next()) collide_tile(step);
  } catch (...) {
    drop(step);
    throw;
  }
  finish(step);
  report_.synchronizations = static_cast<int>(device_.synchronizations() - synchronizations);
  report_.ms_total =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return result_;
}

// What all tiles have in common; the deform step is among it.
void Collider::upload(Step& step) {
  data_.meshes.set(step.scene.meshes);
  data_.pairs.upload_objects(step.scene);
  if (paper_) paper_->begin_step(step);
}

void Collider::collide_tile(Step& step) {
  const auto work = report_.work;  // of the tiles before
  try {
    do {
      report_.work = work;
      run(step);
    } while (!step.workload.is_settled());
    read_unpredicted(step);
  } catch (const DeviceError& error) {
    report_.work = work;
    forget_uploads();  // some may not have been made
    if (!step.workload.try_smaller(error.code())) throw;
    return;
  }
  deliver(step);
}

// GRAPP figure 1, top to bottom. Between the first launch and the last read-back nobody waits,
// unless the exact workload is asked for.
void Collider::run(Step& step) {
  Workload& workload = step.workload;
  const std::size_t pairs = workload.tile().count;
  workload.begin_run();
  data_.pairs.upload_pairs(step.scene, workload.tile());
  if (paper_) paper_->begin_run(data_, step);
  read_ranges_.reserve(pairs * sizeof(ox_range));
  read_contacts_.reserve(data_.lists.capacity(List::kContacts) * sizeof(ox_contact));

  const bool is_whole = workload.is_whole_step();
  const bool launches = !is_whole || workload.expects_left();
  if (is_whole) steps_.run_whole(workload.launch_shares(), data_);
  if (launches) launch_steps(step);
  read_answer(step);
  if (launches || data_.lists.counted(OX_COUNTER_LEFT) == 0) return;
  launch_steps(step);
  read_answer(step);
}

void Collider::read_answer(const Step& step) {
  const std::size_t pairs = step.workload.tile().count;
  data_.pairs.ranges.read(read_ranges_.data(), pairs * sizeof(ox_range));
  read_contacts(step.workload.predicted(List::kContacts));
  data_.lists.count();
}

void Collider::launch_steps(Step& step) {
  Workload& workload = step.workload;
  const std::size_t pairs = workload.tile().count;
  if (!workload.is_whole_step()) steps_.relate(workload.launch(pairs), data_);
  if (options_.edges) {
    steps_.cull(workload.launch(pairs), data_);
    workload.settle_launches();
    steps_.match(workload.launch(List::kMeshlets), data_);
    workload.settle_launches();
    steps_.cross(workload.launch(List::kMeshletPairs), data_);
  }
  if (paper_)
    paper_->run(data_, step);
  else
    launch_vertices(step);
  workload.settle_launches();
  const Launch of_crossings = workload.launch(List::kCrossings);
  const Launch of_hits = workload.launch(List::kHits);
  steps_.assemble(workload.launch(pairs),
                  of_crossings.groups > of_hits.groups ? of_crossings : of_hits,
                  workload.launch_queue(pairs), data_);
  steps_.reduce(workload.launch_queue(pairs), data_);
}

void Collider::launch_vertices(Step& step) {
  Workload& workload = step.workload;
  steps_.flood(workload.launch_queue(2 * workload.tile().count), data_);
  workload.settle_launches();
  if (!step.floods_all) {
    steps_.choose_vertices(workload.launch(List::kChunks), data_);
    workload.settle_launches();
  }
  steps_.cast(workload.launch(List::kRays), data_);
}

// At most as many as there is room for.
void Collider::read_contacts(std::uint64_t count) {
  const std::uint64_t room = data_.lists.capacity(List::kContacts);
  data_.lists.contacts().read(read_contacts_.data(), std::min(count, room) * sizeof(ox_contact));
}

void Collider::read_unpredicted(const Step& step) {
  const std::uint64_t contacts = data_.lists.length(List::kContacts);
  if (contacts <= step.workload.predicted(List::kContacts)) return;
  read_contacts(contacts);
  device_.finish();
}

void Collider::deliver(Step& step) {
  step.workload.report_tile();
  const AppendLists& lists = data_.lists;
  report_.pairs_bounded += lists.counted(OX_COUNTER_BOUNDED);
  report_.unproven += lists.counted(OX_COUNTER_UNPROVEN);
  report_.dropped += lists.counted(OX_COUNTER_DROPPED);
  report_.left += lists.counted(OX_COUNTER_LEFT);
  if (report_.backtracked) {
    result_.ranges.clear();
    result_.contacts.clear();
    return;
  }
  const Tile tile = step.workload.tile();
  append_contacts(
      step.scene, data_.meshes, tile.first,
      {static_cast<const ox_range*>(read_ranges_.data()), tile.count},
      {static_cast<const ox_contact*>(read_contacts_.data()), lists.length(List::kContacts)},
      options_.max_contacts_deformable == 0, result_);
}

// What is uploaded only where it changed.
void Collider::forget_uploads() {
  data_.lists.forget();
  if (paper_) paper_->forget();
}

// A step that failed. What it has left may be half written: nobody is to start from it.
void Collider::drop(Step& step) {
  // Whatever is still in flight must not write into memory that the next step reuses.
  try {
    device_.finish();
  } catch (const DeviceError&) {
  }
  take_milliseconds();  // of what ran; the next step starts afresh
  data_.meshes.forget();
  forget_uploads();
  if (step.memory == nullptr) return;
  step.memory->temporal.reset();
  step.memory->tile_pairs = step.tile_pairs;  // no size failed: that tells nothing
}

StageTimes Collider::take_milliseconds() {
  StageTimes ms{};
  add_time(ms, Stage::kDeformStep, data_.meshes);
  steps_.take_milliseconds(ms);
  if (paper_) paper_->take_milliseconds(ms);
  return ms;
}

void Collider::finish(Step& step) {
  report_.capacity = data_.lists.capacities();
  report_.temporal_pairs = step.remembers() ? step.memory->temporal->pairs() : 0;
  report_.ms = take_milliseconds();
  data_.lists.note_use(report_.actual, step.memory != nullptr);
  if (step.memory == nullptr) return;
  step.memory->history = {report_.pairs, report_.actual, report_.appended, report_.left};
  // A little more each time: what did not fit once may have been short of memory for a moment.
  if (step.memory->tile_pairs != 0) step.memory->tile_pairs += step.memory->tile_pairs / 16 + 1;
}

}  // namespace ode_ext
