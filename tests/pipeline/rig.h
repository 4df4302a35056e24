// SPDX-License-Identifier: BSD-3-Clause
// The steps of the pipeline one after the other, with everything in between read back. Every buffer
// has room for all that can come; the collider's own tests see to overflow.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <vector>

#include "pipeline/monolithic_step.h"
#include "pipeline/options.h"
#include "pipeline/ray_step.h"
#include "pipeline/step_data.h"
#include "pipeline/steps.h"
#include "pipeline/temporal_cache.h"
#include "pipeline/test_scene.h"
#include "pipeline/vertex_step.h"

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

  const DeviceMeshes& meshes() const { return data_.meshes; }

  StepRecords run(const Scene& scene, std::uint32_t max_contacts = 16, Launch launch = {8, 64}) {
    upload(scene, max_contacts, false);
    steps_.pair.run(launch, data_, temporal_, false);
    run_vertices(launch);
    steps_.gather.run(launch, launch, data_);
    steps_.reduce.run(launch, data_);
    return read_back();
  }

  // `flooded`: rays of the vertices that crossings show to be inside alone, where they do.
  StepRecords run_with_edges(const Scene& scene, Organisation organisation, Launch launch = {8, 64},
                             bool flooded = false) {
    const bool dense = organisation == Organisation::kMonolithic;
    do {
      upload(scene, 16, true);
      if (flooded) data_.settings.rays_mode |= OX_RAYS_FLOOD;
      steps_.pair.run(launch, data_, temporal_, dense);
      steps_.cull.run(launch, data_);
      steps_.match.run(launch, data_);
      steps_.cross.run(launch, data_);
      if (flooded) steps_.flood.run(launch, data_);
      if (dense)
        monolithic_.run(launch, data_, temporal_, works_);
      else
        run_vertices(launch);
    } while (grow_for_search());
    steps_.gather.run(launch, launch, data_);
    steps_.edge_contacts.run(launch, launch, data_);
    steps_.reduce.run(launch, data_);
    StepRecords records = read_back();
    read_back_search(records);
    return records;
  }

  // The reduction alone, of the first pair, which gets these candidates.
  StepRecords run_reduction(const Scene& scene, const std::vector<ox_candidate>& candidates) {
    upload(scene, 16, true);
    steps_.pair.run({8, 64}, data_, temporal_, false);
    const auto& [meshes, pairs, lists, settings] = data_;
    const auto count = static_cast<ox_u32>(candidates.size());
    data_.pairs.hits.write(&count, sizeof(count));
    Buffer given(device_);
    given.reserve(count * sizeof(ox_candidate));
    given.write(candidates.data(), count * sizeof(ox_candidate));
    Kernel reduce(program_, "contact_reduce");
    reduce.launch(8, 64, lists.counters(), lists.lists(), pairs.pairs, meshes.records(), pairs.hits,
                  pairs.segments, pairs.count, given, settings.max_contacts,
                  settings.max_contacts_deformable, settings.rays_mode, pairs.ranges,
                  lists.contacts());
    return read_back();
  }

  // Its first step alone.
  StepRecords run_pair_step(const Scene& scene, Launch launch = {8, 64}) {
    upload(scene, 1, false);
    steps_.pair.run(launch, data_, temporal_, false);
    return read_back();
  }

  // The index within its own mesh of a vertex or triangle of all.
  std::uint32_t local_vertex(std::uint32_t mesh, std::uint32_t vertex) const {
    return vertex - data_.meshes.place(mesh).vertex_first;
  }
  std::uint32_t local_triangle(std::uint32_t mesh, std::uint32_t triangle) const {
    return topology(data_.meshes.mesh(mesh))
        .bvh.order[triangle - data_.meshes.place(mesh).triangle_first];
  }

 private:
  Rig()
      : device_(""),
        program_(device_, ""),
        steps_(program_, false),
        vertex_(program_),
        iterative_(program_, "ray_iterative"),
        bvh_(program_, "ray_bvh"),
        basic_(program_, "ray_basic"),
        monolithic_(program_),
        data_(program_) {}

  void run_vertices(Launch launch) {
    for (const Arrow category : {Arrow::kChunksSmall, Arrow::kChunksHigh, Arrow::kChunksDeformable})
      vertex_.run(category, launch, data_, temporal_, works_);
    for (RayStep* step : {&iterative_, &bvh_, &basic_}) step->run(launch, data_, temporal_, works_);
  }

  // Whether the search found more than there was room for, which there now is.
  bool grow_for_search() {
    data_.lists.count();
    ArrowCounts needed{};
    for (const ox_u32 list :
         {OX_LIST_MESHLETS, OX_LIST_MESHLET_PAIRS, OX_LIST_CROSSINGS, OX_LIST_FLOOD_WORDS})
      needed[list] = data_.lists.counted(std::size_t{list});
    if (!data_.lists.overflowed(needed)) return false;
    data_.lists.reserve(needed);
    return true;
  }

  void upload(const Scene& scene, std::uint32_t max_contacts, bool with_edges) {
    auto& [meshes, pairs, lists, settings] = data_;
    meshes.set(scene.meshes);
    edge_count_ = meshlet_count_ = 0;
    for (const auto& mesh : scene.meshes) {
      edge_count_ += topology(*mesh).edges.size() + topology(*mesh).flat_edges.size();
      meshlet_count_ += topology(*mesh).meshlets.meshlets.size();
    }
    std::uint64_t vertices = 1, edges = 1;
    for (const auto& pair : scene.pairs) {
      for (const std::uint32_t object : pair) {
        const Mesh& mesh = *scene.meshes[scene.objects[object].mesh];
        vertices += mesh.vertices.size();
        if (!with_edges) continue;
        edges += topology(mesh).edges.size();
      }
    }
    const std::size_t count = scene.pairs.size();
    pairs.upload_objects(scene);
    pairs.upload_pairs(scene, {0, count});
    pairs.upload_dense_first();
    const std::uint64_t tasks = std::uint64_t{pairs.chunks} + 1;
    // An edge may cross every triangle; that all of them do takes more memory than there is, so
    // the room for what the search finds follows what it did.
    lists.reserve({tasks, tasks, tasks, vertices, vertices, vertices, edges, edges, vertices, edges,
                   1, std::uint64_t{count} * max_contacts + 1});
    lists.begin(lists.capacities());
    lists.tasks().reserve(tasks * sizeof(ox_chunk_task));
    temporal_.begin_without(count);
    works_.reserve(sizeof(ox_work));
    pairs.segments.fill_zero(count * sizeof(ox_u32));
    pairs.crossing_segments.fill_zero(count * sizeof(ox_u32));
    pairs.pairs.fill_zero(count * sizeof(ox_pair));
    settings.max_contacts = max_contacts;
    settings.rays_mode = with_edges ? OX_RAYS_EDGES : 0u;
  }

  StepRecords read_back() {
    data_.lists.count();
    const auto& [meshes, pairs, lists, settings] = data_;
    const auto counter = [&](std::size_t i) { return data_.lists.counted(i); };
    for (std::size_t i = 0; i < kArrowCount; ++i)
      if (counter(i) > lists.capacities()[i]) throw std::runtime_error("a list overflowed");
    StepRecords records;
    records.bounded = static_cast<std::uint32_t>(counter(OX_COUNTER_BOUNDED));
    read(pairs.pairs, 0, records.pairs, pairs.count);
    for (const Arrow list : {Arrow::kChunksSmall, Arrow::kChunksHigh, Arrow::kChunksDeformable})
      read(lists.tasks(), lists.first(list), records.tasks,
           counter(static_cast<std::size_t>(list)));
    for (const Arrow list : {Arrow::kRaysIterative, Arrow::kRaysBvh, Arrow::kRaysBasic})
      read(lists.rays(), lists.first(list), records.rays, counter(static_cast<std::size_t>(list)));
    read(lists.hits(), 0, records.hits, counter(OX_LIST_HITS));
    read(pairs.hits, 0, records.pair_hits, pairs.count);
    read(pairs.segments, 0, records.pair_segments, pairs.count);
    // With edges there is room between the candidates of one pair and the next.
    const bool edges = (settings.rays_mode & OX_RAYS_EDGES) != 0;
    read(lists.candidates(), 0, records.candidates,
         counter(edges ? OX_COUNTER_SEGMENTS : OX_LIST_HITS));
    read(pairs.ranges, 0, records.ranges, pairs.count);
    read(lists.contacts(), 0, records.contacts, counter(OX_LIST_CONTACTS));
    return records;
  }

  void read_back_search(StepRecords& records) {
    data_.lists.count();
    const auto& [meshes, pairs, lists, settings] = data_;
    const auto counter = [&](std::size_t i) { return data_.lists.counted(i); };
    read(meshes.edges(), 0, records.edges, edge_count_);
    read(meshes.meshlets(), 0, records.meshlets, meshlet_count_);
    read(lists.meshlets(), 0, records.meshlet_tasks, counter(OX_LIST_MESHLETS));
    read(lists.meshlet_pairs(), 0, records.meshlet_pairs, counter(OX_LIST_MESHLET_PAIRS));
    read(lists.crossings(), 0, records.crossings, counter(OX_LIST_CROSSINGS));
    read(lists.gathered_crossings(), 0, records.gathered_crossings, counter(OX_LIST_CROSSINGS));
    read(pairs.crossings, 0, records.pair_crossings, pairs.count);
    read(pairs.crossing_segments, 0, records.crossing_segments, pairs.count);
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
  VertexStep vertex_;
  RayStep iterative_, bvh_, basic_;
  MonolithicStep monolithic_;
  StepData data_;
  TemporalCache temporal_{device_};
  Buffer works_{device_};
  std::size_t edge_count_ = 0, meshlet_count_ = 0;  // of all meshes
};

}  // namespace ode_ext::test
