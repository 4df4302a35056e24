// SPDX-License-Identifier: BSD-3-Clause
// A world in which a trial runs, with the contacts of one of three colliders. Everything but the
// contacts is the same for all three: bodies, masses, poses, surfaces, solver.
#pragma once

#include <ode/ode.h>
#include <ode_ext/ode_ext.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "bench/stability/shape.h"
#include "reference/reference_collider.h"
#include "support/ode_world.h"

namespace ode_ext::stability {

enum class Collider {
  kExt,    // meshes, collided by ode_ext
  kStock,  // the same meshes, collided by ODE's own collider
  kBoxes   // ODE's box geoms in their place: the yardstick
};
inline constexpr Collider kMeshColliders[] = {Collider::kExt, Collider::kStock};
inline constexpr Collider kColliders[] = {Collider::kExt, Collider::kStock, Collider::kBoxes};
const char* name_of(Collider collider);

// What is not named here is ODE's default: ERP 0.2, CFM 1e-10, no surface layer, no limit on the
// correcting velocity, no damping, no sleeping.
struct Conditions {
  Collider collider = Collider::kExt;
  double hz = 240;
  double mu = 0.8;  // of dContactApprox1, without which ODE's mu is a force
  double gravity = 9.81;
  int iterations = 40;  // of dWorldQuickStep
  int max_contacts = 16;
  std::uint64_t seed = 1;  // of the order in which QuickStep takes its rows
};

// From now on kExt is collided by the reference contacts (tests/reference) in ode_ext's place.
void use_reference(const ContactOptions& options);

class Bench {
 public:
  // Throws std::runtime_error where there is no device.
  explicit Bench(const Conditions& conditions);
  ~Bench();
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  // Trials that share a world each have a cell: bodies of different cells never touch. ODE refers
  // to the mesh of a shape, which has to outlive the bench.
  dBodyID add_body(const Shape& shape, const TestPose& pose, std::size_t cell);
  void add_fixed(const Shape& shape, const TestPose& pose, std::size_t cell);
  void add_plane();  // z = 0, solid below, in every cell

  // Gives all contacts of a cell this first friction direction (dContactFDir1).
  void set_friction_direction(std::size_t cell, const Point& direction);
  // The cell's bodies stop where they are and touch nothing any more.
  void retire(std::size_t cell);

  void step();
  double time() const { return steps_ / conditions_.hz; }  // [s]
  // Contacts of a cell in the last step.
  int contacts(std::size_t cell) const { return cells_[cell].contacts; }

 private:
  struct Session {
    Session() { dInitODE2(0); }
    ~Session() { dCloseODE(); }
  };
  struct Cell {
    std::vector<dGeomID> geoms;
    std::optional<Point> friction_direction;
    int contacts = 0;
  };
  static constexpr std::size_t kEveryCell = static_cast<std::size_t>(-1);

  Cell& cell_at(std::size_t cell);
  dGeomID add_geom(const Shape& shape, std::size_t cell);
  dTriMeshDataID data_of(const Shape& shape);
  static void near(void* bench, dGeomID g1, dGeomID g2);
  void collide(dGeomID g1, dGeomID g2);

  Conditions conditions_;
  Session session_;
  std::vector<std::pair<const Shape*, dTriMeshDataID>> meshes_;
  dBatchColliderID batch_ = nullptr;
  std::optional<ReferenceCollider> reference_;
  dWorldID world_;
  dSpaceID space_;
  dJointGroupID joints_;
  std::vector<dContactGeom> buffer_;
  std::vector<Cell> cells_;
  int steps_ = 0;
};

// Of a body.
Point position(dBodyID body);
Point velocity(dBodyID body);          // [m/s]
Point angular_velocity(dBodyID body);  // [rad/s]
TestPose pose(dBodyID body);
double kinetic_energy(dBodyID body);  // [J], of rotation too

}  // namespace ode_ext::stability
