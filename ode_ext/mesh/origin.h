// SPDX-License-Identifier: BSD-3-Clause
// What the vertices of a mesh are best measured from. What rounding can do to a coordinate goes by
// its distance from the origin (pair_step.cl): the tile of a terrain that is modelled where it
// lies, 10 km out, would be known to a centimetre. From its middle it is known as if it lay here.
#pragma once

#include "mesh/box.h"

namespace ode_ext {

// The middle of what is in the box, along each axis on which it lies so far out that it can be
// subtracted from each coordinate exactly; 0 along the others, where it would gain a bit or two.
// [m]
Vec3f exact_origin(const Box& box);

}  // namespace ode_ext
