// SPDX-License-Identifier: BSD-3-Clause
// The steps of the pipeline one after the other, with everything in between read back. Every buffer
// has room for all that can come; the collider's own tests see to overflow.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <vector>

#include "abi/paper.h"
#include "collide/options.h"
#include "contacts/field_records.h"
#include "contacts/plane_assembly.h"
#include "paper/kernels.h"
#include "paper/temporal_cache.h"
#include "search/batch_data.h"
#include "search/search.h"
#include "support/test_scene.h"

namespace ode_ext::test {

struct StepRecords {
  std::uint32_t bounded = 0;         // pairs whose boxes overlap
  std::vector<ox_pair> pairs;        // of the scene, in its order
  std::vector<ox_chunk_task> tasks;  // of all lists; what follows comes in any order
  std::vector<ox_ray> rays;          // of all lists
  std::vector<ox_hit> hits;
  std::vector<ox_found> found;  // per pair
  // Crossings in the order of theirs, then hits in that of theirs.
  std::vector<ox_feature> features;
  std::vector<ox_region> regions;
  std::vector<ox_u32> member_words, candidate_words;  // field by field
  std::vector<ox_range> ranges;
  std::vector<ox_contact> contacts;
  // With edges.
  std::vector<ox_edge> edges;        // of all meshes
  std::vector<ox_meshlet> meshlets;  // likewise
  std::vector<ox_meshlet_task> meshlet_tasks;
  std::vector<ox_meshlet_pair> meshlet_pairs;
  std::vector<ox_edge_crossing> crossings;

  // What may become contacts of a pair, in any order.
  std::vector<Candidate> candidates_of(std::size_t pair) const {
    std::vector<Candidate> candidates;
    if (found[pair].features == 0) return candidates;  // else what is found may be void
    const std::size_t first = OX_CANDIDATES_PER_FEATURE * found[pair].first;
    const Fields list{candidate_words.data() + OX_CANDIDATE_WORDS * first,
                      OX_CANDIDATES_PER_FEATURE * found[pair].features};
    for (std::size_t i = 0; i < found[pair].candidates; ++i)
      candidates.push_back(candidate_at(list, i));
    return candidates;
  }
  // The features that are members of a region, in any order.
  std::vector<ox_u32> features_of(const ox_region& region) const {
    std::vector<ox_u32> members;
    const Fields list{member_words.data() + OX_MEMBER_WORDS * region.first, region.count};
    for (std::size_t i = 0; i < region.count; ++i)
      members.push_back(list.word(OX_MEMBER_FEATURE, i));
    return members;
  }
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
    data_.launch(search_.pair_step, launch);
    run_vertices(launch);
    assemble(launch);
    return read_back();
  }

  // `flooded`: rays of the vertices that crossings show to be inside alone, where they do.
  StepRecords run_with_edges(const Scene& scene, Organization organization, Launch launch = {8, 64},
                             bool flooded = false) {
    const bool dense = organization == Organization::kMonolithic;
    do {
      upload(scene, 16, true);
      if (flooded) data_.settings.modes |= OX_MODE_FLOOD;
      data_.launch(search_.pair_step, launch);
      data_.launch(search_.cull, launch);
      data_.launch(search_.match, launch);
      data_.launch(search_.cross, launch);
      if (flooded)
        flood(launch);
      else if (dense)
        run_dense(launch);
      else
        run_vertices(launch);
    } while (grow_for_search());
    assemble(launch);
    StepRecords records = read_back();
    read_back_search(records);
    return records;
  }

  // The reduction alone, of the first pair, which gets these candidates.
  StepRecords run_reduction(const Scene& scene, const std::vector<Candidate>& candidates,
                            std::uint32_t max_contacts = 16) {
    upload(scene, max_contacts, false);
    data_.launch(search_.pair_step, {8, 64});
    ox_found found{};
    found.head[0] = found.head[1] = OX_NONE;
    found.features = found.placed = found.candidates = static_cast<ox_u32>(candidates.size());
    data_.pairs.found.write(&found, sizeof(found));
    std::vector<ox_u32> words = words_of(candidates);
    words.resize(words.size() + OX_LANES);  // lanes are loaded beyond the last
    data_.lists.candidates().upload(words);
    Kernel reduce(program_, "reduce_candidates");
    data_.launch(reduce, {8, 64});
    return read_back();
  }

  // Its first batch alone.
  StepRecords run_pair_step(const Scene& scene, Launch launch = {8, 64}) {
    upload(scene, 1, false);
    data_.launch(search_.pair_step, launch);
    list_chunks(launch, false);
    return read_back();
  }

  // The index within its own mesh of a vertex or triangle of all.
  std::uint32_t local_vertex(std::uint32_t mesh, std::uint32_t vertex) const {
    return vertex - data_.meshes.range(mesh).vertex_first;
  }
  std::uint32_t local_triangle(std::uint32_t mesh, std::uint32_t triangle) const {
    return triangle - data_.meshes.range(mesh).triangle_first;
  }

 private:
  Rig()
      : device_(""),
        program_(device_, paper::kProgramOption),
        search_(program_, program_, 1),
        assembly_(program_, program_),
        paper_(program_),
        data_(program_) {}

  void assemble(Launch launch) { assembly_.run(launch, launch, launch, data_); }

  void flood(Launch launch) {
    data_.launch(search_.flood, launch);
    data_.launch(search_.vertex_step, launch);
    data_.launch(search_.ray_step, launch);
  }

  void list_chunks(Launch launch, bool dense) {
    paper_.list_chunks(launch, data_, temporal_, dense, {dense_first_, chunks_});
  }

