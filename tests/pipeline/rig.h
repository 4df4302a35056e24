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
  std::vector<ox_edge> edges;             // of all meshes
  std::vector<ox_chunk_task> edge_tasks;  // of the pipelined organisation
  std::vector<ox_ray> edge_rays;          // likewise
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
        steps_.monolithic.run(launch, lists_, dense_vertex_tasks_, dense_tasks_, meshes_, pairs_,
                              temporal_, settings_, works_);
      } else {
        run_vertices(launch);
        steps_.edge.run(launch, lists_, meshes_, pairs_, works_);
        steps_.edge_rays.run(launch, lists_, meshes_, pairs_, works_);
      }
    } while (grow_for_crossings());
    steps_.contact.run(launch, launch, launch, lists_, meshes_, pairs_, settings_);
    StepRecords records = read_back();
    read_back_edges(organisation, records);
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

  // Whether there were more crossings than room for them, which there now is.
  bool grow_for_crossings() {
    std::vector<ox_u32> counters(AppendLists::kCounterBytes / sizeof(ox_u32));
    lists_.read_counters(counters.data());
    device_.finish();
    ArrowCounts needed{};
    needed[OX_LIST_CROSSINGS] = counters[OX_LIST_CROSSINGS * OX_COUNTER_STRIDE];
    if (!lists_.overflowed(needed)) return false;
    lists_.reserve(needed);
    return true;
  }

  void upload(const Scene& scene, std::uint32_t max_contacts, bool with_edges) {
    meshes_.set(scene.meshes);
    host_objects_.clear();
    host_members_.clear();
    host_dense_first_.clear();
    edge_count_ = 0;
    for (const auto& mesh : scene.meshes) edge_count_ += topology(*mesh).edges.size();
    for (const Scene::Object& object : scene.objects)
      host_objects_.push_back(object_record(object));
    cl_uint chunks = 0, edge_chunks = 0;
    std::uint64_t vertices = 1, edges = 1;
    for (const auto& pair : scene.pairs) {
      host_members_.insert(host_members_.end(), pair.begin(), pair.end());
      host_dense_first_.push_back(chunks);
      host_dense_first_.push_back(edge_chunks);
      for (const std::uint32_t object : pair) {
        const Mesh& mesh = *scene.meshes[scene.objects[object].mesh];
        chunks += static_cast<cl_uint>(topology(mesh).chunks.size());
        vertices += mesh.vertices.size();
        if (!with_edges) continue;
        edge_chunks += static_cast<cl_uint>(topology(mesh).edge_chunks.size());
        edges += topology(mesh).edges.size();
      }
    }
    for (std::size_t i = 1; i < host_dense_first_.size(); i += 2) host_dense_first_[i] += chunks;
    dense_vertex_tasks_ = chunks;
    dense_tasks_ = chunks + edge_chunks;
    const std::size_t count = scene.pairs.size();
    pairs_.reserve(count);
    pairs_.objects.reserve(host_objects_.size() * sizeof(ox_object));
    pairs_.objects.write(host_objects_.data(), host_objects_.size() * sizeof(ox_object));
    pairs_.members.write(host_members_.data(), host_members_.size() * sizeof(ox_u32));
    pairs_.dense_first.write(host_dense_first_.data(), host_dense_first_.size() * sizeof(ox_u32));
    const std::uint64_t tasks = std::uint64_t{chunks} + 1;
    // An edge may cross every triangle; that all of them do takes more memory than there is, so
    // the room for crossings follows what there were.
    lists_.reserve({tasks, tasks, tasks, std::uint64_t{edge_chunks} + 1, vertices, vertices,
                    vertices, edges, vertices, edges, std::uint64_t{count} * max_contacts + 1});
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

  void read_back_edges(Organisation organisation, StepRecords& records) {
    std::vector<ox_u32> counters(AppendLists::kCounterBytes / sizeof(ox_u32));
    lists_.read_counters(counters.data());
    device_.finish();
    const auto counter = [&](std::size_t i) { return counters[i * OX_COUNTER_STRIDE]; };
    read(meshes_.edges(), 0, records.edges, edge_count_);
    if (organisation == Organisation::kPipelined) {
      read(lists_.tasks(), lists_.first(Arrow::kChunksEdges), records.edge_tasks,
           counter(OX_LIST_CHUNKS_EDGES));
      read(lists_.rays(), lists_.first(Arrow::kRaysEdges), records.edge_rays,
           counter(OX_LIST_RAYS_EDGES));
    }
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
  cl_uint dense_vertex_tasks_ = 0, dense_tasks_ = 0;
  std::size_t edge_count_ = 0;  // of all meshes
};

}  // namespace ode_ext::test
