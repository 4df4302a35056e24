// SPDX-License-Identifier: BSD-3-Clause
// All meshes in device memory, kept up with where they come, go and deform.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "abi/types.h"
#include "mesh/mesh.h"
#include "opencl/buffer.h"
#include "search/deform_step.h"
#include "search/mesh_records.h"

namespace ode_ext {

class DeviceMeshes {
 public:
  explicit DeviceMeshes(Program& program);

  // Makes `meshes` the ones on the device: mesh i is the i-th. The same list again uploads nothing,
  // a list in which only shapes of deformable meshes changed the positions of those, and any other
  // the meshes that were not there: what stays, stays where it is. All of them go up anew where
  // more would be out of use than in use. Sources of what is enqueued live in this object. Another
  // list waits once where memory is not shared. After a DeviceError: forget().
  void set(const MeshList& meshes);
  // The device lost its contents: the next set() uploads again. Gives their memory back.
  void forget();

  void warm_up(Launch wide) { deform_.warm_up(wide, *this); }
  // Device time of the deform step since the last call [ms].
  double take_milliseconds() { return deform_.take_milliseconds(); }

  const Mesh& mesh(std::uint32_t i) const { return *placed_[i].mesh; }
  const MeshRange& range(std::uint32_t i) const { return placed_[i].range; }

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
  const Buffer& topologies() const { return parts_.topologies; }

 private:
  // A mesh and where it is.
  struct Placed {
    std::shared_ptr<const Mesh> mesh;  // in the shape in which the device has it
    MeshRange range{};
    ox_mesh record{};
    bool moving = false;  // its vertices moved at the last set()
    bool is_new = true;   // in this set()
  };

  bool are_placed(const MeshList& meshes) const;
  void place(const MeshList& meshes);
  void place_anew(const MeshList& meshes, std::vector<Placed>& places);
  bool try_to_append(const MeshCounts& more, std::vector<Placed>& places);
  void append(const MeshCounts& more, std::vector<Placed>& places);
  void append_owners(const MeshTopology& mesh);
  void add_move(std::uint32_t mesh, const Mesh& shape, bool rests);

  Device& device_;
  DeformStep deform_;
  std::vector<Placed> placed_;  // mesh i is the i-th
  MeshCounts end_;              // of what is placed, in use or not
  std::vector<std::uint32_t> owner_triangles_;
  std::vector<ox_mesh> host_records_;
  std::vector<MeshMove> moves_;
  std::vector<Vec3f> positions_;  // of the moves, one mesh after the other
  Buffer mesh_records_;
  MeshBuffers parts_;
};

}  // namespace ode_ext
