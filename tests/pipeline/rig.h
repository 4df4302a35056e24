// SPDX-License-Identifier: BSD-3-Clause
// The steps of the pipeline one after the other, with everything in between read back. Every buffer
// has room for all that can come; the collider's own tests see to overflow.
#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/append_lists.h"
#include "pipeline/device_meshes.h"
#include "pipeline/object_record.h"
#include "pipeline/pair_buffers.h"
#include "pipeline/steps.h"
#include "pipeline/temporal_cache.h"
#include "pipeline/test_scene.h"

namespace ode_ext::test {

struct StepRecords {
  std::uint32_t bounded = 0;         // pairs whose boxes overlap
  std::vector<ox_pair> pairs;        // of the scene, in its order
  std::vector<ox_chunk_task> tasks;  // of all lists; what follows comes in any order
  std::vector<ox_ray> rays;          // of all lists
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
    steps_.pair.run(launch, lists_, meshes_, pairs_, temporal_, settings_, false);
    for (const Arrow category : {Arrow::kChunksSmall, Arrow::kChunksHigh, Arrow::kChunksDeformable})
      steps_.vertex.run(category, launch, lists_, meshes_, pairs_, temporal_, settings_, works_);
    for (RayStep* step : {&steps_.iterative, &steps_.bvh, &steps_.basic})
      step->run(launch, lists_, meshes_, pairs_, temporal_, settings_, works_);
    steps_.contact.run(launch, launch, launch, lists_, meshes_, pairs_, settings_);
    return read_back();
  }

  // Its first step alone.
  StepRecords run_pair_step(const Scene& scene, Launch launch = {8, 64}) {
    upload(scene, 1);
    steps_.pair.run(launch, lists_, meshes_, pairs_, temporal_, settings_, false);
    return read_back();
  }

  // The index within its own mesh of a vertex or triangle of all.
  std::uint32_t local_vertex(std::uint32_t mesh, std::uint32_t vertex) const {
    return vertex - meshes_.place(mesh).vertex_first;
  }
  std::uint32_t local_triangle(std::uint32_t mesh, std::uint32_t triangle) const {
    return topology(meshes_.mesh(mesh)).bvh.order[triangle - meshes_.place(mesh).triangle_first];
  }

 private:
  Rig() : device_(""), program_(device_, ""), steps_(program_), meshes_(program_) {}

  void upload(const Scene& scene, std::uint32_t max_contacts) {
    meshes_.set(scene.meshes);
    host_objects_.clear();
    host_members_.clear();
    for (const Scene::Object& object : scene.objects)
      host_objects_.push_back(object_record(object));
    std::uint64_t chunks = 1, vertices = 1;
    for (const auto& pair : scene.pairs) {
      host_members_.insert(host_members_.end(), pair.begin(), pair.end());
      for (const std::uint32_t object : pair) {
        const Mesh& mesh = *scene.meshes[scene.objects[object].mesh];
        chunks += topology(mesh).chunks.size();
        vertices += mesh.vertices.size();
      }
    }
    const std::size_t count = scene.pairs.size();
    pairs_.reserve(count);
    pairs_.objects.reserve(host_objects_.size() * sizeof(ox_object));
    pairs_.objects.write(host_objects_.data(), host_objects_.size() * sizeof(ox_object));
    pairs_.members.write(host_members_.data(), host_members_.size() * sizeof(ox_u32));
    lists_.reserve({chunks, chunks, chunks, 1, vertices, vertices, vertices, 1, vertices, 1,
                    std::uint64_t{count} * max_contacts + 1});
    lists_.begin(lists_.capacities());
    temporal_.begin_without(count);
    works_.reserve(sizeof(ox_work));
    pairs_.segments.fill_zero(count * sizeof(ox_u32));
    pairs_.pairs.fill_zero(count * sizeof(ox_pair));
    settings_.max_contacts = max_contacts;
  }

  StepRecords read_back() {
    std::vector<ox_u32> counters(AppendLists::kCounterBytes / sizeof(ox_u32));
    lists_.read_counters(counters.data());
    device_.finish();
    const auto counter = [&](std::size_t i) { return counters[i * OX_COUNTER_STRIDE]; };
    StepRecords records;
    records.bounded = counter(OX_COUNTER_BOUNDED);
    read(pairs_.pairs, 0, records.pairs, pairs_.count);
    for (const Arrow list : {Arrow::kChunksSmall, Arrow::kChunksHigh, Arrow::kChunksDeformable})
      read(lists_.tasks(), lists_.first(list), records.tasks, counter(static_cast<ox_u32>(list)));
    for (const Arrow list : {Arrow::kRaysIterative, Arrow::kRaysBvh, Arrow::kRaysBasic})
      read(lists_.rays(), lists_.first(list), records.rays, counter(static_cast<ox_u32>(list)));
    read(lists_.hits(), 0, records.hits, counter(OX_LIST_HITS));
    read(pairs_.hits, 0, records.pair_hits, pairs_.count);
    read(pairs_.segments, 0, records.pair_segments, pairs_.count);
    read(lists_.candidates(), 0, records.candidates, counter(OX_LIST_HITS));
    read(pairs_.ranges, 0, records.ranges, pairs_.count);
    read(lists_.contacts(), 0, records.contacts, counter(OX_LIST_CONTACTS));
    return records;
  }

  // Appends `count` records of the buffer from `first` on.
  template <class T>
  void read(const Buffer& buffer, std::uint64_t first, std::vector<T>& records, std::size_t count) {
    const std::size_t before = records.size();
    records.resize(before + count);
    buffer.read(records.data() + before, count * sizeof(T), first * sizeof(T));
    device_.finish();
  }

  Device device_;
  Program program_;
  Steps steps_;
  DeviceMeshes meshes_;
  AppendLists lists_{device_};
  PairBuffers pairs_{device_};
  TemporalCache temporal_{device_};
  Buffer works_{device_};
  StepSettings settings_;
  std::vector<ox_object> host_objects_;
  std::vector<ox_u32> host_members_;
};

}  // namespace ode_ext::test
