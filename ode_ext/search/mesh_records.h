// SPDX-License-Identifier: BSD-3-Clause
// The records of meshes, one mesh after the other, written into device memory in place. Vertices,
// triangles and edges are named by where they are among those of all meshes, so a mesh stays where
// it is.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "abi/types.h"
#include "mesh/mesh.h"
#include "opencl/buffer.h"
#include "opencl/mapped_records.h"
#include "search/meshlet_records.h"

namespace ode_ext {

using MeshList = std::vector<std::shared_ptr<const Mesh>>;

// How many records meshes have, of each kind.
struct MeshCounts {
  std::size_t chunks = 0, vertices = 0, triangles = 0, edges = 0, meshlets = 0, meshlet_nodes = 0;
  std::size_t topology_words = 0;  // search/deform_topology.h
  void add(const Mesh& mesh);
};

struct MeshBuffers {
  explicit MeshBuffers(Device& device);
  void release();

  Buffer chunks, vertices, triangles, edges;
  // Of vertex v: rings[ring_starts[v]] to before ring_starts[v + 1].
  Buffer ring_starts, rings;
  Buffer meshlets, meshlet_nodes;
  Buffer topologies;  // of deformable meshes: search/deform_topology.h
};

class MeshRecords {
 public:
  // Room for `more` after the `kept` first ones, which stay. Meshes can be appended once the device
  // is idle.
  MeshRecords(MeshBuffers& buffers, const MeshCounts& kept, const MeshCounts& more);

  // Where the parts of the next mesh begin.
  MeshRange next() const;
  // Appends a mesh and returns what there is of itself. The deform step makes of deformable ones
  // what depends on where their vertices are.
  ox_mesh append(const Mesh& mesh);
  // After the last; returns how many there are with those kept. Throws DeviceError.
  MeshCounts close();

 private:
  void append_vertices(const Mesh& mesh);
  void append_triangles(const Mesh& mesh, const MeshRange& first);
  void append_edges(const MeshTopology& mesh, const MeshRange& first);
  void append_rings(const MeshTopology& mesh, const MeshRange& first);

  MappedRecords<ox_chunk> chunks_;
  MappedRecords<ox_vertex> vertices_;
  MappedRecords<ox_triangle> triangles_;
  MappedRecords<ox_edge> edges_;
  MappedRecords<ox_u32> ring_starts_;  // one more than there are vertices
  MappedRecords<ox_neighbour> rings_;
  MappedRecords<ox_meshlet> meshlets_;
  MappedRecords<ox_meshlet_node> meshlet_nodes_;
  MappedRecords<ox_u32> topologies_;
};

// What a mesh and each of its shapes have of their own.
void measure(const Mesh& mesh, ox_mesh& record);

// Of the vertices of a deformable mesh [m]; a closed one's come from rays.
float thickness_of(const Mesh& mesh);

}  // namespace ode_ext
