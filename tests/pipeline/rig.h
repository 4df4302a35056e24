// SPDX-License-Identifier: BSD-3-Clause
// The steps of the pipeline one after the other, with everything in between read back. Every buffer
// has room for all that can come; the collider's own tests see to overflow.
#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/device_meshes.h"
#include "pipeline/steps.h"
#include "pipeline/test_scene.h"

namespace ode_ext::test {

struct StepRecords {
  std::uint32_t bounded = 0;         // pairs whose boxes overlap
  std::vector<ox_pair> pairs;        // of the scene, in its order
  std::vector<ox_chunk_task> tasks;  // what follows comes in any order
  std::vector<ox_ray> rays;
  std::vector<ox_hit> hits;
  std::vector<ox_u32> pair_hits, pair_segments;
  std::vector<ox_candidate> candidates;
  std::vector<ox_range> ranges;
  std::vector<ox_contact> contacts;
};

class Rig {
 public:
  // One for all tests of the process: building the kernels takes a second.
  static Rig& shared() {
    static Rig* const rig = new Rig;  // never destroyed: the driver may be gone by then
    return *rig;
  }

  const DeviceMeshes& meshes() const { return meshes_; }

  StepRecords run(const Scene& scene, std::uint32_t max_contacts = 16, Launch launch = {8, 64}) {
    upload(scene, max_contacts);
    const auto pair_count = static_cast<cl_uint>(scene.pairs.size());
    steps_.pair.run(launch, counters_, objects_, meshes_, pair_objects_, pair_count, pairs_,
                    pair_hits_, pair_ranges_, tasks_);
    steps_.vertex.run(launch, counters_, tasks_, pairs_, meshes_, rays_);
    steps_.ray.run(launch, counters_, rays_, pairs_, meshes_, pair_hits_, hits_);
    steps_.contact.run(launch, launch, counters_, hits_, pairs_, meshes_, pair_hits_,
                       pair_segments_, pair_count, candidates_, max_contacts, pair_ranges_,
                       contacts_);
    return read_back(pair_count);
  }

  // Its first step alone.
  StepRecords run_pair_step(const Scene& scene, Launch launch = {8, 64}) {
    upload(scene, 1);
    const auto pair_count = static_cast<cl_uint>(scene.pairs.size());
    steps_.pair.run(launch, counters_, objects_, meshes_, pair_objects_, pair_count, pairs_,
                    pair_hits_, pair_ranges_, tasks_);
    return read_back(pair_count);
  }

  // The index within its own mesh of a vertex or triangle of all.
  std::uint32_t local_vertex(std::uint32_t mesh, std::uint32_t vertex) const {
    return vertex - meshes_.place(mesh).vertex_first;
  }
  std::uint32_t local_triangle(std::uint32_t mesh, std::uint32_t triangle) const {
    return meshes_.mesh(mesh).bvh.order[triangle - meshes_.place(mesh).triangle_first];
  }

 private:
  Rig() : device_(""), program_(device_, ""), steps_(program_), meshes_(device_) {}

  static ox_object record_of(const Scene::Object& object) {
    ox_object record{};
    for (std::size_t k = 0; k < 9; ++k)
      record.rotation[k] = static_cast<float>(object.pose.rotation[k]);
    for (std::size_t k = 0; k < 3; ++k) {
      // Split after Veltkamp: g++ 12 takes double(float(x)) for x when it vectorizes, and the low
      // part would be 0.
      const double x = object.pose.position[k];
      const double scaled = (0x1p29 + 1) * x;
      const double high = scaled - (scaled - x);
      record.hi[k] = static_cast<float>(high);
      record.lo[k] = static_cast<float>(x - high);
    }
    record.mesh = object.mesh;
    return record;
  }

  void upload(const Scene& scene, std::uint32_t max_contacts) {
    meshes_.set(scene.meshes);
    host_objects_.clear();
    host_pairs_.clear();
    for (const Scene::Object& object : scene.objects) host_objects_.push_back(record_of(object));
    std::uint64_t chunks = 1, vertices = 1;
    for (const auto& pair : scene.pairs) {
      host_pairs_.insert(host_pairs_.end(), pair.begin(), pair.end());
      for (const std::uint32_t object : pair) {
        chunks += scene.meshes[scene.objects[object].mesh]->chunks.size();
        vertices += scene.meshes[scene.objects[object].mesh]->vertices.size();
      }
    }
    const std::size_t count = scene.pairs.size();
    objects_.reserve(host_objects_.size() * sizeof(ox_object));
    objects_.write(host_objects_.data(), host_objects_.size() * sizeof(ox_object));
    pair_objects_.reserve(host_pairs_.size() * sizeof(ox_u32));
    pair_objects_.write(host_pairs_.data(), host_pairs_.size() * sizeof(ox_u32));
    pairs_.reserve(count * sizeof(ox_pair));
    pair_hits_.reserve(count * sizeof(ox_u32));
    pair_segments_.reserve(count * sizeof(ox_u32));
    pair_ranges_.reserve(count * sizeof(ox_range));
    tasks_.reserve(chunks);
    rays_.reserve(vertices);
    hits_.reserve(vertices);
    candidates_.reserve(std::uint64_t{hits_.capacity()} * sizeof(ox_candidate));
    contacts_.reserve(count * max_contacts + 1);
    counters_.reserve(kCounterBytes);
    counters_.fill_zero(kCounterBytes);
    pair_segments_.fill_zero(count * sizeof(ox_u32));
    pairs_.fill_zero(count * sizeof(ox_pair));
  }

  StepRecords read_back(std::size_t pair_count) {
    std::vector<ox_u32> counters(kCounterBytes / sizeof(ox_u32));
    counters_.read(counters.data(), kCounterBytes);
    device_.finish();
    const auto counter = [&](std::size_t i) { return counters[i * OX_COUNTER_STRIDE]; };
    StepRecords records;
    records.bounded = counter(OX_COUNTER_BOUNDED);
    read(pairs_, records.pairs, pair_count);
    read(tasks_.records(), records.tasks, counter(OX_COUNTER_CHUNKS));
    read(rays_.records(), records.rays, counter(OX_COUNTER_RAYS));
    read(hits_.records(), records.hits, counter(OX_COUNTER_HITS));
    read(pair_hits_, records.pair_hits, pair_count);
    read(pair_segments_, records.pair_segments, pair_count);
    read(candidates_, records.candidates, counter(OX_COUNTER_HITS));
    read(pair_ranges_, records.ranges, pair_count);
    read(contacts_.records(), records.contacts, counter(OX_COUNTER_CONTACTS));
    device_.finish();
    return records;
  }

  template <class T>
  static void read(const Buffer& buffer, std::vector<T>& records, std::size_t count) {
    records.resize(count);
    buffer.read(records.data(), count * sizeof(T));
  }

  static constexpr std::size_t kCounterBytes =
      OX_COUNTER_COUNT * OX_COUNTER_STRIDE * sizeof(ox_u32);

  Device device_;
  Program program_;
  Steps steps_;
  DeviceMeshes meshes_;
  Buffer counters_{device_}, objects_{device_}, pair_objects_{device_}, pairs_{device_},
      pair_hits_{device_}, pair_ranges_{device_}, pair_segments_{device_}, candidates_{device_};
  AppendBuffer tasks_{device_, sizeof(ox_chunk_task)}, rays_{device_, sizeof(ox_ray)},
      hits_{device_, sizeof(ox_hit)}, contacts_{device_, sizeof(ox_contact)};
  std::vector<ox_object> host_objects_;
  std::vector<ox_u32> host_pairs_;
};

}  // namespace ode_ext::test
