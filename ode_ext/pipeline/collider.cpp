// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/collider.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <string>

#include "device/error.h"
#include "pipeline/contacts.h"
#include "pipeline/object_record.h"

namespace ode_ext {
namespace {

std::uint64_t at(const ArrowCounts& counts, Arrow arrow) {
  return counts[static_cast<std::size_t>(arrow)];
}

StepSettings settings_of(const ColliderOptions& options) {
  StepSettings settings;
  if (options.rays == Rays::kIterativePaper) settings.rays_mode |= OX_RAYS_PAPER;
  if (options.deformable_target == DeformableTarget::kBasic) settings.rays_mode |= OX_RAYS_BASIC;
  if (options.edges) settings.rays_mode |= OX_RAYS_EDGES;
  if (floods(options)) settings.rays_mode |= OX_RAYS_FLOOD;
  settings.displacement_limit = options.displacement_limit;
  settings.walk_limit = options.walk_limit;
  settings.max_contacts = options.max_contacts;
  settings.max_contacts_deformable = options.max_contacts_deformable;
  return settings;
}

std::string program_options(const ColliderOptions& options) {
  std::string text = options.count_work ? "-DOX_COUNT_WORK" : "";
  if (options.vector_width != 0)
    text += " -DOX_VECTOR_WIDTH=" + std::to_string(options.vector_width);
  return text;
}

// Codes that say "too large", of which a smaller tile may be the cure.
bool is_out_of_memory(int code) {
  return code == CL_MEM_OBJECT_ALLOCATION_FAILURE || code == CL_OUT_OF_RESOURCES ||
         code == CL_OUT_OF_HOST_MEMORY || code == CL_INVALID_BUFFER_SIZE;
}

}  // namespace

Collider::Collider(const ColliderOptions& options)
    : options_(options),
      settings_(settings_of(options)),
      device_(options.device, options.largest_buffer),
      program_(device_, program_options(options)),
      steps_(program_),
      meshes_(program_),
      lists_(device_),
      pairs_(device_),
      works_(device_),
      nothing_(device_),
      read_counters_(device_),
      read_ranges_(device_),
      read_contacts_(device_) {
  if (options_.vector_width != 0 && options_.vector_width != 1 && options_.vector_width != 4 &&
      options_.vector_width != 8 && options_.vector_width != 16)
    throw std::invalid_argument("vector_width is " + std::to_string(options_.vector_width) +
                                ", not 0, 1, 4, 8 or 16");
  if (options_.work_group_size > device_.info().work_group_limit)
    throw std::invalid_argument("work_group_size is " + std::to_string(options_.work_group_size) +
                                ", more than the " +
                                std::to_string(device_.info().work_group_limit) + " that '" +
                                device_.info().name + "' can run");
  self_test(program_);
  read_counters_.reserve(AppendLists::kCounterBytes);
  warm_up();
}

const PairContacts& Collider::collide(const Scene& scene, PassMemory* memory) {
  const auto start = std::chrono::steady_clock::now();
  const long long synchronizations_before = device_.synchronizations();
  report_ = {};
  report_.pairs = scene.pairs.size();
  result_.ranges.clear();
  result_.contacts.clear();
  if (scene.pairs.empty()) return result_;

  const bool has_history = memory != nullptr && memory->history.pairs != 0;
  const ArrowCounts predicted =
      predict(has_history ? memory->history : History{}, scene.pairs.size(), options_.prediction,
              options_.confidence);
  // Without a history nothing was predicted that could be wrong.
  misprediction_ = has_history ? options_.misprediction : Misprediction::kRedo;
  const std::vector<Tile> tiles = cut_into_tiles(
      scene, options_.tile_vertices,
      memory != nullptr && memory->tile_pairs != 0 ? memory->tile_pairs : scene.pairs.size());
  temporal_ = &nothing_;
  memory_ = memory;
  const std::size_t tile_pairs = memory != nullptr ? memory->tile_pairs : 0;
  try {
    meshes_.set(scene.meshes);
    deforms_ = std::any_of(scene.meshes.begin(), scene.meshes.end(),
                           [](const auto& mesh) { return mesh->deformable; });
    host_objects_.clear();
    for (const Scene::Object& object : scene.objects)
      host_objects_.push_back(object_record(object));
    pairs_.objects.reserve(host_objects_.size() * sizeof(ox_object));
    pairs_.objects.write(host_objects_.data(), host_objects_.size() * sizeof(ox_object));
    // The blocks of temporal data have the places of the tasks of one tile.
    if (memory != nullptr && options_.rays != Rays::kFull && tiles.size() == 1) {
      if (memory->temporal == nullptr) memory->temporal = std::make_unique<TemporalCache>(device_);
      temporal_ = memory->temporal.get();
      temporal_->begin(scene);
    }
    for (const Tile tile : tiles)
      collide_tile(scene, tile, share(predicted, tile.count, scene.pairs.size()));
  } catch (...) {
    // Whatever is still in flight must not write into memory that the next step reuses.
    try {
      device_.finish();
    } catch (const DeviceError&) {
    }
    take_kernel_times();  // of what ran; the next step starts afresh
    meshes_.forget();
    forget_temporal_data();
    if (memory != nullptr) memory->tile_pairs = tile_pairs;  // no size did: that tells nothing
    throw;
  }

  report_.predicted = predicted;
  report_.capacity = lists_.capacities();
  report_.temporal_pairs = remembers() ? temporal_->pairs() : 0;
  report_.synchronizations = static_cast<int>(device_.synchronizations() - synchronizations_before);
  take_kernel_times();
  report_.ms_total =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  lists_.note_use(report_.actual, memory != nullptr);
  if (memory != nullptr) {
    memory->history = {report_.pairs, report_.actual};
    // A little more each time: what did not fit once may have been short of memory for a moment.
    if (memory->tile_pairs != 0) memory->tile_pairs += memory->tile_pairs / 16 + 1;
  }
  return result_;
}

// What this step has left there may be half written: nobody is to start from it.
void Collider::forget_temporal_data() {
  temporal_ = &nothing_;
  if (memory_ != nullptr) memory_->temporal.reset();
}

void Collider::collide_tile(const Scene& scene, Tile tile, const ArrowCounts& expected) {
  ArrowCounts actual;
  const auto work = report_.work;
  // A prediction may be as far off as it likes: it costs no more than the worst case would.
  const ArrowCounts most = most_records(scene, tile, options_);
  ArrowCounts predicted{};
  for (std::size_t i = 0; i < kArrowCount; ++i) predicted[i] = std::min(expected[i], most[i]);
  if (!may_lose()) predicted = lists_.affordable(predicted);
  ArrowCounts needed = predicted;
  bool measured = false;  // `needed` is what a run of this tile had, not what was expected of it
  try {
    for (;;) {
      reserve(needed);
      actual = run_tile(scene, tile, predicted, most);
      if (may_lose() || !lists_.overflowed(stored(actual))) break;
      // What comes after a list that overflowed has not seen everything, so its count is only a
      // lower bound and may overflow in the next round; each round mends at least one list.
      const ArrowCounts counts = stored(actual);
      for (std::size_t i = 0; i < kArrowCount; ++i) needed[i] = std::max(needed[i], counts[i]);
      measured = true;
      report_.work = work;
      // To backtrack, the true counts have to be known: it is run again, for them alone.
      if (misprediction_ == Misprediction::kBacktrack)
        report_.backtracked = true;
      else
        ++report_.redone;
    }
  } catch (const DeviceError& error) {
    const bool hinted =
        !measured && !may_lose() &&
        std::any_of(predicted.begin(), predicted.end(), [](auto n) { return n > 1; });
    const bool remembered = remembers();
    if (!is_out_of_memory(error.code()) || (tile.count < 2 && !remembered && !hinted)) throw;
    // It does not fit: it might without room for what was only expected, without temporal data, or
    // in halves.
    ++report_.redone;
    report_.work = work;
    lists_.release();
    if (hinted) {
      collide_tile(scene, tile, {});
      return;
    }
    if (remembered) forget_temporal_data();
    if (tile.count < 2) {
      collide_tile(scene, tile, needed);
      return;
    }
    const std::size_t half = tile.count / 2;
    if (memory_ != nullptr) memory_->tile_pairs = half;
    collide_tile(scene, {tile.first, half}, share(needed, half, tile.count));
    collide_tile(scene, {tile.first + half, tile.count - half},
                 share(needed, tile.count - half, tile.count));
    return;
  }
  for (std::size_t i = 0; i < kArrowCount; ++i) {
    report_.actual[i] += actual[i];
    if (may_lose() && stored(actual)[i] > lists_.capacities()[i])
      report_.missed += actual[i] - lists_.capacities()[i];
  }
  if (report_.backtracked) {
    result_.ranges.clear();
    result_.contacts.clear();
    return;
  }
  const std::size_t contacts = static_cast<std::size_t>(
      std::min(at(actual, Arrow::kContacts), at(lists_.capacities(), Arrow::kContacts)));
  append_contacts(scene, meshes_, tile.first,
                  {static_cast<const ox_range*>(read_ranges_.data()), tile.count},
                  {static_cast<const ox_contact*>(read_contacts_.data()), contacts},
                  options_.max_contacts_deformable == 0, result_);
}

// GRAPP figure 1, top to bottom. Between the first launch and the last read-back nobody waits,
// unless the exact workload is asked for.
ArrowCounts Collider::run_tile(const Scene& scene, Tile tile, const ArrowCounts& predicted,
                               const ArrowCounts& most) {
  lists_.begin(most);
  upload(scene, tile);
  const bool dense = options_.organisation == Organisation::kMonolithic;
  steps_.pair.run(launch_for(tile.count), lists_, meshes_, pairs_, *temporal_, settings_, dense);
  if (options_.edges) run_search(predicted);
  if (floods(options_))
    steps_.flood.run(launch_for(2 * std::uint64_t{pairs_.count}), lists_, meshes_, pairs_);
  if (dense)
    run_monolithic();
  else
    run_pipelined(predicted);
  settle_workload();
  steps_.contact.run(launch_for(tile.count), launch(Arrow::kHits, predicted),
                     launch(Arrow::kCrossings, predicted), lists_, meshes_, pairs_, settings_);
  return read_back(tile, predicted);
}

void Collider::run_pipelined(const ArrowCounts& predicted) {
  const auto vertices = [&](Arrow category) {
    expect_work(OX_CHUNK_VERTICES * at(lists_.capacities(), category));
    steps_.vertex.run(category, launch(category, predicted), lists_, meshes_, pairs_, *temporal_,
                      settings_, works_);
    take_work(Worker::kVertexStep, OX_CHUNK_VERTICES * wait_if_counting(category));
  };
  settle_workload();
  if (remembers()) vertices(Arrow::kChunksSmall);
  vertices(Arrow::kChunksHigh);
  if (deforms_) vertices(Arrow::kChunksDeformable);

  const auto rays = [&](RayStep& step, Arrow list, Worker worker) {
    expect_work(at(lists_.capacities(), list));
    step.run(launch(list, predicted), lists_, meshes_, pairs_, *temporal_, settings_, works_);
    take_work(worker, wait_if_counting(list));
  };
  settle_workload();
  if (remembers()) {
    rays(steps_.iterative, Arrow::kRaysIterative, Worker::kIterativeRays);
    settle_workload();  // it hands rays on to the others
  }
  rays(steps_.bvh, Arrow::kRaysBvh, Worker::kBvhRays);
  if (deforms_ && options_.deformable_target == DeformableTarget::kBasic)
    rays(steps_.basic, Arrow::kRaysBasic, Worker::kBasicRays);
}

// Crossings of edges, in either organisation.
void Collider::run_search(const ArrowCounts& predicted) {
  steps_.cull.run(launch_for(pairs_.count), lists_, meshes_, pairs_);
  settle_workload();
  steps_.match.run(launch(Arrow::kMeshlets, predicted), lists_, meshes_, pairs_, settings_);
  settle_workload();
  steps_.cross.run(launch(Arrow::kMeshletPairs, predicted), lists_, meshes_, pairs_, settings_);
}

void Collider::run_monolithic() {
  const std::uint64_t items = std::uint64_t{dense_tasks_} * OX_CHUNK_VERTICES;
  expect_work(items);
  steps_.monolithic.run(launch_for(items), lists_, dense_tasks_, meshes_, pairs_, *temporal_,
                        settings_, works_);
  take_work(Worker::kMonolithic, items);
}

ArrowCounts Collider::read_back(Tile tile, const ArrowCounts& predicted) {
  const std::uint64_t capacity = at(lists_.capacities(), Arrow::kContacts);
  const std::uint64_t expected = std::min(at(predicted, Arrow::kContacts), capacity);
  pairs_.ranges.read(read_ranges_.data(), tile.count * sizeof(ox_range));
  lists_.contacts().read(read_contacts_.data(), expected * sizeof(ox_contact));
  const ox_u32* counters = wait_for_counters();
  ArrowCounts actual{};
  for (std::size_t i = 0; i < kArrowCount; ++i) actual[i] = counters[i * OX_COUNTER_STRIDE];
  if (lists_.overflowed(stored(actual)) && !may_lose()) return actual;
  report_.pairs_bounded += counters[OX_COUNTER_BOUNDED * OX_COUNTER_STRIDE];
  report_.unproven += counters[OX_COUNTER_UNPROVEN * OX_COUNTER_STRIDE];
  report_.dropped += counters[OX_COUNTER_DROPPED * OX_COUNTER_STRIDE];
  if (std::min(at(actual, Arrow::kContacts), capacity) > expected) {
    lists_.contacts().read(read_contacts_.data(),
                           at(actual, Arrow::kContacts) * sizeof(ox_contact));
    device_.finish();
  }
  return actual;
}

// Of what was counted, what was to be stored: the monolithic organisation has no chunk lists and no
// ray lists, and pairs of meshlets that are not stored are crossed at once (kernels/match.cl).
ArrowCounts Collider::stored(const ArrowCounts& actual) const {
  ArrowCounts counts = actual;
  if (options_.organisation == Organisation::kMonolithic)
    std::fill(counts.begin(), counts.begin() + static_cast<std::ptrdiff_t>(Arrow::kMeshlets), 0u);
  std::uint64_t& pairs = counts[static_cast<std::size_t>(Arrow::kMeshletPairs)];
  pairs = std::min(pairs, at(lists_.capacities(), Arrow::kMeshletPairs));
  return counts;
}

void Collider::upload(const Scene& scene, Tile tile) {
  host_members_.clear();
  host_dense_first_.clear();
  dense_tasks_ = 0;
  for (std::size_t i = tile.first; i < tile.first + tile.count; ++i) {
    host_dense_first_.push_back(dense_tasks_);
    for (const std::uint32_t object : scene.pairs[i]) {
      host_members_.push_back(object);
      const Mesh& mesh = topology(*scene.meshes[scene.objects[object].mesh]);
      dense_tasks_ += static_cast<cl_uint>(mesh.chunks.size());
    }
  }
  pairs_.reserve(tile.count);
  read_ranges_.reserve(tile.count * sizeof(ox_range));
  pairs_.members.write(host_members_.data(), host_members_.size() * sizeof(ox_u32));
  if (!remembers()) temporal_->begin_without(tile.count);
  std::uint64_t tasks = lists_.task_capacity();
  if (options_.organisation == Organisation::kMonolithic) {
    pairs_.dense_first.write(host_dense_first_.data(), host_dense_first_.size() * sizeof(ox_u32));
    lists_.tasks().reserve(dense_tasks_ * sizeof(ox_chunk_task));
    tasks = dense_tasks_;
  }
  if (remembers()) temporal_->reserve_blocks(tasks);
}

void Collider::reserve(const ArrowCounts& counts) {
  ArrowCounts wanted = counts;
  if (may_lose()) {
    lists_.limit(wanted);
  } else {
    // Pairs go from one category to another, and rays with them: room for all of them in either.
    const auto share_room = [&](Arrow a, Arrow b) {
      std::uint64_t& x = wanted[static_cast<std::size_t>(a)];
      std::uint64_t& y = wanted[static_cast<std::size_t>(b)];
      x = y = x + y;
    };
    if (remembers()) {
      share_room(Arrow::kChunksSmall, Arrow::kChunksHigh);
      share_room(Arrow::kRaysIterative, Arrow::kRaysBvh);
    }
    for (std::uint64_t& count : wanted) count = std::max(count, options_.initial_capacity);
    // A record takes as many words.
    std::uint64_t& words = wanted[static_cast<std::size_t>(Arrow::kFloodWords)];
    words = std::max(words, 16 * options_.initial_capacity);
    lists_.reserve(wanted);
  }
  read_contacts_.reserve(at(lists_.capacities(), Arrow::kContacts) * sizeof(ox_contact));
}

const ox_u32* Collider::wait_for_counters() {
  lists_.read_counters(read_counters_.data());
  device_.finish();
  return static_cast<const ox_u32*>(read_counters_.data());
}

void Collider::settle_workload() {
  if (options_.workload == Workload::kExact) wait_for_counters();
}

Launch Collider::launch_for(std::uint64_t items) const {
  const std::uint64_t local = options_.work_group_size;
  // A grid of 2^30 keeps every index within 32 bits; the loops in the kernels do the rest.
  const std::uint64_t most = (std::uint64_t{1} << 30) / local;
  return {static_cast<std::size_t>(std::min((items + local - 1) / local, most)),
          options_.work_group_size};
}

// For the consumer of an append list.
Launch Collider::launch(Arrow list, const ArrowCounts& predicted) {
  std::uint64_t items = at(predicted, list);
  const bool exact = options_.workload == Workload::kExact;
  if (exact)
    items = static_cast<const ox_u32*>(
        read_counters_.data())[static_cast<std::size_t>(list) * OX_COUNTER_STRIDE];
  if (list <= Arrow::kChunksDeformable) items *= OX_CHUNK_VERTICES;
  // A few groups for every compute unit cost nothing where there is no history yet. The paper
  // launches what is predicted, and no more.
  if (!exact && !may_lose())
    items = std::max<std::uint64_t>(
        items, 8 * std::uint64_t{device_.info().compute_units} * options_.work_group_size);
  return launch_for(items);
}

std::uint64_t Collider::wait_if_counting(Arrow list) {
  if (!options_.count_work) return 0;
  return std::min<std::uint64_t>(
      wait_for_counters()[static_cast<std::size_t>(list) * OX_COUNTER_STRIDE],
      at(lists_.capacities(), list));
}

void Collider::expect_work(std::uint64_t items) {
  works_.reserve(options_.count_work ? items * sizeof(ox_work) : sizeof(ox_work));
}

void Collider::take_work(Worker worker, std::uint64_t items) {
  if (!options_.count_work) return;
  host_works_.resize(items);
  works_.read(host_works_.data(), items * sizeof(ox_work));
  device_.finish();
  add_work(host_works_, report_.work[static_cast<std::size_t>(worker)]);
}

// Launches every kernel on empty input, so that one that cannot run in groups of this size is known
// now. PoCL compiles a kernel at its first launch, and again at the first one of 65,536 items or
// more, wherever that falls in a simulation; launching that many settles both.
void Collider::warm_up() {
  reserve({});
  meshes_.set({});
  pairs_.objects.reserve(sizeof(ox_object));
  lists_.begin({});
  upload(Scene{}, {0, 0});
  expect_work(1);
  const std::size_t local = options_.work_group_size;
  const bool is_pocl =
      device_.info().platform_name.find("Portable Computing Language") != std::string::npos;
  const Launch wide{is_pocl ? (std::size_t{1} << 16) / local + 1 : 1, local};
  steps_.pair.run(wide, lists_, meshes_, pairs_, nothing_, settings_, false);
  for (const Arrow category : {Arrow::kChunksSmall, Arrow::kChunksHigh, Arrow::kChunksDeformable})
    steps_.vertex.run(category, wide, lists_, meshes_, pairs_, nothing_, settings_, works_);
  for (RayStep* step : {&steps_.iterative, &steps_.bvh, &steps_.basic})
    step->run(wide, lists_, meshes_, pairs_, nothing_, settings_, works_);
  steps_.cull.run(wide, lists_, meshes_, pairs_);
  steps_.match.run(wide, lists_, meshes_, pairs_, settings_);
  steps_.cross.run(wide, lists_, meshes_, pairs_, settings_);
  steps_.flood.run(wide, lists_, meshes_, pairs_);
  steps_.monolithic.run(wide, lists_, 0, meshes_, pairs_, nothing_, settings_, works_);
  steps_.contact.run(wide, wide, wide, lists_, meshes_, pairs_, settings_);
  meshes_.warm_up(wide);
  device_.finish();
  take_kernel_times();
}

// A clock that cannot be read is no reason to lose contacts: that time is 0 then.
void Collider::take_kernel_times() {
  const auto read = [](auto take_milliseconds) {
    try {
      return take_milliseconds();
    } catch (const DeviceError&) {
      return 0.0;
    }
  };
  const auto take = [&](auto& step) { return read([&] { return step.take_milliseconds(); }); };
  report_.ms_deform_step = take(meshes_);
  report_.ms_pair_step = take(steps_.pair);
  report_.ms_vertex_step = take(steps_.vertex);
  report_.ms_iterative_rays = take(steps_.iterative);
  report_.ms_bvh_rays = take(steps_.bvh);
  report_.ms_basic_rays = take(steps_.basic);
  report_.ms_monolithic = take(steps_.monolithic);
  report_.ms_cull = take(steps_.cull);
  report_.ms_match = take(steps_.match);
  report_.ms_cross = take(steps_.cross);
  report_.ms_flood = take(steps_.flood);
  report_.ms_edge_contacts = read([&] { return steps_.contact.take_edge_milliseconds(); });
  report_.ms_contact_step = take(steps_.contact);
}

}  // namespace ode_ext
