// SPDX-License-Identifier: BSD-3-Clause
#include "paper/tables.h"

#include <iomanip>
#include <string>

#include "paper/hex.h"
#include "simulation/step_record.h"

namespace paper {
namespace {

// Visits the append buffers' counters, each with what was produced, expected and had room.
template <class Visit>
void for_each_buffer(Visit visit) {
  for (int counter = dBatchBufferChunksSmall; counter >= 0; counter = dBatchCounterNext(counter))
    visit(counter);
}

constexpr int kDecimals = 4;  // of a millisecond

}  // namespace

void write_steps_header(std::ostream& out) {
  out << "step,configuration,place,hash,running_hash,pairs,pairs_computed,colliding_pairs,contacts";
  for (const int stage : falling_objects::stages()) out << ',' << dBatchStageName(stage) << "_ms";
  out << ",synchronizations,redone,missed,iterative_unproven,dropped";
  for_each_buffer([&](int counter) { out << ',' << dBatchCounterName(counter); });
  out << ",missed_pairs,missed_contacts,false_pairs\n";
}

void write_step(std::ostream& out, int step, std::size_t place, const Contestant& contestant,
                const std::optional<Missed>& missed) {
  const dBatchColliderID collider = contestant.collider();
  const auto count = [&](int counter) { return dBatchColliderGetCount(collider, counter); };
  out << step << ',' << contestant.configuration().name() << ',' << place << ','
      << hex(contestant.hash()) << ',' << hex(contestant.running_hash()) << ','
      << count(dBatchCounterPairs) << ',' << count(dBatchCounterPairsComputed) << ','
      << contestant.colliding_pairs() << ',' << contestant.contacts().size() << std::fixed
      << std::setprecision(kDecimals);
  for (const int stage : falling_objects::stages())
    out << ',' << dBatchColliderGetTime(collider, stage);
  for (const int counter : {dBatchCounterSynchronizations, dBatchCounterRedone, dBatchCounterMissed,
                            dBatchCounterIterativeUnproven, dBatchCounterDropped})
    out << ',' << count(counter);
  for_each_buffer([&](int counter) { out << ',' << count(counter); });
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
  const dBatchColliderID collider = contestant.collider();
  for (const int stage : {dBatchStageVertexStep, dBatchStageIterativeRays, dBatchStageBvhRays,
                          dBatchStageBasicRays, dBatchStageMonolithic}) {
    const auto work = [&](int quantity) {
      return dBatchColliderGetWork(collider, stage, quantity);
    };
    if (work(dBatchWorkItems) == 0) continue;
    out << step << ',' << contestant.configuration().name() << ','
        << dBatchColliderGetCount(collider, dBatchCounterRedone) << ',' << dBatchStageName(stage);
    for (const int quantity :
         {dBatchWorkItems, dBatchWorkUnits, dBatchWorkLockstep32, dBatchWorkLockstep64})
      out << ',' << work(quantity);
    out << '\n';
  }
}

}  // namespace paper
