// SPDX-License-Identifier: BSD-3-Clause
// The kernels of the pipeline by step. Each launches with its inputs and outputs spelled out once.
#pragma once

#include "device/program.h"
#include "pipeline/contact_step.h"
#include "pipeline/monolithic_step.h"
#include "pipeline/pair_step.h"
#include "pipeline/ray_step.h"
#include "pipeline/search_step.h"
#include "pipeline/vertex_step.h"

namespace ode_ext {

struct Steps {
  explicit Steps(Program& program)
      : pair(program),
        vertex(program),
        iterative(program, "ray_iterative"),
        bvh(program, "ray_bvh"),
        basic(program, "ray_basic"),
        monolithic(program),
        cull(program),
        match(program),
        cross(program),
        flood(program),
        contact(program) {}

  PairStep pair;
  VertexStep vertex;
  RayStep iterative, bvh, basic;
  MonolithicStep monolithic;
  CullStep cull;
  MatchStep match;
  CrossStep cross;
  FloodStep flood;
  ContactStep contact;
};

}  // namespace ode_ext
