// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/collider.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <string>

#include "device/error.h"

namespace ode_ext {
namespace {

constexpr std::size_t kCounterBytes = OX_COUNTER_COUNT * OX_COUNTER_STRIDE * sizeof(ox_u32);

// The counter behind each append buffer.
constexpr std::array<std::size_t, kArrowCount> kCounters = {OX_COUNTER_CHUNKS, OX_COUNTER_RAYS,
                                                            OX_COUNTER_HITS, OX_COUNTER_CONTACTS};

std::uint64_t& at(ArrowCounts& counts, Arrow arrow) {
  return counts[static_cast<std::size_t>(arrow)];
}
std::uint64_t at(const ArrowCounts& counts, Arrow arrow) {
  return counts[static_cast<std::size_t>(arrow)];
}

// The leading 24 bits of x (Veltkamp 1968), which a float holds exactly, so that x - leading(x) is
// exact too. Not x - double(float(x)): g++ 12 can vectorise that into 0.
double leading(double x) {
  const double scaled = (0x1p29 + 1) * x;
  return scaled - (scaled - x);
}

ox_object to_record(const Scene::Object& object) {
  ox_object record{};
  for (std::size_t k = 0; k < 9; ++k)
    record.rotation[k] = static_cast<float>(object.pose.rotation[k]);
  for (std::size_t k = 0; k < 3; ++k) {
    const double high = leading(object.pose.position[k]);
    record.hi[k] = static_cast<float>(high);
    record.lo[k] = static_cast<float>(object.pose.position[k] - high);
  }
  record.mesh = object.mesh;
  return record;
}

Contact to_contact(const Scene& scene, const DeviceMeshes& meshes,
                   const std::array<std::uint32_t, 2>& pair, const ox_contact& contact) {
  const std::uint32_t side = contact.side;
  const Scene::Object& source = scene.objects[pair[side]];
  const Scene::Object& target = scene.objects[pair[1 - side]];
  const Mesh& source_mesh = meshes.mesh(source.mesh);
  const Mesh& target_mesh = meshes.mesh(target.mesh);
  const std::uint32_t vertex = contact.vertex - meshes.place(source.mesh).vertex_first;
  const std::uint32_t triangle =
      target_mesh.bvh.order[contact.triangle - meshes.place(target.mesh).triangle_first];

  const Vec3d outward = target.pose.turn(Vec3d(target_mesh.face_normals[triangle]));
  // Out of the target is into the source; the normal is to point into the first object.
  const double into_first = (side == 0 ? 1.0 : -1.0) / length(outward);
  Contact result;
  result.position = source.pose.place(Vec3d(source_mesh.vertices[vertex]));
  result.normal = into_first * outward;
  result.depth = static_cast<double>(contact.depth);
  result.triangles[side] = meshes.owner_triangle(contact.vertex);
  result.triangles[1 - side] = target_mesh.source_triangle[triangle];
  return result;
}

// Codes that say "too large", of which a smaller tile may be the cure.
bool is_out_of_memory(int code) {
  return code == CL_MEM_OBJECT_ALLOCATION_FAILURE || code == CL_OUT_OF_RESOURCES ||
         code == CL_OUT_OF_HOST_MEMORY || code == CL_INVALID_BUFFER_SIZE;
}

ArrowCounts share(const ArrowCounts& counts, std::size_t part, std::size_t whole) {
  ArrowCounts result{};
  for (std::size_t i = 0; i < kArrowCount; ++i)
    result[i] = static_cast<std::uint64_t>(std::ceil(
        static_cast<double>(counts[i]) * static_cast<double>(part) / static_cast<double>(whole)));
  return result;
}

}  // namespace

Collider::Collider(const ColliderOptions& options)
    : options_(options),
      device_(options.device),
      program_(device_, ""),
      steps_(program_),
      meshes_(device_),
      counters_(device_),
      objects_(device_),
      pair_objects_(device_),
      pairs_(device_),
      pair_hits_(device_),
      pair_ranges_(device_),
      pair_segments_(device_),
      candidates_(device_),
      tasks_(device_, sizeof(ox_chunk_task)),
      rays_(device_, sizeof(ox_ray)),
      hits_(device_, sizeof(ox_hit)),
      contacts_(device_, sizeof(ox_contact)),
      read_counters_(device_),
      read_ranges_(device_),
      read_contacts_(device_) {
  if (options_.work_group_size > device_.info().work_group_limit)
    throw std::invalid_argument("work_group_size is " + std::to_string(options_.work_group_size) +
                                ", more than the " +
                                std::to_string(device_.info().work_group_limit) + " that '" +
                                device_.info().name + "' can run");
  self_test(program_);
  read_counters_.reserve(kCounterBytes);
  counters_.reserve(kCounterBytes);
  warm_up();
}

const PairContacts& Collider::collide(const Scene& scene, History* history) {
  const auto start = std::chrono::steady_clock::now();
  const long long synchronizations_before = device_.synchronizations();
  report_ = {};
  report_.pairs = scene.pairs.size();
  result_.ranges.clear();
  result_.contacts.clear();
  if (scene.pairs.empty()) return result_;

  const ArrowCounts predicted =
      predict(history != nullptr ? *history : History{}, scene.pairs.size(), options_.prediction,
              options_.confidence);
  try {
    meshes_.set(scene.meshes);
    host_objects_.clear();
    for (const Scene::Object& object : scene.objects) host_objects_.push_back(to_record(object));
    objects_.reserve(host_objects_.size() * sizeof(ox_object));
    objects_.write(host_objects_.data(), host_objects_.size() * sizeof(ox_object));
    for (const Tile tile : cut_into_tiles(scene))
      collide_tile(scene, tile, share(predicted, tile.count, scene.pairs.size()));
  } catch (const DeviceError&) {
    // Whatever is still in flight must not write into memory that the next step reuses.
    try {
      device_.finish();
    } catch (const DeviceError&) {
    }
    take_kernel_times();  // of what ran; the next step starts afresh
    meshes_.forget();
    throw;
  }

  report_.predicted = predicted;
  report_.capacity = {tasks_.capacity(), rays_.capacity(), hits_.capacity(), contacts_.capacity()};
  report_.synchronizations = static_cast<int>(device_.synchronizations() - synchronizations_before);
  take_kernel_times();
  report_.ms_total =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  if (history != nullptr) *history = {report_.pairs, report_.actual};
  return result_;
}

std::vector<Collider::Tile> Collider::cut_into_tiles(const Scene& scene) const {
  std::vector<Tile> tiles;
  std::uint64_t vertices = 0;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    std::uint64_t of_pair = 0;
    for (const std::uint32_t object : scene.pairs[i])
      of_pair += kChunkVertices * scene.meshes[scene.objects[object].mesh]->chunks.size();
    if (tiles.empty() || vertices + of_pair > options_.tile_vertices) {
      tiles.push_back({i, 0});
      vertices = 0;
    }
    vertices += of_pair;
    ++tiles.back().count;
  }
  return tiles;
}

