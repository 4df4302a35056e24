// SPDX-License-Identifier: BSD-3-Clause
// All meshes, concatenated in device memory, and kept up with where they deform.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "abi/types.h"
#include "mesh/mesh.h"
#include "opencl/buffer.h"
#include "search/deform_step.h"
#include "search/deform_topology.h"
#include "search/meshlet_records.h"

namespace ode_ext {

class DeviceMeshes {
 public:
  explicit DeviceMeshes(Program& program);

  // Makes `meshes` the ones on the device: mesh i is the i-th. The same list again uploads nothing,
  // a list in which only shapes of deformable meshes changed the positions of those. Everything is
  // enqueued; the sources live in this object.
  void set(const std::vector<std::shared_ptr<const Mesh>>& meshes);
  // The device lost its contents: the next set() uploads again.
  void forget();

  void warm_up(Launch wide) { deform_.warm_up(wide, *this); }
  // Device time of the deform step since the last call [ms].
  double take_milliseconds() { return deform_.take_milliseconds(); }

  const Mesh& mesh(std::uint32_t i) const { return *meshes_[i]; }
  const MeshRange& range(std::uint32_t i) const { return ranges_[i]; }

  // The program's index of a triangle at a vertex (the lowest); `vertex` counts over all meshes.
  std::uint32_t owner_triangle(std::uint32_t vertex) const { return owner_triangles_[vertex]; }

  const Buffer& records() const { return records_; }
  const Buffer& chunks() const { return chunks_; }
  const Buffer& vertices() const { return vertices_; }
  const Buffer& triangles() const { return triangles_; }
  const Buffer& edges() const { return edges_; }
  // Of vertex v: rings()[ring_starts()[v]] to before ring_starts()[v + 1].
  const Buffer& ring_starts() const { return ring_starts_; }
  const Buffer& rings() const { return rings_; }
  const Buffer& meshlets() const { return meshlets_; }
  const Buffer& meshlet_nodes() const { return meshlet_nodes_; }
  // Of each triangle, over all triangles: the number of its facet within its mesh.
  const Buffer& facets() const { return facets_; }
  const Buffer& topologies() const { return topologies_; }  // see ox_move

 private:
  using MeshList = std::vector<std::shared_ptr<const Mesh>>;

  struct Deformable {
    DeformTopology topology;
    bool moving = false;  // its vertices moved at the last set()
  };

  bool are_shapes_of_the_same(const MeshList& meshes) const;
  void rebuild(const MeshList& meshes);
  void reserve(const MeshList& meshes);
  void forget_sources();
  // `before`: the shape it had until now, if it was here.
  void append(const Mesh& mesh, const Mesh* before);
  void append_edges(const MeshTopology& mesh, const MeshRange& first);
  void append_rings(const MeshTopology& mesh, const MeshRange& first);
  void append_triangles(const Mesh& mesh, const MeshRange& first);
  void append_owners(const MeshTopology& mesh, std::uint32_t vertex_first);
  void upload();
  void add_move(std::uint32_t mesh, const Mesh& shape, bool rests);

  DeformStep deform_;
  MeshList meshes_;
  std::vector<MeshRange> ranges_;
  std::vector<std::uint32_t> owner_triangles_;
  std::vector<ox_mesh> host_records_;
  std::vector<ox_chunk> host_chunks_;
  std::vector<ox_vertex> host_vertices_;
  std::vector<ox_triangle> host_triangles_;
  std::vector<ox_edge> host_edges_;
  std::vector<ox_u32> host_ring_starts_;  // one more than there are vertices
  std::vector<ox_neighbour> host_rings_;
  std::vector<ox_meshlet> host_meshlets_;
  std::vector<ox_meshlet_node> host_meshlet_nodes_;
  std::vector<ox_u32> host_facets_;
  std::vector<ox_u32> host_topologies_;
  std::map<std::uint32_t, Deformable> deformables_;  // by mesh
  std::vector<MeshMove> moves_;
  std::vector<Vec3f> positions_;  // of the moves, one mesh after the other
  Buffer records_, chunks_, vertices_, triangles_, edges_, ring_starts_, rings_, meshlets_,
      meshlet_nodes_, facets_, topologies_;
};

}  // namespace ode_ext
