// SPDX-License-Identifier: BSD-3-Clause
// Meshes for examples, as ODE wants them: triangles wound counter-clockwise seen from outside.
#pragma once

#include <ode/ode.h>

#include <vector>

namespace contacts {

struct Mesh {
  std::vector<float> vertices;  // xyz, xyz, ... [m]
  std::vector<dTriIndex> indices;

  void add_vertex(double x, double y, double z);
  void add_quad(dTriIndex a, dTriIndex b, dTriIndex c, dTriIndex d);
};

// Twelve triangles. [m]
Mesh make_box(double x, double y, double z);

// A comb: `teeth` of length z hang from a bar along x that is as high as wide, 2 * width apart; the
// bar's lower side is z = 0.
Mesh make_comb(int teeth, double width, double z);

// Open, over a square of the given side about 0: parallel ridges along y, `ridges` of them, with
// straight slopes between them.
Mesh make_ridges(double side, int ridges, double height);

}  // namespace contacts