ArrowCounts Collider::bounds(const Scene& scene, Tile tile) const {
  std::uint64_t chunks = 0, vertices = 0;
  for (std::size_t i = tile.first; i < tile.first + tile.count; ++i)
    for (const std::uint32_t object : scene.pairs[i]) {
      const Mesh& mesh = *scene.meshes[scene.objects[object].mesh];
      chunks += mesh.chunks.size();
      vertices += mesh.vertices.size();
    }
  return {chunks, vertices, vertices, std::uint64_t{tile.count} * options_.max_contacts};
}

void Collider::collide_tile(const Scene& scene, Tile tile, const ArrowCounts& expected) {
  ArrowCounts actual;
  // A prediction may be as far off as it likes: it costs no more than the worst case would.
  const ArrowCounts most = bounds(scene, tile);
  ArrowCounts predicted{};
  for (std::size_t i = 0; i < kArrowCount; ++i) predicted[i] = std::min(expected[i], most[i]);
  try {
    ArrowCounts needed = predicted;
    for (;;) {
      reserve(needed);
      actual = run_tile(scene, tile, predicted);
      if (!overflowed(actual)) break;
      // What comes after a buffer that overflowed has not seen everything, so its count is only a
      // lower bound and may overflow in the next round; each round mends at least one buffer.
      ++report_.redone;
      for (std::size_t i = 0; i < kArrowCount; ++i) needed[i] = std::max(needed[i], actual[i]);
    }
  } catch (const DeviceError& error) {
    if (tile.count < 2 || !is_out_of_memory(error.code())) throw;
    // It does not fit: halves might.
    const std::size_t half = tile.count / 2;
    ++report_.redone;
    collide_tile(scene, {tile.first, half}, share(predicted, half, tile.count));
    collide_tile(scene, {tile.first + half, tile.count - half},
                 share(predicted, tile.count - half, tile.count));
    return;
  }
  append_contacts(scene, tile, actual);
  for (std::size_t i = 0; i < kArrowCount; ++i) report_.actual[i] += actual[i];
}

