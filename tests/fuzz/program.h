// SPDX-License-Identifier: BSD-3-Clause
// Bytes as a program: meshes, spaces and poses are made, changed and destroyed, colliders asked in
// every way the C API has, and every answer is judged. The same bytes are always the same program.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "fuzz/colliders.h"
#include "fuzz/oracles.h"

namespace ode_ext::fuzz {

struct ProgramOptions {
  // A pair of meshes of a few hundred triangles that takes this much processor time [s], and this
  // many times what it takes in stock ODE, is a flaw; and so is any call that takes `hang` [s], all
  // included: meshes are built in it, with sanitizers.
  double slow = 2, times_stock = 200, hang = 20;
  // For tests of the oracles: changes what the library answered before it is judged.
  std::function<void(std::vector<dContactGeom>&)> tamper;
  // For tests of the guard: called before every answer that is timed.
  std::function<void()> delay;
};

struct Verdict {
  std::string flaw;   // "": none was found
  bool slow = false;  // the flaw is that something took too long
  Tally tally;
};

// Runs until the bytes end, 64 operations are done, or there is a flaw. Between dInitODE2 and
// dCloseODE; leaves nothing behind but what `colliders` keep.
Verdict run_program(std::span<const std::uint8_t> bytes, Colliders& colliders,
                    const ProgramOptions& options = {});

// The first byte of every operation of a program, modulo 32; the values above these mean some of
// them again. In the end each geom is collided with every other.
enum class Operation : std::uint8_t {
  MakeMesh,
  MakeGeom,
  MakeSpace,
  Pose,
  Pass,
  CollidePairs,
  Collide,
  Pass2,
  Shake,
  Edit,
  Rebuild,
  DestroyMesh,
  DestroyGeom,
  MoveToSpace,
  GiveMesh,
  Deformable,
  CreateCollider,
  DestroyCollider,
  Stats,
  BadCall,
  Fault,
  Announce,
  Count
};
inline constexpr int kOperations = static_cast<int>(Operation::Count);

}  // namespace ode_ext::fuzz
