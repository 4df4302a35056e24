// SPDX-License-Identifier: BSD-3-Clause
// All meshes, concatenated in device memory.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "device/buffer.h"
#include "geometry/mesh.h"
#include "shared/types.h"

namespace ode_ext {

// Where the parts of a mesh start in the concatenated arrays.
struct MeshPlace {
  std::uint32_t vertex_first = 0;
  std::uint32_t triangle_first = 0;
};

class DeviceMeshes {
 public:
  explicit DeviceMeshes(Device& device);

  // Makes `meshes` the ones on the device: mesh i is the i-th. The same list again uploads nothing.
  // The uploads are enqueued; the sources live in this object.
  void set(const std::vector<std::shared_ptr<const Mesh>>& meshes);
  // The device lost its contents: the next set() uploads again.
  void forget() { meshes_.clear(); }

  const Mesh& mesh(std::uint32_t i) const { return *meshes_[i]; }
  const MeshPlace& place(std::uint32_t i) const { return places_[i]; }

  // The program's index of a triangle at a vertex (the lowest); `vertex` counts over all meshes.
  std::uint32_t owner_triangle(std::uint32_t vertex) const { return owner_triangles_[vertex]; }

  const Buffer& records() const { return records_; }
  const Buffer& chunks() const { return chunks_; }
  const Buffer& vertices() const { return vertices_; }
  const Buffer& nodes() const { return nodes_; }
  const Buffer& triangles() const { return triangles_; }
  const Buffer& grids() const { return grids_; }

 private:
  void append(const Mesh& mesh);
  void upload();

  Device* device_;
  std::vector<std::shared_ptr<const Mesh>> meshes_;
  std::vector<MeshPlace> places_;
  std::vector<std::uint32_t> owner_triangles_;
  std::vector<ox_mesh> host_records_;
  std::vector<ox_chunk> host_chunks_;
  std::vector<ox_vertex> host_vertices_;
  std::vector<ox_node> host_nodes_;
  std::vector<ox_triangle> host_triangles_;
  std::vector<ox_u32> host_grids_;
  Buffer records_, chunks_, vertices_, nodes_, triangles_, grids_;
};

}  // namespace ode_ext
