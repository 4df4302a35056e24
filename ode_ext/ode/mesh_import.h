// SPDX-License-Identifier: BSD-3-Clause
// The triangles of a dTriMeshData, bit for bit as ODE itself rounds them (to float). ODE has no
// call that gives them; the program's arrays do, where ODE shows them (mesh_arrays.h), else a geom
// of the data at the identity pose.
#pragma once

#include <ode/ode.h>

#include "mesh/mesh.h"

namespace ode_ext {

// The geom lives only in here, in no space; allowed inside callbacks. A reader must go before the
// data do, and before any code of the program runs.
class MeshReader {
 public:
  explicit MeshReader(dTriMeshDataID data);
  ~MeshReader();
  MeshReader(const MeshReader&) = delete;
  MeshReader& operator=(const MeshReader&) = delete;

  void read(SourceTriangles& source) const;  // overwrites it
  // Whether read() would give the same triangles, bit for bit; looks no further than the first that
  // differs.
  bool still_gives(const SourceTriangles& source) const;
  // Whether `box` is within the one that ODE took of the data when it was built, by which it finds
  // pairs.
  bool knows(const Box& box) const;

 private:
  std::size_t triangle_count() const;

  dTriMeshDataID data_;
  dGeomID geom_;
};

}  // namespace ode_ext
