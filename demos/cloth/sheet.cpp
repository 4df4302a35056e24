// SPDX-License-Identifier: BSD-3-Clause
#include "cloth/sheet.h"

#include <cmath>

namespace falling_objects {
namespace {

// Half the edge of a box around the middle vertex that holds every shape a sheet can take: along
// the cloth no vertex is farther from it than half a diagonal, and a tenth more when stretched.
const double kReach = 1.1 * kSheetSize / std::sqrt(2.0);

}  // namespace

// ODE takes the box of a mesh when it is built, and never again (dGeomTriMeshDataUpdate does not
// look): the mesh is built with two vertices at the corners of a box that is always large enough.
// show() puts them where they belong.
Sheet::Sheet(dSpaceID space, Vector gravity)
    : cloth_(kSheetQuads, kSheetSize, gravity),
      vertices_(3 * cloth_.positions().size()),
      data_(dGeomTriMeshDataCreate()) {
  for (std::size_t k = 0; k < 3; ++k) {
    vertices_[k] = static_cast<float>(-kReach);
    vertices_[k + 3] = static_cast<float>(kReach);
  }
  static_assert(sizeof(dTriIndex) == sizeof(unsigned));
  const std::vector<unsigned>& indices = cloth_.triangles();
  dGeomTriMeshDataBuildSingle(data_, vertices_.data(), 3 * sizeof(float),
                              static_cast<int>(vertices_.size() / 3), indices.data(),
                              static_cast<int>(indices.size()), 3 * sizeof(unsigned));
  geom_ = dCreateTriMesh(space, data_, nullptr, nullptr, nullptr);
}

Sheet::~Sheet() {
  dBatchColliderTriMeshDataDestroyed(nullptr, data_);
  dGeomDestroy(geom_);
  dGeomTriMeshDataDestroy(data_);
}

// The geom follows the middle vertex: floats resolve a sheet's own size wherever it is, and its box
// stays small.
void Sheet::show(const std::vector<Vector>& vertices) {
  origin_ = vertices[cloth_.middle()];
  dGeomSetPosition(geom_, origin_.x, origin_.y, origin_.z);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vector p = vertices[i] - origin_;
    vertices_[3 * i] = static_cast<float>(p.x);
    vertices_[3 * i + 1] = static_cast<float>(p.y);
    vertices_[3 * i + 2] = static_cast<float>(p.z);
  }
  dGeomTriMeshDataUpdate(data_);
  dBatchColliderTriMeshDataUpdate(nullptr, data_);
}

Vector Sheet::seen(std::size_t vertex) const {
  return Vector{vertices_[3 * vertex], vertices_[3 * vertex + 1], vertices_[3 * vertex + 2]} +
         origin_;
}

}  // namespace falling_objects
