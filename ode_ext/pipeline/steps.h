// SPDX-License-Identifier: BSD-3-Clause
// The kernels of the pipeline by step, but for those of rays of vertices (vertex_rays.h).
#pragma once

#include <optional>

#include "device/program.h"
#include "pipeline/contact_step.h"
#include "pipeline/pair_step.h"
#include "pipeline/search_step.h"
#include "pipeline/stage.h"
#include "pipeline/whole_step.h"

namespace ode_ext {

struct Steps {
  // has_whole: the program was built for a whole step too.
  Steps(Program& program, bool has_whole)
      : pair(program),
        cull(program),
        match(program),
        cross(program),
        flood(program),
        gather(program),
        edge_contacts(program),
        reduce(program) {
    if (has_whole) whole.emplace(program);
  }

  // Adds the device time since the last call.
  void take_milliseconds(StageTimes& ms) {
    add_time(ms, Stage::kPairStep, pair);
    add_time(ms, Stage::kCull, cull);
    add_time(ms, Stage::kMatch, match);
    add_time(ms, Stage::kCross, cross);
    add_time(ms, Stage::kFlood, flood);
    add_time(ms, Stage::kEdgeContacts, edge_contacts);
    add_time(ms, Stage::kContactStep, gather);
    add_time(ms, Stage::kContactStep, reduce);
    if (whole.has_value()) add_time(ms, Stage::kWholeStep, *whole);
  }

  PairStep pair;
  CullStep cull;
  MatchStep match;
  CrossStep cross;
  FloodStep flood;
  GatherStep gather;
  EdgeContactStep edge_contacts;
  ReduceStep reduce;
  std::optional<WholeStep> whole;  // on devices that run it
};

}  // namespace ode_ext
