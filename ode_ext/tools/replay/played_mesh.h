// SPDX-License-Identifier: BSD-3-Clause
// A captured mesh as ODE has it, with the arrays that ODE refers to and never copies.
#pragma once

#include <ode_ext/ode_ext.h>

#include <vector>

#include "tools/replay/capture_file.h"

namespace ode_ext::replay {

class PlayedMesh {
 public:
  // `base`: of a shape of a deformable mesh that mesh as it was built, else null.
  PlayedMesh(dBatchColliderID collider, const MeshRecord& mesh, const MeshRecord* base);
  ~PlayedMesh();
  PlayedMesh(const PlayedMesh&) = delete;
  PlayedMesh& operator=(const PlayedMesh&) = delete;

  dTriMeshDataID data() const { return data_; }
  bool is_shape() const { return is_shape_; }

 private:
  void show_base() const;

  dBatchColliderID collider_;
  bool is_shape_;
  std::vector<float> corners_;
  std::vector<dTriIndex> indices_;
  dTriMeshDataID data_;
};

}  // namespace ode_ext::replay
