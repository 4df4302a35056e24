// SPDX-License-Identifier: BSD-3-Clause
#include "ode/mesh_import.h"

#include <algorithm>
#include <cmath>

#include "geometry/measures.h"

namespace ode_ext {
namespace {

class PrivateGeom {
 public:
  explicit PrivateGeom(dTriMeshDataID data)
      : geom_(dCreateTriMesh(nullptr, data, nullptr, nullptr, nullptr)) {}
  ~PrivateGeom() { dGeomDestroy(geom_); }
  PrivateGeom(const PrivateGeom&) = delete;
  PrivateGeom& operator=(const PrivateGeom&) = delete;
  dGeomID get() const { return geom_; }

 private:
  dGeomID geom_;
};

Vec3f to_vec(const dReal* v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

// ODE keeps the box of the float coordinates as a centre and extents, in its own precision: what it
// gives back may be off by the rounding of those, less than the last digit of a float.
class KnownBox {
 public:
  explicit KnownBox(dGeomID geom) {
    dReal bounds[6];
    dGeomGetAABB(geom, bounds);
    for (std::size_t k = 0; k < 3; ++k) {
      const double slack =
          0x1p-23 * std::max(std::fabs(bounds[2 * k]), std::fabs(bounds[2 * k + 1]));
      lo_[k] = bounds[2 * k] - slack;
      hi_[k] = bounds[2 * k + 1] + slack;
    }
  }
  bool holds(const TriangleSoup& soup) const {
    bool inside = true;
    for (const Vec3f& corner : soup)
      for (std::size_t k = 0; k < 3; ++k) inside &= corner[k] >= lo_[k] && corner[k] <= hi_[k];
    return inside;
  }

 private:
  Vec3d lo_, hi_;
};

}  // namespace

bool read_triangles(dTriMeshDataID data, TriangleSoup& soup) {
  const PrivateGeom geom(data);
  const int count = dGeomTriMeshGetTriangleCount(geom.get());
  soup.resize(3 * static_cast<std::size_t>(count));
  Vec3f* corner = soup.data();
  for (int i = 0; i < count; ++i) {
    dVector3 v0, v1, v2;
    dGeomTriMeshGetTriangle(geom.get(), i, &v0, &v1, &v2);
    *corner++ = to_vec(v0);
    *corner++ = to_vec(v1);
    *corner++ = to_vec(v2);
  }
  return !KnownBox(geom.get()).holds(soup) && is_finite(soup);
}

}  // namespace ode_ext
