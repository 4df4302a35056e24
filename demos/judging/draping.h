// SPDX-License-Identifier: BSD-3-Clause
// How the sheets lie on the meshes themselves (not on their skins), measured by the oracle.
#pragma once

#include <memory>
#include <vector>

#include "cloth/sheet.h"
#include "geometry/mesh_oracle.h"
#include "judging/crossings.h"
#include "simulation/scene.h"

namespace falling_objects {

inline constexpr double kVertexMayBeInside = 0.01;   // [m]
inline constexpr double kTrianglesMayCross = 0.001;  // share of all
inline constexpr double kVertexMayMove = 0.05;       // [m/s]

struct Draping {
  double deepest = 0;       // vertex of a sheet inside an object or the ground [m]
  long long inside = 0;     // vertices deeper than they may be
  long long crossing = 0;   // triangles of sheets that cross an object or the ground
  long long triangles = 0;  // of all sheets
  double crossing_share() const {
    return triangles > 0 ? static_cast<double>(crossing) / static_cast<double>(triangles) : 0;
  }
};

class DrapingMeter {
 public:
  DrapingMeter(const Scene& scene, const std::vector<std::unique_ptr<Sheet>>& sheets);

  // At the current poses. Meshes that are not closed have no inside and are passed over.
  Draping measure() const;

 private:
  struct Target {
    const ode_ext::oracle::Mesh& mesh;
    const CrossingFinder& crossings;
    ode_ext::oracle::Pose pose;
  };
  std::vector<Target> targets() const;
  void measure(const Cloth& cloth, const std::vector<Target>& targets, Draping& draping) const;

  const Scene& scene_;
  const std::vector<std::unique_ptr<Sheet>>& sheets_;
  std::vector<ode_ext::oracle::Mesh> meshes_;  // of the shapes, and of the ground
  std::vector<CrossingFinder> crossings_;
};

}  // namespace falling_objects
