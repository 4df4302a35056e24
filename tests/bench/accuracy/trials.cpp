// SPDX-License-Identifier: BSD-3-Clause
#include "bench/accuracy/trial.h"

namespace ode_ext::accuracy {

std::span<const Trial> all_trials() {
  static constexpr Trial trials[] = {
      {"cubes", "a cube on a cube, 1 % deep, anywhere and turned in any way", prepare_cubes},
      {"rods", "square rods across each other, edge on edge, 0.5 to 5 % deep", prepare_rods},
      {"plate", "a plate 5 mm thick, 10 mm deep in a block's rim", prepare_plate},
      {"separation", "convex pairs 5 % deep, pushed apart along their deepest contact",
       prepare_separation},
      {"table", "the deepest contact of every pair of some shapes, against the truth",
       prepare_table},
      {"inverted", "meshes wound the wrong way round, against themselves wound rightly",
       prepare_inverted},
      {"composite", "meshes of which several parts touch: plates, a rack, a comb, an H in a frame",
       prepare_composite},
      {"coincident", "boxes in line, copies at one place, shared walls and edges",
       prepare_coincident},
  };
  return trials;
}

}  // namespace ode_ext::accuracy
