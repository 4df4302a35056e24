// SPDX-License-Identifier: BSD-3-Clause
#include "judging/draping.h"

#include <algorithm>

#include "simulation/pose.h"

namespace falling_objects {

using ode_ext::oracle::Mesh;
using ode_ext::oracle::Pose;
using ode_ext::oracle::Triangle;

DrapingMeter::DrapingMeter(const Scene& scene, const std::vector<std::unique_ptr<Sheet>>& sheets)
    : scene_(scene), sheets_(sheets) {
  const auto add = [&](const TriangleMesh& mesh) {
    meshes_.emplace_back(mesh.vertices, mesh.indices);
    crossings_.emplace_back(meshes_.back().triangles());
  };
  for (const Shape& shape : scene.shapes()) add(shape.mesh);
  add(scene.ground().mesh());
}

std::vector<DrapingMeter::Target> DrapingMeter::targets() const {
  std::vector<Target> result;
  const auto add = [&](std::size_t mesh, const Pose& pose) {
    if (meshes_[mesh].closed()) result.push_back({meshes_[mesh], crossings_[mesh], pose});
  };
  for (const Object& object : scene_.objects()) add(object.shape, pose_of(object.body));
  add(meshes_.size() - 1, Pose{});
  return result;
}

Draping DrapingMeter::measure() const {
  Draping draping;
  const std::vector<Target> all = targets();
  for (const auto& sheet : sheets_) measure(sheet->cloth(), all, draping);
  return draping;
}

void DrapingMeter::measure(const Cloth& cloth, const std::vector<Target>& targets,
                           Draping& draping) const {
  const std::vector<Vector>& vertices = cloth.positions();
  const std::vector<unsigned>& corners = cloth.triangles();
  const Vector middle = vertices[cloth.middle()];
  double reach = 0;
  for (const Vector& v : vertices) reach = std::max(reach, length(v - middle));
  std::vector<double> depths(vertices.size());
  std::vector<bool> crossing(corners.size() / 3);
  for (const Target& target : targets) {
    if (target.mesh.lower_bound(target.pose.to_local(middle), reach) > 0) continue;
    std::vector<Vector> local;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      local.push_back(target.pose.to_local(vertices[i]));
      if (target.mesh.lower_bound(local[i], 0) >= 0) continue;
      depths[i] = std::max(depths[i], target.mesh.depth(local[i], 0));
    }
    for (std::size_t t = 0; t < crossing.size(); ++t) {
      const Triangle triangle{local[corners[3 * t]], local[corners[3 * t + 1]],
                              local[corners[3 * t + 2]]};
      crossing[t] = crossing[t] || target.crossings.crossed_by(triangle);
    }
  }
  draping.triangles += static_cast<long long>(crossing.size());
  draping.crossing += std::count(crossing.begin(), crossing.end(), true);
  for (const double depth : depths) {
    draping.deepest = std::max(draping.deepest, depth);
    draping.inside += depth > kVertexMayBeInside;
  }
}

}  // namespace falling_objects
