// SPDX-License-Identifier: BSD-3-Clause
#include "ode/mesh_import.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "ode/mesh_arrays.h"
#include "ode/read_triangle.h"

namespace ode_ext {

MeshReader::MeshReader(dTriMeshDataID data)
    : data_(data), geom_(dCreateTriMesh(nullptr, data, nullptr, nullptr, nullptr)) {}

MeshReader::~MeshReader() { dGeomDestroy(geom_); }

std::size_t MeshReader::triangle_count() const {
  return static_cast<std::size_t>(dGeomTriMeshGetTriangleCount(geom_));
}

void MeshReader::read(SourceTriangles& source) const {
  const std::size_t count = triangle_count();
  const std::optional<MeshArrays> arrays = arrays_of(data_);
  if (arrays && arrays->triangle_count == count && arrays->read(source)) return;
  TriangleSoup soup(3 * count);
  for (std::size_t i = 0; i < count; ++i) read_triangle(geom_, i, &soup[3 * i]);
  source = std::move(soup);
}

bool MeshReader::still_gives(const SourceTriangles& source) const {
  const std::size_t count = triangle_count();
  if (source.size() != 3 * count) return false;
  const std::optional<MeshArrays> arrays = arrays_of(data_);
  if (arrays && arrays->give(source)) return true;
  Vec3f corners[3];
  for (std::size_t i = 0; i < count; ++i) {
    read_triangle(geom_, i, corners);
    for (std::size_t k = 0; k < 3; ++k)
      if (std::memcmp(&corners[k], &source[3 * i + k], sizeof(Vec3f)) != 0) return false;
  }
  return true;
}

// ODE keeps the box of the float coordinates as a centre and extents, in its own precision: what it
// gives back may be off by the rounding of those, less than the last digit of a float.
bool MeshReader::knows(const Box& box) const {
  dReal bounds[6];
  dGeomGetAABB(geom_, bounds);
  for (std::size_t k = 0; k < 3; ++k) {
    const double lo = bounds[2 * k], hi = bounds[2 * k + 1];
    const double slack = 0x1p-23 * std::max(std::fabs(lo), std::fabs(hi));
    if (!(box.lo[k] >= lo - slack && box.hi[k] <= hi + slack)) return false;
  }
  return true;
}

}  // namespace ode_ext
