// SPDX-License-Identifier: BSD-3-Clause
// The vertices and indices that a program handed to ODE, in place. ODE's one call that gives a
// triangle takes ten times as long as reading it; to see whether a mesh is what it was, all are
// read, in every pass. A dTriMeshData is opaque, so where it keeps the arrays is found out: some
// are built of arrays that are known, and searched for their addresses, strides and counts. Where
// that tells nothing, as in an ODE of another make, there are no arrays here, and ODE is asked.
#pragma once

#include <ode/ode.h>

#include <cstddef>
#include <optional>

#include "mesh/mesh.h"

namespace ode_ext {

struct MeshArrays {
  const unsigned char* vertices;
  std::size_t vertex_stride;  // [bytes]
  std::size_t vertex_count;
  const unsigned char* indices;
  std::size_t index_stride;  // of a triangle [bytes]
  std::size_t triangle_count;
  bool is_single;  // coordinates are floats, not doubles

  bool operator==(const MeshArrays&) const = default;  // the same arrays, whatever is in them

  // Overwrites `source` by the triangles, bit for bit as ODE gives them; the places are the
  // vertices up to the last that a triangle names, or where these are more than there are corners,
  // one for each corner. False: of what is not finite, or names no vertex, ODE has to be asked.
  bool read(SourceTriangles& source) const;
  // Whether read() would give the same triangles. False is no answer: ODE has to be asked. Fastest
  // where `source` was read from these arrays; other arrays may give the same triangles.
  bool give(const SourceTriangles& source) const;
};

// Of data that a live geom has just named.
std::optional<MeshArrays> arrays_of(dTriMeshDataID data);

}  // namespace ode_ext