  void run_vertices(Launch launch) {
    list_chunks(launch, false);
    for (const List category : {List::kChunksSmall, List::kChunks, List::kChunksDeformable})
      paper_.choose_vertices(category, launch, data_, temporal_, works_);
    for (Kernel* rays : {&paper_.rays_iterative, &paper_.rays_full, &paper_.rays_basic})
      paper_.cast(*rays, launch, data_, temporal_, works_);
  }

  void run_dense(Launch launch) {
    list_chunks(launch, true);
    paper_.run_monolithic(launch, data_, temporal_, {dense_first_, chunks_}, works_);
  }

  void place_chunks(const Scene& scene) {
    std::vector<ox_u32> first;
    chunks_ = 0;
    for (const auto& pair : scene.pairs) {
      first.push_back(chunks_);
      for (const std::uint32_t object : pair) {
        const Mesh& mesh = *scene.meshes[scene.objects[object].mesh];
        chunks_ += static_cast<cl_uint>(mesh.topology->chunks.size());
      }
    }
    first.push_back(chunks_);
    dense_first_.reserve(first.size() * sizeof(ox_u32));
    dense_first_.write(first.data(), first.size() * sizeof(ox_u32));
    device_.finish();
  }

  // Whether the search found more than there was room for, which there now is.
  bool grow_for_search() {
    data_.lists.count();
    ListCounts needed{};
    for (const ox_u32 list :
         {OX_LIST_MESHLETS, OX_LIST_MESHLET_PAIRS, OX_LIST_CROSSINGS, OX_LIST_FLOOD_WORDS})
      needed[list] = data_.lists.counted(std::size_t{list});
    if (!data_.lists.overflowed(needed)) return false;
    data_.lists.reserve(needed);
    return true;
  }

  void upload(const Scene& scene, std::uint32_t max_contacts, bool with_edges) {
    auto& [meshes, pairs, lists, settings] = data_;
    meshes.forget();  // so that they lie side by side
    meshes.set(scene.meshes);
    edge_count_ = meshlet_count_ = 0;
    for (const auto& mesh : scene.meshes) {
      edge_count_ += mesh->topology->edges.size() + mesh->topology->flat_edges.size();
      meshlet_count_ += mesh->topology->meshlets.meshlets.size();
    }
    std::uint64_t vertices = 1, edges = 1;
    bool deforms = false;  // then all candidates are contacts
    for (const auto& pair : scene.pairs) {
      for (const std::uint32_t object : pair) {
        const Mesh& mesh = *scene.meshes[scene.objects[object].mesh];
        vertices += mesh.vertices.size();
        deforms = deforms || mesh.deformable;
        if (!with_edges) continue;
        edges += mesh.topology->edges.size() + mesh.topology->flat_edges.size();
      }
    }
    const std::size_t count = scene.pairs.size();
    pairs.upload_objects(scene);
    pairs.upload_pairs(scene, {0, count});
    place_chunks(scene);
    const std::uint64_t tasks = std::uint64_t{chunks_} + 1;
    // An edge may cross every triangle; that all of them do takes more memory than there is, so
    // the room for what the search finds follows what it did.
    lists.reserve({tasks, tasks, tasks, vertices, vertices, vertices, edges, edges, vertices, edges,
                   1, std::uint64_t{count} * max_contacts + (deforms ? edges + vertices : 1)});
    lists.begin(lists.capacities());
    lists.tasks().reserve(tasks * sizeof(ox_chunk_task));
    temporal_.begin_without(count);
    works_.reserve(sizeof(ox_work));
    pairs.pairs.fill_zero(count * sizeof(ox_pair));
    settings.max_contacts = max_contacts;
    settings.modes = with_edges ? OX_MODE_EDGES : 0u;
  }

  StepRecords read_back() {
    data_.lists.count();
    const auto& [meshes, pairs, lists, settings] = data_;
    const auto counter = [&](std::size_t i) { return data_.lists.counted(i); };
    for (std::size_t i = 0; i < kListCount; ++i)
      if (counter(i) > lists.capacities()[i]) throw std::runtime_error("a list overflowed");
    StepRecords records;
    records.bounded = static_cast<std::uint32_t>(counter(OX_COUNTER_BOUNDED));
    read(pairs.pairs, 0, records.pairs, pairs.count);
    for (const List list : {List::kChunksSmall, List::kChunks, List::kChunksDeformable})
      read(lists.tasks(), lists.first(list), records.tasks,
           counter(static_cast<std::size_t>(list)));
    for (const List list : {List::kRaysIterative, List::kRays, List::kRaysBasic})
      read(lists.rays(), lists.first(list), records.rays, counter(static_cast<std::size_t>(list)));
    read(lists.hits(), 0, records.hits, counter(OX_LIST_HITS));
    read(pairs.found, 0, records.found, pairs.count);
    const std::uint64_t features = counter(OX_COUNTER_FEATURES);  // none in a run cut short
    read(lists.features(), 0, records.features, features);
    read(lists.regions(), 0, records.regions, counter(OX_COUNTER_REGIONS));
    read(lists.members(), 0, records.member_words, OX_MEMBER_WORDS * features);
    read(lists.candidates(), 0, records.candidate_words,
         OX_CANDIDATES_PER_FEATURE * OX_CANDIDATE_WORDS * features);
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
  Search search_;
  PlaneAssembly assembly_;
  paper::Kernels paper_;
  BatchData data_;
  TemporalCache temporal_{device_};
  Buffer works_{device_};
  Buffer dense_first_{device_};
  cl_uint chunks_ = 0;                              // of all pairs
  std::size_t edge_count_ = 0, meshlet_count_ = 0;  // of all meshes
};

}  // namespace ode_ext::test
