// SPDX-License-Identifier: BSD-3-Clause
#include "collide/collider.h"

#include <algorithm>
#include <chrono>

#include "contacts/contacts.h"
#include "opencl/error.h"

namespace ode_ext {

const PairContacts& Collider::collide(const Scene& scene, PassMemory* memory) {
  const auto start = std::chrono::steady_clock::now();
  const long long waits = device_.synchronizations();
  report_ = {};
  report_.pairs = scene.pairs.size();
  given_up_in_a_row_ = 0;
  result_.clear();
  if (scene.pairs.empty()) return result_;

  Batch batch{scene, memory, report_,
              Workload(options_, device_, data_.lists, scene, memory, report_)};
  try {
    upload(scene);
    if (paper_) paper_->begin_batch(batch);
    while (batch.workload.next()) collide_tile(batch);
    if (!device_.is_idle()) device_.finish();  // uploads for what was then given up
  } catch (...) {
    drop(batch);
    throw;
  }
  finish(batch);
  report_.synchronizations = static_cast<int>(device_.synchronizations() - waits);
  report_.ms_total =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return result_;
}

// What all tiles have in common.
void Collider::upload(const Scene& scene) {
  data_.meshes.set(scene.meshes);  // the deform step
  data_.pairs.upload_objects(scene);
}

void Collider::collide_tile(Batch& batch) {
  const auto work = report_.work;  // of the tiles before
  try {
    do {
      report_.work = work;
      attempt(batch);
    } while (!batch.workload.is_settled());
    read_back_.read_rest(data_);
  } catch (const DeviceError& error) {
    report_.work = work;
    forget_uploads();
    if (!batch.workload.try_smaller(error.code()) && !give_up(batch, error)) throw;
    if (batch.remembers()) batch.memory->temporal.reset();  // how far what moved is forgotten, too
    upload(batch.scene);
    return;
  }
  deliver(batch);
}

// Between launches nobody waits, unless pairs are left to the kernels, or for exact workloads.
void Collider::attempt(Batch& batch) {
  Workload& workload = batch.workload;
  workload.begin_attempt();
  data_.pairs.upload_pairs(batch.scene, workload.tile(), whole_step_.has_value());
  if (paper_) paper_->begin_attempt(data_, batch);
  read_back_.reserve(data_);

  if (whole_step_) {
    data_.launch(*whole_step_, workload.launch_shares());
    if (!workload.expects_left()) {
      read_back_.read(data_, workload.predicted(List::kContacts));
      if (data_.lists.counted(OX_COUNTER_LEFT) == 0) return;
    }
  }
  launch_steps(batch);
  read_back_.read(data_, workload.predicted(List::kContacts));
}

// GRAPP figure 1, top to bottom: pairs, where their edges cross, which vertices are inside, where
// their rays leave, contacts.
void Collider::launch_steps(Batch& batch) {
  Workload& workload = batch.workload;
  const std::size_t pairs = workload.tile().count;
  if (!whole_step_) data_.launch(search_.pair_step, workload.launch(pairs));
  if (options_.edges) {
    data_.launch(search_.cull, workload.launch_each(pairs));
    data_.launch(search_.match, workload.settle_launch(List::kMeshlets));
    data_.launch(search_.cross,
                 workload.settle_launch(List::kMeshletPairs, search_.items_per_meshlet_pair));
  }
  if (paper_) {
    paper_->run(data_, batch);
  } else {
    data_.launch(search_.flood, workload.launch_queue(2 * pairs));
    if (!batch.floods_all) data_.launch(search_.vertex_step, workload.settle_launch(List::kChunks));
    data_.launch(search_.ray_step, workload.settle_launch(List::kRays));
  }
  workload.settle_launches();
  assembly_.run(workload.launch(pairs),
                std::max(workload.launch(List::kCrossings), workload.launch(List::kHits)),
                workload.launch_queue(pairs), data_);
}

void Collider::deliver(Batch& batch) {
  given_up_in_a_row_ = 0;
  batch.workload.report_tile();
  if (report_.backtracked) return result_.clear();
  append_contacts(batch.scene, data_.meshes, batch.workload.tile().first,
                  data_.pairs.in_order(read_back_.ranges(data_)), read_back_.contacts(data_),
                  options_.max_contacts_deformable == 0, result_);
}

// A pair that the device has no room for, of a scene of others. Where several in a row have none,
// that says more of the device than of the pairs.
constexpr int kMostGivenUp = 4;

bool Collider::give_up(Batch& batch, const DeviceError& error) {
  const Tile tile = batch.workload.tile();
  if (!is_no_room(error.code()) || tile.count != 1 || batch.scene.pairs.size() < 2 ||
      ++given_up_in_a_row_ > kMostGivenUp)
    return false;
  data_.lists.release();
  report_.given_up.push_back(tile.first);
  report_.why_given_up = error.what();
  result_.ranges.push_back({result_.contacts.size(), 0});
  return true;
}

// Of what is uploaded only where it changed: some may not have been made.
void Collider::forget_uploads() {
  data_.meshes.forget();
  data_.lists.forget();
  if (paper_) paper_->forget();
}

// A batch that failed. What it has left may be half written: nobody is to start from it.
void Collider::drop(Batch& batch) {
  device_.settle();     // what is still in flight must not write into what the next batch reuses
  take_milliseconds();  // of what ran; the next batch starts afresh
  forget_uploads();
  if (batch.memory == nullptr) return;
  batch.memory->temporal.reset();
  batch.memory->tile_pairs = batch.tile_pairs;  // no size failed: that tells nothing
}

}  // namespace ode_ext
