// SPDX-License-Identifier: BSD-3-Clause
// The steps of the pipeline one after the other, with everything in between read back. Every buffer
// has room for all that can come; the collider's own tests see to overflow.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <vector>

#include "pipeline/append_lists.h"
#include "pipeline/device_meshes.h"
#include "pipeline/object_record.h"
#include "pipeline/options.h"
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
  // With edges. Of gathered crossings and their candidates those of a pair follow one another.
  std::vector<ox_edge> edges;        // of all meshes
  std::vector<ox_meshlet> meshlets;  // likewise
  std::vector<ox_meshlet_task> meshlet_tasks;
  std::vector<ox_meshlet_pair> meshlet_pairs;
  std::vector<ox_edge_crossing> crossings, gathered_crossings;
  std::vector<ox_u32> pair_crossings, crossing_segments;
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
    upload(scene, max_contacts, false);
    run_vertices(launch);
    steps_.contact.run(launch, launch, launch, lists_, meshes_, pairs_, settings_);
    return read_back();
  }

  StepRecords run_with_edges(const Scene& scene, Organisation organisation,
                             Launch launch = {8, 64}) {
    do {
      upload(scene, 16, true);
      if (organisation == Organisation::kMonolithic) {
        steps_.pair.run(launch, lists_, meshes_, pairs_, temporal_, settings_, true);
        steps_.monolithic.run(launch, lists_, dense_tasks_, meshes_, pairs_, temporal_, settings_,
                              works_);
      } else {
        run_vertices(launch);
      }
      steps_.cull.run(launch, lists_, meshes_, pairs_);
      steps_.match.run(launch, lists_, meshes_, pairs_, settings_);
      steps_.cross.run(launch, lists_, meshes_, pairs_, settings_);
    } while (grow_for_search());
    steps_.contact.run(launch, launch, launch, lists_, meshes_, pairs_, settings_);
    StepRecords records = read_back();
    read_back_search(records);
    return records;
  }

  // Its first step alone.
  StepRecords run_pair_step(const Scene& scene, Launch launch = {8, 64}) {
    upload(scene, 1, false);
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

  void run_vertices(Launch launch) {
    steps_.pair.run(launch, lists_, meshes_, pairs_, temporal_, settings_, false);
    for (const Arrow category : {Arrow::kChunksSmall, Arrow::kChunksHigh, Arrow::kChunksDeformable})
      steps_.vertex.run(category, launch, lists_, meshes_, pairs_, temporal_, settings_, works_);
    for (RayStep* step : {&steps_.iterative, &steps_.bvh, &steps_.basic})
      step->run(launch, lists_, meshes_, pairs_, temporal_, settings_, works_);
  }

  // Whether the search found more than there was room for, which there now is.
  bool grow_for_search() {
    std::vector<ox_u32> counters(AppendLists::kCounterBytes / sizeof(ox_u32));
    lists_.read_counters(counters.data());
    device_.finish();
    ArrowCounts needed{};
    for (const ox_u32 list : {OX_LIST_MESHLETS, OX_LIST_MESHLET_PAIRS, OX_LIST_CROSSINGS})
      needed[list] = counters[list * OX_COUNTER_STRIDE];
    if (!lists_.overflowed(needed)) return false;
    lists_.reserve(needed);
    return true;
  }

  void upload(const Scene& scene, std::uint32_t max_contacts, bool with_edges) {
    meshes_.set(scene.meshes);
    host_objects_.clear();
    host_members_.clear();
    host_dense_first_.clear();
    edge_count_ = meshlet_count_ = 0;
    for (const auto& mesh : scene.meshes) {
      edge_count_ += topology(*mesh).edges.size() + topology(*mesh).flat_edges.size();
      meshlet_count_ += topology(*mesh).meshlets.meshlets.size();
    }
    for (const Scene::Object& object : scene.objects)
      host_objects_.push_back(object_record(object));
    cl_uint chunks = 0;
    std::uint64_t vertices = 1, edges = 1;
    for (const auto& pair : scene.pairs) {
      host_members_.insert(host_members_.end(), pair.begin(), pair.end());
      host_dense_first_.push_back(chunks);
      for (const std::uint32_t object : pair) {
        const Mesh& mesh = *scene.meshes[scene.objects[object].mesh];
        chunks += static_cast<cl_uint>(topology(mesh).chunks.size());
        vertices += mesh.vertices.size();
        if (!with_edges) continue;
        edges += topology(mesh).edges.size();
      }
    }
    dense_tasks_ = chunks;
    const std::size_t count = scene.pairs.size();
    pairs_.reserve(count);
    pairs_.objects.reserve(host_objects_.size() * sizeof(ox_object));
    pairs_.objects.write(host_objects_.data(), host_objects_.size() * sizeof(ox_object));
    pairs_.members.write(host_members_.data(), host_members_.size() * sizeof(ox_u32));
    pairs_.dense_first.write(host_dense_first_.data(), host_dense_first_.size() * sizeof(ox_u32));
    const std::uint64_t tasks = std::uint64_t{chunks} + 1;
    // An edge may cross every triangle; that all of them do takes more memory than there is, so
    // the room for what the search finds follows what it did.
    lists_.reserve({tasks, tasks, tasks, vertices, vertices, vertices, edges, edges, vertices,
                    edges, 1, std::uint64_t{count} * max_contacts + 1});
    lists_.begin(lists_.capacities());
    lists_.tasks().reserve((dense_tasks_ + 1) * sizeof(ox_chunk_task));
    temporal_.begin_without(count);
    works_.reserve(sizeof(ox_work));
    pairs_.segments.fill_zero(count * sizeof(ox_u32));
    pairs_.crossing_segments.fill_zero(count * sizeof(ox_u32));
    pairs_.pairs.fill_zero(count * sizeof(ox_pair));
    settings_.max_contacts = max_contacts;
    settings_.rays_mode = with_edges ? OX_RAYS_EDGES : 0u;
  }

  StepRecords read_back() {
    std::vector<ox_u32> counters(AppendLists::kCounterBytes / sizeof(ox_u32));
    lists_.read_counters(counters.data());
    device_.finish();
    const auto counter = [&](std::size_t i) { return counters[i * OX_COUNTER_STRIDE]; };
    for (std::size_t i = 0; i < kArrowCount; ++i)
      if (counter(i) > lists_.capacities()[i]) throw std::runtime_error("a list overflowed");
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
    // With edges there is room between the candidates of one pair and the next.
    const bool edges = (settings_.rays_mode & OX_RAYS_EDGES) != 0;
    read(lists_.candidates(), 0, records.candidates,
         counter(edges ? OX_COUNTER_SEGMENTS : OX_LIST_HITS));
    read(pairs_.ranges, 0, records.ranges, pairs_.count);
    read(lists_.contacts(), 0, records.contacts, counter(OX_LIST_CONTACTS));
    return records;
  }

  void read_back_search(StepRecords& records) {
    std::vector<ox_u32> counters(AppendLists::kCounterBytes / sizeof(ox_u32));
    lists_.read_counters(counters.data());
    device_.finish();
    const auto counter = [&](std::size_t i) { return counters[i * OX_COUNTER_STRIDE]; };
    read(meshes_.edges(), 0, records.edges, edge_count_);
    read(meshes_.meshlets(), 0, records.meshlets, meshlet_count_);
    read(lists_.meshlets(), 0, records.meshlet_tasks, counter(OX_LIST_MESHLETS));
    read(lists_.meshlet_pairs(), 0, records.meshlet_pairs, counter(OX_LIST_MESHLET_PAIRS));
    read(lists_.crossings(), 0, records.crossings, counter(OX_LIST_CROSSINGS));
    read(lists_.gathered_crossings(), 0, records.gathered_crossings, counter(OX_LIST_CROSSINGS));
    read(pairs_.crossings, 0, records.pair_crossings, pairs_.count);
    read(pairs_.crossing_segments, 0, records.crossing_segments, pairs_.count);
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
  std::vector<ox_u32> host_members_, host_dense_first_;
  cl_uint dense_tasks_ = 0;
  std::size_t edge_count_ = 0, meshlet_count_ = 0;  // of all meshes
};

}  // namespace ode_ext::test
