// SPDX-License-Identifier: BSD-3-Clause
#include "bench/stability/bench.h"

#include <stdexcept>

namespace ode_ext::stability {
namespace {

constexpr double kDensity = 500;  // [kg/m^3], as wood

dMass mass_of(const Shape& shape, dGeomID geom) {
  dMass mass;
  if (shape.box) {
    const Point& e = *shape.box;
    dMassSetBox(&mass, kDensity, e[0], e[1], e[2]);
    return mass;
  }
  // Shapes are centred on their centre of mass but for rounding; ODE insists on exactly.
  dMassSetTrimesh(&mass, kDensity, geom);
  dMassTranslate(&mass, -mass.c[0], -mass.c[1], -mass.c[2]);
  mass.c[0] = mass.c[1] = mass.c[2] = 0;
  return mass;
}

Point point(const dReal* v) { return {v[0], v[1], v[2]}; }

std::optional<ContactOptions> reference_options;

}  // namespace

const char* name_of(Collider collider) {
  switch (collider) {
    case Collider::kExt:
      return "ode_ext";
    case Collider::kStock:
      return "stock";
    case Collider::kBoxes:
      return "boxes";
  }
  return "";
}

void use_reference(const ContactOptions& options) { reference_options = options; }

Bench::Bench(const Conditions& conditions) : conditions_(conditions) {
  if (conditions_.collider == Collider::kExt && reference_options) {
    reference_options->max_contacts = static_cast<std::size_t>(conditions_.max_contacts);
    reference_.emplace(*reference_options);
  } else if (conditions_.collider == Collider::kExt) {
    // Only while it exists are mesh pairs not ODE's own business.
    dBatchColliderParams params;
    dBatchColliderParamsInit(&params);
    params.max_contacts = conditions_.max_contacts;
    batch_ = dBatchColliderCreate(&params);
    if (batch_ == nullptr) throw std::runtime_error(dBatchColliderGetLastErrorMessage());
  }
  world_ = dWorldCreate();
  space_ = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
  joints_ = dJointGroupCreate(0);
  buffer_.resize(static_cast<std::size_t>(conditions_.max_contacts));
  dWorldSetGravity(world_, 0, 0, -conditions_.gravity);
  dWorldSetQuickStepNumIterations(world_, conditions_.iterations);
  dRandSetSeed(static_cast<unsigned long>(conditions_.seed));
}

Bench::~Bench() {
  dJointGroupDestroy(joints_);
  dSpaceDestroy(space_);  // and its geoms
  dWorldDestroy(world_);
  for (const auto& [shape, data] : meshes_) dGeomTriMeshDataDestroy(data);
  dBatchColliderDestroy(batch_);
}

dBodyID Bench::add_body(const Shape& shape, const TestPose& pose, std::size_t cell) {
  const dGeomID geom = add_geom(shape, cell);
  const dMass mass = mass_of(shape, geom);
  const dBodyID body = dBodyCreate(world_);
  dBodySetMass(body, &mass);
  dGeomSetBody(geom, body);
  set_pose(geom, pose);  // moves the body
  return body;
}

void Bench::add_fixed(const Shape& shape, const TestPose& pose, std::size_t cell) {
  set_pose(add_geom(shape, cell), pose);
}

void Bench::add_plane() {
  dGeomSetData(dCreatePlane(space_, 0, 0, 1, 0), reinterpret_cast<void*>(kEveryCell));
}

Bench::Cell& Bench::cell_at(std::size_t cell) {
  if (cells_.size() <= cell) cells_.resize(cell + 1);
  return cells_[cell];
}

dGeomID Bench::add_geom(const Shape& shape, std::size_t cell) {
  dGeomID geom = nullptr;
  if (conditions_.collider != Collider::kBoxes) {
    geom = dCreateTriMesh(space_, data_of(shape), nullptr, nullptr, nullptr);
  } else {
    const Point& e = shape.box.value();
    geom = dCreateBox(space_, e[0], e[1], e[2]);
  }
  dGeomSetData(geom, reinterpret_cast<void*>(cell));
  cell_at(cell).geoms.push_back(geom);
  return geom;
}

dTriMeshDataID Bench::data_of(const Shape& shape) {
  for (const auto& [known, data] : meshes_) {
    if (known == &shape) return data;
  }
  const dTriMeshDataID data = dGeomTriMeshDataCreate();
  const TestMesh& mesh = shape.mesh;
  dGeomTriMeshDataBuildSingle(data, mesh.vertices.data(), 3 * sizeof(float), mesh.vertex_count(),
                              mesh.indices.data(), static_cast<int>(mesh.indices.size()),
                              3 * sizeof(dTriIndex));
  meshes_.emplace_back(&shape, data);
  return data;
}

void Bench::set_friction_direction(std::size_t cell, const Point& direction) {
  cell_at(cell).friction_direction = direction;
}

void Bench::retire(std::size_t cell) {
  for (const dGeomID geom : cells_[cell].geoms) {
    dGeomDisable(geom);
    if (const dBodyID body = dGeomGetBody(geom)) dBodyDisable(body);
  }
}

void Bench::step() {
  for (Cell& cell : cells_) cell.contacts = 0;
  // Without a collider this is dSpaceCollide.
  if (dBatchColliderSpaceCollide(batch_, space_, this, &near) != 1) {
    throw std::runtime_error(dBatchColliderGetLastErrorMessage());
  }
  dWorldQuickStep(world_, 1 / conditions_.hz);
  dJointGroupEmpty(joints_);
  ++steps_;
}

void Bench::near(void* bench, dGeomID g1, dGeomID g2) {
  static_cast<Bench*>(bench)->collide(g1, g2);
}

void Bench::collide(dGeomID g1, dGeomID g2) {
  const auto cell1 = reinterpret_cast<std::size_t>(dGeomGetData(g1));
  const auto cell2 = reinterpret_cast<std::size_t>(dGeomGetData(g2));
  const dBodyID body1 = dGeomGetBody(g1), body2 = dGeomGetBody(g2);
  if (body1 == nullptr && body2 == nullptr) return;
  if (cell1 != cell2 && cell1 != kEveryCell && cell2 != kEveryCell) return;
  Cell& cell = cells_[cell1 == kEveryCell ? cell2 : cell1];
  const int count =
      dCollide(g1, g2, conditions_.max_contacts, buffer_.data(), sizeof(dContactGeom));
  cell.contacts += count;
  for (int i = 0; i < count; ++i) {
    dContact contact{};
    contact.geom = buffer_[static_cast<std::size_t>(i)];
    contact.surface.mode = dContactApprox1;
    contact.surface.mu = conditions_.mu;
    if (cell.friction_direction) {
      contact.surface.mode |= dContactFDir1;
      for (std::size_t k = 0; k < 3; ++k) contact.fdir1[k] = (*cell.friction_direction)[k];
    }
    dJointAttach(dJointCreateContact(world_, joints_, &contact), body1, body2);
  }
}

Point position(dBodyID body) { return point(dBodyGetPosition(body)); }

Point velocity(dBodyID body) { return point(dBodyGetLinearVel(body)); }

Point angular_velocity(dBodyID body) { return point(dBodyGetAngularVel(body)); }

TestPose pose(dBodyID body) { return pose_of(dBodyGetFirstGeom(body)); }

double kinetic_energy(dBodyID body) {
  dMass mass;
  dBodyGetMass(body, &mass);
  const Point v = velocity(body);
  const Point w = rotate_back(pose(body), angular_velocity(body));  // the inertia is the body's
  double energy = 0.5 * mass.mass * dot(v, v);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) energy += 0.5 * w[i] * mass.I[4 * i + j] * w[j];
  }
  return energy;
}

}  // namespace ode_ext::stability
