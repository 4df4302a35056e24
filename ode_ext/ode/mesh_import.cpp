// SPDX-License-Identifier: BSD-3-Clause
#include "ode/mesh_import.h"

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

}  // namespace

void read_triangles(dTriMeshDataID data, TriangleSoup& soup) {
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
}

}  // namespace ode_ext