// GRAPP figure 1, top to bottom. Between the first launch and the last read-back nobody waits,
// unless the exact workload is asked for.
ArrowCounts Collider::run_tile(const Scene& scene, Tile tile, const ArrowCounts& predicted) {
  upload(scene, tile);
  counters_.fill_zero(kCounterBytes);
  const auto pair_count = static_cast<cl_uint>(tile.count);
  const Launch per_pair{(tile.count + options_.work_group_size - 1) / options_.work_group_size,
                        options_.work_group_size};
  const auto launch = [&](Arrow arrow) {
    return Launch{launch_size(arrow, predicted), options_.work_group_size};
  };

  steps_.pair.run(per_pair, counters_, objects_, meshes_, pair_objects_, pair_count, pairs_,
                  pair_hits_, pair_ranges_, tasks_);
  steps_.vertex.run(launch(Arrow::kChunks), counters_, tasks_, pairs_, meshes_, rays_);
  steps_.ray.run(launch(Arrow::kRays), counters_, rays_, pairs_, meshes_, pair_hits_, hits_);
  steps_.contact.run(per_pair, launch(Arrow::kHits), counters_, hits_, pairs_, meshes_, pair_hits_,
                     pair_segments_, pair_count, candidates_, options_.max_contacts, pair_ranges_,
                     contacts_);

  const std::uint64_t expected =
      std::min<std::uint64_t>(at(predicted, Arrow::kContacts), contacts_.capacity());
  counters_.read(read_counters_.data(), kCounterBytes);
  pair_ranges_.read(read_ranges_.data(), tile.count * sizeof(ox_range));
  contacts_.records().read(read_contacts_.data(), expected * sizeof(ox_contact));
  device_.finish();

  const auto* counters = static_cast<const ox_u32*>(read_counters_.data());
  ArrowCounts actual{};
  for (std::size_t i = 0; i < kArrowCount; ++i)
    actual[i] = counters[kCounters[i] * OX_COUNTER_STRIDE];
  if (overflowed(actual)) return actual;
  if (at(actual, Arrow::kContacts) > expected) {
    contacts_.records().read(read_contacts_.data(),
                             at(actual, Arrow::kContacts) * sizeof(ox_contact));
    device_.finish();
  }
  report_.pairs_bounded += counters[OX_COUNTER_BOUNDED * OX_COUNTER_STRIDE];
  return actual;
}

void Collider::upload(const Scene& scene, Tile tile) {
  host_pair_objects_.clear();
  for (std::size_t i = tile.first; i < tile.first + tile.count; ++i)
    host_pair_objects_.insert(host_pair_objects_.end(), scene.pairs[i].begin(),
                              scene.pairs[i].end());
  pair_objects_.reserve(host_pair_objects_.size() * sizeof(ox_u32));
  pairs_.reserve(tile.count * sizeof(ox_pair));
  pair_hits_.reserve(tile.count * sizeof(ox_u32));
  pair_ranges_.reserve(tile.count * sizeof(ox_range));
  pair_segments_.reserve(tile.count * sizeof(ox_u32));
  read_ranges_.reserve(tile.count * sizeof(ox_range));
  pair_objects_.write(host_pair_objects_.data(), host_pair_objects_.size() * sizeof(ox_u32));
}

void Collider::reserve(const ArrowCounts& counts) {
  const auto capacity = [&](Arrow arrow) {
    return std::max(at(counts, arrow), options_.initial_capacity);
  };
  tasks_.reserve(capacity(Arrow::kChunks));
  rays_.reserve(capacity(Arrow::kRays));
  hits_.reserve(capacity(Arrow::kHits));
  candidates_.reserve(std::uint64_t{hits_.capacity()} * sizeof(ox_candidate));
  contacts_.reserve(capacity(Arrow::kContacts));
  read_contacts_.reserve(std::size_t{contacts_.capacity()} * sizeof(ox_contact));
}

bool Collider::overflowed(const ArrowCounts& counts) const {
  return at(counts, Arrow::kChunks) > tasks_.capacity() ||
         at(counts, Arrow::kRays) > rays_.capacity() ||
         at(counts, Arrow::kHits) > hits_.capacity() ||
         at(counts, Arrow::kContacts) > contacts_.capacity();
}

