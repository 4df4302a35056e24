// SPDX-License-Identifier: BSD-3-Clause
#include "tools/replay/played_mesh.h"

#include <numeric>

namespace ode_ext::replay {

PlayedMesh::PlayedMesh(dBatchColliderID collider, const MeshRecord& mesh, const MeshRecord* base)
    : collider_(collider),
      is_shape_(base != nullptr),
      corners_(base != nullptr ? base->corners : mesh.corners),
      indices_(corners_.size() / 3),
      data_(dGeomTriMeshDataCreate()) {
  std::iota(indices_.begin(), indices_.end(), dTriIndex{0});
  dGeomTriMeshDataBuildSingle(data_, corners_.data(), 3 * sizeof(float),
                              static_cast<int>(indices_.size()), indices_.data(),
                              static_cast<int>(indices_.size()), 3 * sizeof(dTriIndex));
  if (mesh.deformable != 0) dBatchColliderTriMeshDataSetDeformable(collider_, data_, 1);
  if (!is_shape_) return;
  show_base();
  corners_ = mesh.corners;  // of the same size, so they stay where they are
  // ODE has no tree of a single triangle, and looks for its root.
  if (indices_.size() > 3) dGeomTriMeshDataUpdate(data_);
  dBatchColliderTriMeshDataUpdate(collider_, data_);
}

PlayedMesh::~PlayedMesh() {
  dBatchColliderTriMeshDataDestroyed(collider_, data_);
  dGeomTriMeshDataDestroy(data_);
}

// The collider takes a deformable mesh for built as it is when first met. Met is what a pair is of.
void PlayedMesh::show_base() const {
  dGeomID geoms[] = {dCreateTriMesh(nullptr, data_, nullptr, nullptr, nullptr),
                     dCreateTriMesh(nullptr, data_, nullptr, nullptr, nullptr)};
  dReal box[6];
  dGeomGetAABB(geoms[0], box);
  dGeomSetPosition(geoms[1], 4 * (box[1] - box[0]) + 1, 0, 0);
  dContactGeom contact;
  dBatchColliderCollidePairs(collider_, geoms, 1, 1, &contact, sizeof(contact), nullptr);
  for (const dGeomID geom : geoms) dGeomDestroy(geom);
}

}  // namespace ode_ext::replay
