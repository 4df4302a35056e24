// SPDX-License-Identifier: BSD-3-Clause
// All meshes, concatenated in device memory, and kept up with where they deform.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "abi/types.h"
#include "mesh/mesh.h"
#include "opencl/buffer.h"
#include "search/deform_step.h"
#include "search/deform_topology.h"
#include "search/mesh_records.h"

namespace ode_ext {

class DeviceMeshes {
 public:
  explicit DeviceMeshes(Program& program);

  // Makes `meshes` the ones on the device: mesh i is the i-th. The same list again uploads nothing,
  // a list in which only shapes of deformable meshes changed the positions of those. Sources of
  // what is enqueued live in this object. Any other list waits once where memory is not shared.
  void set(const MeshList& meshes);
  // The device lost its contents: the next set() uploads again.
  void forget();

  void warm_up(Launch wide) { deform_.warm_up(wide, *this); }
  // Device time of the deform step since the last call [ms].
  double take_milliseconds() { return deform_.take_milliseconds(); }

  const Mesh& mesh(std::uint32_t i) const { return *meshes_[i]; }
  const MeshRange& range(std::uint32_t i) const { return ranges_[i]; }

  // The program's index of a triangle at a vertex (the lowest); `vertex` counts over all meshes.
  std::uint32_t owner_triangle(std::uint32_t vertex) const { return owner_triangles_[vertex]; }

  const Buffer& records() const { return mesh_records_; }
  const Buffer& chunks() const { return parts_.chunks; }
  const Buffer& vertices() const { return parts_.vertices; }
  const Buffer& triangles() const { return parts_.triangles; }
  const Buffer& edges() const { return parts_.edges; }
  const Buffer& ring_starts() const { return parts_.ring_starts; }
  const Buffer& rings() const { return parts_.rings; }
  const Buffer& meshlets() const { return parts_.meshlets; }
  const Buffer& meshlet_nodes() const { return parts_.meshlet_nodes; }
  const Buffer& facets() const { return parts_.facets; }
  const Buffer& topologies() const { return topologies_; }  // see ox_move

 private:
  struct Deformable {
    DeformTopology topology;
    bool moving = false;  // its vertices moved at the last set()
  };

  bool are_shapes_of_the_same(const MeshList& meshes) const;
  void rebuild(const MeshList& meshes);
  void append(MeshRecords& parts, const Mesh& mesh, const Mesh* before);
  void append_owners(const MeshTopology& mesh);
  void add_move(std::uint32_t mesh, const Mesh& shape, bool rests);

  Device& device_;
  DeformStep deform_;
  MeshList meshes_;
  std::vector<MeshRange> ranges_;
  std::vector<std::uint32_t> owner_triangles_;
  std::vector<ox_mesh> host_records_;
  std::vector<ox_u32> host_topologies_;
  std::map<std::uint32_t, Deformable> deformables_;  // by mesh
  std::vector<MeshMove> moves_;
  std::vector<Vec3f> positions_;  // of the moves, one mesh after the other
  Buffer mesh_records_;
  MeshBuffers parts_;
  Buffer topologies_;
};

}  // namespace ode_ext