// Work-groups for the consumer of an append buffer.
std::size_t Collider::launch_size(Arrow arrow, const ArrowCounts& predicted) {
  std::uint64_t items = at(predicted, arrow);
  if (options_.workload == Workload::kExact) {
    counters_.read(read_counters_.data(), kCounterBytes);
    device_.finish();
    const auto* counters = static_cast<const ox_u32*>(read_counters_.data());
    items = counters[kCounters[static_cast<std::size_t>(arrow)] * OX_COUNTER_STRIDE];
  }
  if (arrow == Arrow::kChunks) items *= OX_CHUNK_VERTICES;
  const std::uint64_t local = options_.work_group_size;
  const std::uint64_t groups = (items + local - 1) / local;
  const std::uint64_t most = (std::uint64_t{1} << 30) / local;
  if (options_.workload == Workload::kExact) return std::min(groups, most);
  // A few groups for every compute unit cost nothing where there is no history yet; a grid of 2^30
  // keeps every index within 32 bits, the loops in the kernels do the rest.
  const std::uint64_t floor = std::uint64_t{8} * device_.info().compute_units;
  return std::min(std::max(groups, floor), most);
}

void Collider::append_contacts(const Scene& scene, Tile tile, const ArrowCounts& actual) {
  const auto* ranges = static_cast<const ox_range*>(read_ranges_.data());
  const auto* contacts = static_cast<const ox_contact*>(read_contacts_.data());
  result_.ranges.reserve(scene.pairs.size());
  result_.contacts.reserve(result_.contacts.size() + at(actual, Arrow::kContacts));
  for (std::size_t i = 0; i < tile.count; ++i) {
    const ox_range range = ranges[i];
    result_.ranges.push_back({result_.contacts.size(), range.count});
    for (std::uint32_t k = range.first; k < range.first + range.count; ++k)
      result_.contacts.push_back(
          to_contact(scene, meshes_, scene.pairs[tile.first + i], contacts[k]));
  }
}

// Launches every kernel on empty input, so that one that cannot run in groups of this size is known
// now. PoCL compiles a kernel at its first launch, and again at the first one of 65,536 items or
// more, wherever that falls in a simulation; launching that many settles both.
void Collider::warm_up() {
  reserve({});
  upload(Scene{}, {0, 0});
  meshes_.set({});
  objects_.reserve(sizeof(ox_object));
  counters_.fill_zero(kCounterBytes);
  const std::size_t local = options_.work_group_size;
  const bool is_pocl =
      device_.info().platform_name.find("Portable Computing Language") != std::string::npos;
  const Launch wide{is_pocl ? (std::size_t{1} << 16) / local + 1 : 1, local};
  steps_.pair.run(wide, counters_, objects_, meshes_, pair_objects_, 0, pairs_, pair_hits_,
                  pair_ranges_, tasks_);
  steps_.vertex.run(wide, counters_, tasks_, pairs_, meshes_, rays_);
  steps_.ray.run(wide, counters_, rays_, pairs_, meshes_, pair_hits_, hits_);
  steps_.contact.run(wide, wide, counters_, hits_, pairs_, meshes_, pair_hits_, pair_segments_, 0,
                     candidates_, options_.max_contacts, pair_ranges_, contacts_);
  device_.finish();
  take_kernel_times();
}

// A clock that cannot be read is no reason to lose contacts: that time is 0 then.
void Collider::take_kernel_times() {
  const auto take = [](auto& step) {
    try {
      return step.take_milliseconds();
    } catch (const DeviceError&) {
      return 0.0;
    }
  };
  report_.ms_pair_step = take(steps_.pair);
  report_.ms_vertex_step = take(steps_.vertex);
  report_.ms_ray_step = take(steps_.ray);
  report_.ms_contact_step = take(steps_.contact);
}

template <class T>
static std::vector<T> read_records(Device& device, const AppendBuffer& buffer,
                                   std::uint64_t count) {
  std::vector<T> records(std::min<std::uint64_t>(count, buffer.capacity()));
  buffer.records().read(records.data(), records.size() * sizeof(T));
  device.finish();
  return records;
}

std::vector<ox_chunk_task> Collider::read_tasks() {
  return read_records<ox_chunk_task>(device_, tasks_, at(report_.actual, Arrow::kChunks));
}

std::vector<ox_ray> Collider::read_rays() {
  return read_records<ox_ray>(device_, rays_, at(report_.actual, Arrow::kRays));
}

std::vector<ox_hit> Collider::read_hits() {
  return read_records<ox_hit>(device_, hits_, at(report_.actual, Arrow::kHits));
}

}  // namespace ode_ext
