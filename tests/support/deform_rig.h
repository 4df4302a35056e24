// SPDX-License-Identifier: BSD-3-Clause
// Deformable meshes on the device, with all that the deform step makes of them read back.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "search/device_meshes.h"
#include "support/deformed.h"
#include "support/test_scene.h"

namespace ode_ext::test {

// What lies on the device of one mesh; all indices count from its own first.
struct RecordsOfMesh {
  ox_mesh mesh;
  std::vector<ox_vertex> vertices;
  std::vector<ox_triangle> triangles;
  std::vector<ox_chunk> chunks;
  std::vector<ox_meshlet> meshlets;  // their indices count over all meshes
  std::vector<ox_meshlet_node> meshlet_nodes;
};

class DeformRig {
 public:
  void set(const MeshList& meshes) {
    meshes_.set(meshes);
    device().finish();
  }
  DeviceMeshes& meshes() { return meshes_; }

  RecordsOfMesh read(std::uint32_t i) {
    const MeshTopology& built = *meshes_.mesh(i).topology;
    RecordsOfMesh records;
    meshes_.records().read(&records.mesh, sizeof(ox_mesh), i * sizeof(ox_mesh));
    device().finish();
    read(meshes_.vertices(), records.vertices, meshes_.range(i).vertex_first, built.vertex_count);
    read(meshes_.triangles(), records.triangles, records.mesh.triangle_first,
         built.triangles.size());
    read(meshes_.chunks(), records.chunks, records.mesh.chunk_first, built.chunks.size());
    read(meshes_.meshlets(), records.meshlets, records.mesh.meshlet_first,
         built.meshlets.meshlets.size());
    read(meshes_.meshlet_nodes(), records.meshlet_nodes, records.mesh.meshlet_node_first,
         built.meshlets.tree.size());
    device().finish();
    for (ox_chunk& chunk : records.chunks) chunk.first -= meshes_.range(i).vertex_first;
    return records;
  }

 private:
  // One for all tests of the process: building the kernels takes a second.
  static Program& program() {
    static Program* const program = new Program(*new Device(""), "");  // the driver may go first
    return *program;
  }
  static Device& device() { return program().device(); }

  template <class T>
  void read(const Buffer& buffer, std::vector<T>& records, std::size_t first, std::size_t count) {
    records.resize(count);
    buffer.read(records.data(), count * sizeof(T), first * sizeof(T));
  }

  DeviceMeshes meshes_{program()};
};

inline std::shared_ptr<const Mesh> deformable(const TriangleSoup& soup, float thickness = 0) {
  return std::make_shared<const Mesh>(
      build_mesh(soup, {.open_thickness = thickness, .deformable = true}));
}

// A sheet of so many triangles, cut off anywhere.
inline TriangleSoup strip(std::size_t triangles) {
  const int side = 1 + static_cast<int>(std::sqrt(0.5 * static_cast<double>(triangles)));
  TriangleSoup soup = soup_of(make_sheet(1, side));
  soup.resize(3 * triangles);
  return soup;
}

// Bulged and shaken: each place goes to another one, by up to about a quarter.
inline TriangleSoup bent(TriangleSoup soup, float phase = 0) {
  for (Vec3f& p : soup) {
    const float x = p.x, y = p.y;
    p.x += 0.05f * std::sin(7 * y + phase) + 0.003f * std::sin(91 * x + 57 * y);
    p.y += 0.05f * std::cos(5 * p.z + 3 * x + phase);
    p.z += 0.1f * std::sin(4 * x + phase) * std::cos(3 * y);
  }
  return soup;
}

inline Vec3f vec(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

}  // namespace ode_ext::test
