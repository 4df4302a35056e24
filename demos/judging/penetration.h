// SPDX-License-Identifier: BSD-3-Clause
// How deep the objects are in each other and in the ground, measured on the meshes by an oracle
// that shares nothing with the collider: what a collider overlooks is seen here.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "geometry/mesh_oracle.h"
#include "judging/near_pairs.h"
#include "simulation/scene.h"

namespace falling_objects {

struct Penetration {
  std::size_t object;
  std::size_t other;  // the number of objects: the ground
  double depth;       // [m]
  double allowed;     // [m]: half the thinnest part of the two
};

class PenetrationMeter {
 public:
  explicit PenetrationMeter(const Scene& scene);

  struct Result {
    double deepest = 0;                 // of all pairs [m]
    std::vector<Penetration> too_deep;  // the pairs that are deeper than allowed
  };
  // Open meshes have no inside: measure() leaves them out.
  bool measures_all() const { return measures_all_; }
  bool measures_any() const { return measures_any_; }
  // At the current poses.
  Result measure() const;
  // The depth [m] of every pair of which one has a vertex inside the other. Slower: measure() need
  // not know most of them.
  std::vector<double> all_depths() const;

 private:
  // Calls visit(i, j, mesh j, pose j, allowed) for each pair that may touch.
  template <class Visit>
  void for_each_pair(const std::vector<ode_ext::oracle::Pose>& poses, Visit visit) const;
  std::vector<ode_ext::oracle::Pose> poses() const;
  std::vector<Ball> balls(const std::vector<ode_ext::oracle::Pose>& poses) const;

  const Scene& scene_;
  std::vector<ode_ext::oracle::Mesh> shapes_;
  std::vector<double> half_thinnest_;  // of the shapes [m]
  std::optional<ode_ext::oracle::Mesh> ground_;
  bool measures_all_ = true;
  bool measures_any_ = false;
};

}  // namespace falling_objects
