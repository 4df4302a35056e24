// SPDX-License-Identifier: BSD-3-Clause
#include "ode/pass_stats.h"

#include <array>

namespace ode_ext {
namespace {

template <Stage kStage>
double on_device(const PassStats& s) {
  return s.report.milliseconds(kStage);
}

constexpr TimedStage kStages[] = {
    {dBatchStageGather, "gather", TimedStage::kHost,
     [](const PassStats& s) { return s.ms_gather; }},
    {dBatchStageMeshes, "meshes", TimedStage::kHost,
     [](const PassStats& s) { return s.ms_meshes; }},
    {dBatchStageDeformStep, "deform_step", TimedStage::kDevice, &on_device<Stage::kDeformStep>},
    {dBatchStagePairStep, "pair_step", TimedStage::kDevice, &on_device<Stage::kPairStep>},
    {dBatchStageVertexStep, "vertex_step", TimedStage::kDevice, &on_device<Stage::kVertexStep>},
    {dBatchStageIterativeRays, "iterative_rays", TimedStage::kDevice,
     &on_device<Stage::kIterativeRays>},
    {dBatchStageBvhRays, "bvh_rays", TimedStage::kDevice, &on_device<Stage::kBvhRays>},
    {dBatchStageBasicRays, "basic_rays", TimedStage::kDevice, &on_device<Stage::kBasicRays>},
    {dBatchStageMonolithic, "monolithic", TimedStage::kDevice, &on_device<Stage::kMonolithic>},
    {dBatchStageCull, "cull", TimedStage::kDevice, &on_device<Stage::kCull>},
    {dBatchStageMatch, "match", TimedStage::kDevice, &on_device<Stage::kMatch>},
    {dBatchStageCross, "cross", TimedStage::kDevice, &on_device<Stage::kCross>},
    {dBatchStageFlood, "flood", TimedStage::kDevice, &on_device<Stage::kFlood>},
    {dBatchStageAssembly, "assembly", TimedStage::kDevice, &on_device<Stage::kAssembly>},
    {dBatchStageContactStep, "contact_step", TimedStage::kDevice, &on_device<Stage::kContactStep>},
    {dBatchStageWholeStep, "whole_step", TimedStage::kDevice, &on_device<Stage::kWholeStep>},
    {dBatchStageDevice, "device", TimedStage::kHost,
     [](const PassStats& s) { return s.ms_device; }},
    {dBatchStageExport, "export", TimedStage::kHost,
     [](const PassStats& s) { return s.ms_export; }},
    {dBatchStagePass, "pass", TimedStage::kWhole, [](const PassStats& s) { return s.ms_pass; }},
};
static_assert(std::size(kStages) == kStageCount + 5);

const Counter kPlainCounters[] = {
    {dBatchCounterPairs, "pairs", [](const PassStats& s, std::size_t) { return s.pairs; }, 0},
    {dBatchCounterPairsComputed, "pairs_computed",
     [](const PassStats& s, std::size_t) { return s.pairs_computed; }, 0},
    {dBatchCounterPairsColliding, "pairs_colliding",
     [](const PassStats& s, std::size_t) { return s.pairs_colliding; }, 0},
    {dBatchCounterPairsBounded, "pairs_bounded",
     [](const PassStats& s, std::size_t) {
       return static_cast<std::int64_t>(s.report.pairs_bounded);
     },
     0},
    {dBatchCounterRedone, "redone",
     [](const PassStats& s, std::size_t) { return std::int64_t{s.report.redone}; }, 0},
    {dBatchCounterSynchronizations, "synchronizations",
     [](const PassStats& s, std::size_t) { return std::int64_t{s.report.synchronizations}; }, 0},
    {dBatchCounterMissed, "missed",
     [](const PassStats& s, std::size_t) { return static_cast<std::int64_t>(s.report.missed); }, 0},
    {dBatchCounterIterativeUnproven, "iterative_unproven",
     [](const PassStats& s, std::size_t) { return static_cast<std::int64_t>(s.report.unproven); },
     0},
    {dBatchCounterDropped, "dropped",
     [](const PassStats& s, std::size_t) { return static_cast<std::int64_t>(s.report.dropped); },
     0},
    {dBatchCounterTemporalPairs, "temporal_pairs",
     [](const PassStats& s, std::size_t) {
       return static_cast<std::int64_t>(s.report.temporal_pairs);
     },
     0},
    {dBatchCounterDeformed, "deformed", [](const PassStats& s, std::size_t) { return s.deformed; },
     0},
    {dBatchCounterPasses, "passes", [](const PassStats& s, std::size_t) { return s.passes; }, 0},
    {dBatchCounterPairsAlone, "pairs_alone",
     [](const PassStats& s, std::size_t) { return s.pairs_alone; }, 0},
    {dBatchCounterPairsStock, "pairs_stock",
     [](const PassStats& s, std::size_t) { return s.pairs_stock; }, 0},
    {dBatchCounterMeshes, "meshes", [](const PassStats& s, std::size_t) { return s.meshes; }, 0},
};

struct Buffer {
  int value;
  const char* name;
};
// In the order of the lists of the pipeline.
constexpr Buffer kBuffers[] = {
    {dBatchBufferChunksSmall, "chunks_small"},
    {dBatchBufferChunksHigh, "chunks_high"},
    {dBatchBufferChunksDeformable, "chunks_deformable"},
    {dBatchBufferRaysIterative, "rays_iterative"},
    {dBatchBufferRaysBvh, "rays_bvh"},
    {dBatchBufferRaysBasic, "rays_basic"},
    {dBatchBufferMeshlets, "meshlets"},
    {dBatchBufferMeshletPairs, "meshlet_pairs"},
    {dBatchBufferHits, "hits"},
    {dBatchBufferCrossings, "crossings"},
    {dBatchBufferFloodWords, "flood_words"},
    {dBatchBufferContacts, "contacts"},
};
static_assert(std::size(kBuffers) == kListCount);

std::vector<Counter> all_counters() {
  std::vector<Counter> all(std::begin(kPlainCounters), std::end(kPlainCounters));
  for (std::size_t i = 0; i < kListCount; ++i) {
    const auto [value, name] = kBuffers[i];
    all.push_back({value + dBatchActual, std::string("actual_") + name,
                   [](const PassStats& s, std::size_t buffer) {
                     return static_cast<std::int64_t>(s.report.actual[buffer]);
                   },
                   i});
    all.push_back({value + dBatchPredicted, std::string("predicted_") + name,
                   [](const PassStats& s, std::size_t buffer) {
                     return static_cast<std::int64_t>(s.report.predicted[buffer]);
                   },
                   i});
    all.push_back({value + dBatchCapacity, std::string("capacity_") + name,
                   [](const PassStats& s, std::size_t buffer) {
                     return static_cast<std::int64_t>(s.report.capacity[buffer]);
                   },
                   i});
  }
  return all;
}

}  // namespace

void note_report(const BatchReport& report, PassStats& stats) {
  stats.report = report;
  stats.pairs_computed = static_cast<std::int64_t>(report.pairs);
  stats.ms_device = report.ms_total;
  if (report.redone != 0) stats.status |= dBatchStatusRedone;
  if (report.missed != 0) stats.status |= dBatchStatusMissed;
  if (report.backtracked) stats.status |= dBatchStatusBacktracked;
}

std::span<const TimedStage> timed_stages() { return kStages; }

const std::vector<Counter>& counters() {
  // Never destroyed: destructors of the program's own may ask.
  static const std::vector<Counter>& all = *new const std::vector<Counter>(all_counters());
  return all;
}

const WorkCount* work_of(const PassStats& stats, int stage) {
  constexpr std::array<int, kCountedKernelCount> kCounted{
      dBatchStageVertexStep, dBatchStageIterativeRays, dBatchStageBvhRays, dBatchStageBasicRays,
      dBatchStageMonolithic};
  for (std::size_t i = 0; i < kCounted.size(); ++i) {
    if (kCounted[i] == stage) return &stats.report.work[i];
  }
  return nullptr;
}

}  // namespace ode_ext
