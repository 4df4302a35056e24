// SPDX-License-Identifier: BSD-3-Clause
// A square sheet of cloth: positions solved against distances and contact planes in substeps
// (Mueller et al. 2007, position based dynamics; Macklin et al. 2019, "small steps"). It knows
// nothing of ODE: whoever collides it hands it planes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/vector.h"
#include "meshes/triangle_mesh.h"
#include "scene_file/gravity.h"

namespace falling_objects {

using ode_ext::oracle::Vector;

// A plane that a vertex must not go below. The plane moves with `velocity`, and `offset` is where
// it is at the end of the step.
struct ClothContact {
  std::uint32_t vertex = 0;
  Vector normal;      // unit, along which it leaves
  double offset = 0;  // [m] dot(normal, x) of a vertex on the plane
  Vector velocity;    // of what is behind the plane [m/s]
  double friction = 0;
  bool wakes = false;     // what is behind the plane moves
  Vector place;           // where it touches [m]; with the next two for whoever made the plane
  std::size_t owner = 0;  // what is behind the plane
  Vector impulse;         // [N s] that the step gave to what is behind the plane
};

class Cloth {
 public:
  // quads x quads squares of two triangles each, `size` [m] long, level around the origin.
  Cloth(unsigned quads, double size, Vector gravity = {0, 0, -kGravity});

  unsigned side() const { return quads_ + 1; }  // vertices along a side
  double spacing() const { return spacing_; }   // [m] between neighbours
  double vertex_mass() const { return vertex_mass_; }
  std::size_t middle() const { return (quads_ / 2) * (side() + 1); }
  const std::vector<unsigned>& triangles() const { return triangles_; }

  const std::vector<Vector>& positions() const { return positions_; }
  const std::vector<Vector>& velocities() const { return velocities_; }
  // For placing.
  std::vector<Vector>& positions() { return positions_; }
  // A vertex that stays where it is.
  void pin(std::size_t vertex) { pinned_.push_back(vertex); }

  // Where a vertex gets to in `dt` if nothing holds it.
  Vector free_flight(std::size_t vertex, double dt) const;
  void step(double dt, std::span<ClothContact> contacts);

  // Vertex of the last step, by the way it made [m/s].
  double fastest(double dt) const;
  double mean_speed() const { return mean_speed_; }  // of the last step [m/s]

 private:
  void solve_distances();
  void solve_links(unsigned columns, unsigned rows, int across, int along, double stiffness);
  void solve_contact(ClothContact& contact, double level, double h);
  void hold_pins();
  void wake();
  void settle(double dt);

  unsigned quads_;
  double spacing_;
  double vertex_mass_;
  Vector gravity_;     // [m/s^2]
  double rest_speed_;  // [m/s] a vertex that is slower rests
  std::vector<unsigned> triangles_;
  std::vector<Vector> positions_, velocities_;
  std::vector<Vector> start_;     // positions when the step began
  std::vector<Vector> previous_;  // ... when the substep began
  // Of a contact what it takes to see that nothing is to be done, which is what it mostly takes.
  struct Plane {
    Vector normal;
    double offset;
    double speed;  // along the normal [m/s]
    double start;  // height of the vertex above it as the step begins if that is negative, else 0
    std::uint32_t vertex;
  };
  std::vector<Plane> planes_;
  std::vector<Vector> last_ways_;  // that each vertex would have made in the last step
  double mean_speed_ = 0;          // [m/s]
  double calm_time_ = 0;           // [s] for which the sheet has been at rest as a whole
  std::size_t calm_contacts_ = 0;  // the most that it had while it was
  std::vector<double> eagerness_;  // what share of its way each makes, 0 to 1
  std::vector<std::size_t> pinned_;
};

}  // namespace falling_objects
