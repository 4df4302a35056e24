// SPDX-License-Identifier: BSD-3-Clause
#include "paper/tables.h"

#include <array>
#include <iomanip>
#include <string>

#include "paper/hex.h"

namespace paper {
namespace {

constexpr std::array<const char*, dBatchStageCount> kStages{
    "gather",         "meshes",   "deform_step", "pair_step",  "vertex_step",
    "iterative_rays", "bvh_rays", "basic_rays",  "monolithic", "cull",
    "match",          "cross",    "flood",       "assembly",   "contact_step",
    "whole_step",     "device",   "export",      "pass"};

constexpr std::array<const char*, dBatchBufferCount> kBuffers{
    "chunks_small", "chunks_high", "chunks_deformable", "rays_iterative",
    "rays_bvh",     "rays_basic",  "meshlets",          "meshlet_pairs",
    "hits",         "crossings",   "flood_words",       "contacts"};

constexpr std::array<const char*, dBatchKernelCount> kKernels{
    "vertex_step", "iterative_rays", "bvh_rays", "basic_rays", "monolithic"};

constexpr int kDecimals = 4;  // of a millisecond

}  // namespace

void write_steps_header(std::ostream& out) {
  out << "step,configuration,place,hash,running_hash,pairs,pairs_computed,colliding_pairs,contacts";
  for (const char* stage : kStages) out << ',' << stage << "_ms";
  out << ",synchronizations,redone,missed,iterative_unproven,dropped";
  for (const char* group : {"predicted", "actual", "capacity"}) {
    for (const char* buffer : kBuffers) out << ',' << group << '_' << buffer;
  }
  out << ",missed_pairs,missed_contacts,false_pairs\n";
}

void write_step(std::ostream& out, int step, std::size_t place, const Contestant& contestant,
                const std::optional<Missed>& missed) {
  const dBatchColliderStats& stats = contestant.stats();
  out << step << ',' << contestant.configuration().name() << ',' << place << ','
      << hex(contestant.hash()) << ',' << hex(contestant.running_hash()) << ',' << stats.pairs
      << ',' << stats.pairs_computed << ',' << contestant.colliding_pairs() << ','
      << contestant.contacts().size() << std::fixed << std::setprecision(kDecimals);
  for (const double ms : stats.ms) out << ',' << ms;
  out << ',' << stats.synchronizations << ',' << stats.redone << ',' << stats.missed << ','
      << stats.iterative_unproven << ',' << stats.dropped;
  for (const auto* group : {&stats.predicted, &stats.actual, &stats.capacity}) {
    for (const long long count : *group) out << ',' << count;
  }
  if (missed)
    out << ',' << missed->missed_pairs << ',' << missed->missed_contacts << ','
        << missed->false_pairs << '\n';
  else
    out << ",,,\n";
}

void write_work_header(std::ostream& out) {
  out << "step,configuration,redone,kernel,items,units,lockstep32,lockstep64\n";
}

void write_work(std::ostream& out, int step, const Contestant& contestant) {
  const dBatchColliderStats& stats = contestant.stats();
  for (std::size_t kernel = 0; kernel < kKernels.size(); ++kernel) {
    const dBatchWork& work = stats.work[kernel];
    if (work.items == 0) continue;
    out << step << ',' << contestant.configuration().name() << ',' << stats.redone << ','
        << kKernels[kernel] << ',' << work.items << ',' << work.units << ',' << work.lockstep32
        << ',' << work.lockstep64 << '\n';
  }
}

}  // namespace paper
