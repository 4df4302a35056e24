// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/show/mesh_of_geom.h"

#include <array>
#include <map>
#include <set>
#include <utility>

namespace falling_objects {
namespace {

bool is_closed(const std::vector<unsigned>& triangles) {
  std::set<std::pair<unsigned, unsigned>> edges;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
    if (!edges.emplace(triangles[i], triangles[next]).second) return false;
  }
  for (const auto& [from, to] : edges) {
    if (!edges.contains({to, from})) return false;
  }
  return true;
}

}  // namespace

IndexedMesh mesh_of(dTriMeshDataID data) {
  // A geom of nobody's, at no pose, shows the vertices as they are.
  dGeomID geom = dCreateTriMesh(nullptr, data, nullptr, nullptr, nullptr);
  IndexedMesh mesh;
  std::map<std::array<float, 3>, unsigned> numbers;
  const int count = dGeomTriMeshGetTriangleCount(geom);
  for (int t = 0; t < count; ++t) {
    std::array<dVector3, 3> corners{};
    dGeomTriMeshGetTriangle(geom, t, &corners[0], &corners[1], &corners[2]);
    for (const auto& corner : corners) {
      const glm::vec3 p = to_glm(corner);
      const auto number = static_cast<unsigned>(mesh.positions.size());
      const auto [known, is_new] = numbers.try_emplace({p.x, p.y, p.z}, number);
      if (is_new) mesh.positions.push_back(p);
      mesh.triangles.push_back(known->second);
    }
  }
  dGeomDestroy(geom);
  mesh.closed = is_closed(mesh.triangles);
  return mesh;
}

view::Pose pose_of(dGeomID geom) {
  const dReal* r = dGeomGetRotation(geom);  // rows of four
  const auto column = [&](int k) {
    return glm::vec3(static_cast<float>(r[k]), static_cast<float>(r[4 + k]),
                     static_cast<float>(r[8 + k]));
  };
  return view::Pose(column(0), column(1), column(2), to_glm(dGeomGetPosition(geom)));
}

}  // namespace falling_objects
