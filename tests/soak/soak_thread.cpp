// SPDX-License-Identifier: BSD-3-Clause
#include "soak/soak_thread.h"

#include <algorithm>
#include <utility>

#include "opencl/error.h"
#include "support/batch_collider.h"

namespace ode_ext::soak {
namespace {

using namespace test;

constexpr std::size_t kMeshes = 6;
// How often, in passes, something happens on average.
constexpr int kBody = 3, kEdit = 10, kMesh = 20, kSpace = 40, kFailure = 50, kCheck = 20,
              kCollider = 150;

TestMesh random_mesh(Random& random) {
  const double size = random.uniform(0.6, 1.2);
  switch (random.below(6)) {
    case 0:
      return make_torus(size / 2, size / 5, 6 + random.below(8), 4 + random.below(5));
    case 1:
      return make_icosphere(size / 2, random.below(3));
    case 2:
      return make_l(size);
    case 3:
      return make_cube(size, 1 + random.below(3));
    case 4:
      return make_comb(1 + random.below(4), size / 4, size / 2, size / 3);
    default:
      return make_sheet(size, 1 + random.below(6));
  }
}

}  // namespace

void Progress::report(const std::string& what) {
  const std::lock_guard lock(mutex_);
  if (flaw_.empty()) flaw_ = what;
  stop = true;
}

std::string Progress::flaw() const {
  const std::lock_guard lock(mutex_);
  return flaw_;
}

SoakThread::SoakThread(Progress& progress, std::uint64_t seed, std::size_t bodies)
    : progress_(progress),
      random_(seed),
      most_bodies_(bodies),
      threading_(dThreadingAllocateSelfThreadedImplementation()),
      world_(dWorldCreate()),
      joints_(dJointGroupCreate(0)) {
  // Else all worlds share one, and stepping two in two threads aborts.
  dWorldSetStepThreadingImplementation(world_, dThreadingImplementationGetFunctions(threading_),
                                       threading_);
  dWorldSetGravity(world_, 0, 0, -9.81);
  dWorldSetContactMaxCorrectingVel(world_, 1);
  floor_mesh_ = std::make_unique<OdeMesh>(make_box({8, 8, 1}, 4, 4, 1));
  floor_ = dCreateTriMesh(nullptr, floor_mesh_->id(), nullptr, nullptr, nullptr);
  dGeomSetPosition(floor_, 0, 0, -0.5);
  for (std::size_t i = 0; i < kMeshes; ++i) {
    meshes_.push_back({std::make_unique<OdeMesh>(random_mesh(random_))});
  }
  replace_space();
  while (bodies_.size() < most_bodies_ / 2) add_body();
}

SoakThread::~SoakThread() {
  while (!bodies_.empty()) remove_body(0);
  dGeomDestroy(floor_);
  if (space_ != nullptr) dSpaceDestroy(space_);
  for (const Mesh& mesh : meshes_) dBatchColliderTriMeshDataDestroyed(nullptr, mesh.ode->id());
  dBatchColliderDestroy(collider_);
  dJointGroupDestroy(joints_);
  dWorldDestroy(world_);
  dThreadingFreeImplementation(threading_);
}

void SoakThread::run(long long passes) {
  dAllocateODEDataForThread(dAllocateMaskAll);
  for (long long i = 0; i < passes && !progress_.stop; ++i) {
    change();
    pass();
    ++progress_.passes;
  }
  dCleanupODEAllDataForThread();
}

void SoakThread::put_at_random(dBodyID body) {
  const TestPose pose = random_.pose(1);
  dMatrix3 rotation{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) rotation[4 * i + j] = pose.rotation[3 * i + j];
  }
  dBodySetPosition(body, 2 * pose.position[0], 2 * pose.position[1], 2 + pose.position[2]);
  dBodySetRotation(body, rotation);
  dBodySetLinearVel(body, 0, 0, 0);
  dBodySetAngularVel(body, 0, 0, 0);
}

void SoakThread::add_body() {
  const auto mesh = static_cast<std::size_t>(random_.below(kMeshes));
  const Body body{dBodyCreate(world_),
                  dCreateTriMesh(space_, meshes_[mesh].ode->id(), nullptr, nullptr, nullptr), mesh};
  dMass mass;
  dMassSetSphereTotal(&mass, 1, 0.5);
  dBodySetMass(body.body, &mass);
  put_at_random(body.body);
  dGeomSetBody(body.geom, body.body);
  bodies_.push_back(body);
  ++progress_.bodies;
}

void SoakThread::remove_body(std::size_t index) {
  dGeomDestroy(bodies_[index].geom);
  dBodyDestroy(bodies_[index].body);
  bodies_.erase(bodies_.begin() + static_cast<std::ptrdiff_t>(index));
}

// A mark goes by the address, so the end of a marked mesh is announced; of others now and then.
void SoakThread::replace_mesh(std::size_t index) {
  for (std::size_t i = bodies_.size(); i-- > 0;) {
    if (bodies_[i].mesh == index) remove_body(i);
  }
  Mesh& mesh = meshes_[index];
  if (mesh.deformable || once_in(2)) dBatchColliderTriMeshDataDestroyed(nullptr, mesh.ode->id());
  mesh = {std::make_unique<OdeMesh>(random_mesh(random_)), once_in(4)};
  if (mesh.deformable) dBatchColliderTriMeshDataSetDeformable(collider_, mesh.ode->id(), 1);
  ++progress_.meshes;
}

// Inwards, so that ODE's box, which it never takes anew, holds it still.
void SoakThread::edit_mesh(std::size_t index) {
  OdeMesh& mesh = *meshes_[index].ode;
  TestMesh& edited = mesh.edit();
  const auto vertex = static_cast<std::size_t>(random_.below(edited.vertex_count()));
  for (std::size_t k = 0; k < 3; ++k) edited.vertices[3 * vertex + k] *= 0.98f;
  dGeomTriMeshDataUpdate(mesh.id());
  if (once_in(2)) dBatchColliderTriMeshDataUpdate(nullptr, mesh.id());
  ++progress_.edits;
}

void SoakThread::replace_space() {
  constexpr SpaceKind kKinds[] = {SpaceKind::Simple, SpaceKind::Hash, SpaceKind::SweepAndPrune,
                                  SpaceKind::QuadTree};
  const dSpaceID old = space_;
  const dVector3 centre = {0, 0, 0}, extents = {16, 16, 16};
  switch (kKinds[random_.below(4)]) {
    case SpaceKind::Simple:
      space_ = dSimpleSpaceCreate(nullptr);
      break;
    case SpaceKind::Hash:
      space_ = dHashSpaceCreate(nullptr);
      break;
    case SpaceKind::SweepAndPrune:
      space_ = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
      break;
    case SpaceKind::QuadTree:
      space_ = dQuadTreeSpaceCreate(nullptr, centre, extents, 4);
      break;
  }
  dSpaceSetCleanup(space_, 0);
  const auto move = [&](dGeomID geom) {
    if (old != nullptr) dSpaceRemove(old, geom);
    dSpaceAdd(space_, geom);
  };
  move(floor_);
  for (const Body& body : bodies_) move(body.geom);
  if (old != nullptr) dSpaceDestroy(old);
  ++progress_.spaces;
}

bool SoakThread::mark_deformables(dBatchColliderID collider) const {
  for (const Mesh& mesh : meshes_) {
    if (mesh.deformable) dBatchColliderTriMeshDataSetDeformable(collider, mesh.ode->id(), 1);
  }
  return collider != nullptr;
}

void SoakThread::settle() {
  if (collider_ == nullptr) replace_collider();
  Heard heard{this, -1};
  dBatchColliderSpaceCollide(collider_, space_, &heard, &near);
  dJointGroupEmpty(joints_);
}

// All of these give the same bytes. Null where another thread makes the device fail just now.
void SoakThread::replace_collider() {
  dBatchColliderParams params;
  dBatchColliderParamsInit(&params);
  std::string config;
  if (once_in(3)) config += "workload=exact,";
  if (once_in(3)) config += "initial_capacity=64,";
  if (once_in(3)) config += "prediction=plain,";
  params.config = config.c_str();
  dBatchColliderDestroy(collider_);
  collider_ = dBatchColliderCreate(&params);
  if (mark_deformables(collider_)) ++progress_.colliders;
}

void SoakThread::change() {
  if (collider_ == nullptr || once_in(kCollider)) replace_collider();
  if (once_in(kSpace)) replace_space();
  if (once_in(kMesh)) replace_mesh(static_cast<std::size_t>(random_.below(kMeshes)));
  if (once_in(kEdit)) edit_mesh(static_cast<std::size_t>(random_.below(kMeshes)));
  if (once_in(kBody) && !bodies_.empty())
    remove_body(static_cast<std::size_t>(random_.below(static_cast<int>(bodies_.size()))));
  while (bodies_.size() < most_bodies_ / 2) add_body();
  if (once_in(kBody) && bodies_.size() < most_bodies_) add_body();
  for (const Body& body : bodies_) {
    if (dBodyGetPosition(body.body)[2] < -4) put_at_random(body.body);
  }
}

void SoakThread::near(void* data, dGeomID a, dGeomID b) {
  auto& heard = *static_cast<Heard*>(data);
  SoakThread& self = *heard.thread;
  Contacts contacts = collide(a, b, 64);
  ++self.progress_.pairs;
  self.progress_.contacts += static_cast<long long>(contacts.size());
  for (std::size_t i = 0; i < std::min<std::size_t>(contacts.size(), 8); ++i) {
    dContact contact{};
    contact.surface.mu = 0.5;
    contact.geom = contacts[i];
    dJointAttach(dJointCreateContact(self.world_, self.joints_, &contact), dGeomGetBody(a),
                 dGeomGetBody(b));
  }
  if (heard.skip-- == 0) {
    heard.a = a;
    heard.b = b;
    heard.contacts = std::move(contacts);
  }
}

void SoakThread::pass() {
  if (collider_ == nullptr) return;
  Heard heard{this, once_in(kCheck) ? random_.below(30) : -1};
  const bool fail = once_in(kFailure);
  if (fail) fault_injector::arm(1 + random_.below(60), -5);  // CL_OUT_OF_RESOURCES, for instance
  const int result = dBatchColliderSpaceCollide(collider_, space_, &heard, &near);
  if (fail) fault_injector::disarm();
  if (result != 1)
    progress_.report(std::string("a pass was not delivered: ") +
                     dBatchColliderGetLastErrorMessage());
  const bool failed = (dBatchColliderGetStatus(collider_) & dBatchStatusDeviceFailed) != 0;
  if (failed) ++progress_.failures;
  if (heard.a != nullptr && !failed) check(heard);
  dWorldQuickStep(world_, 1.0 / 60);
  dJointGroupEmpty(joints_);
}

// Against a collider that has never seen anything else. Another thread may make its device fail,
// and then it says nothing.
void SoakThread::check(const Heard& heard) {
  dBatchColliderParams params;
  dBatchColliderParamsInit(&params);
  const dBatchColliderID fresh = dBatchColliderCreate(&params);
  if (!mark_deformables(fresh)) return;
  const dGeomID pair[] = {heard.a, heard.b};
  Contacts contacts(64);
  int count = 0;
  const int total =
      dBatchColliderCollidePairs(fresh, pair, 1, 64, contacts.data(), sizeof(dContactGeom), &count);
  const int status = dBatchColliderGetStatus(fresh);
  dBatchColliderDestroy(fresh);
  if (total < 0 || (status & dBatchStatusDeviceFailed) != 0) return;
  contacts.resize(static_cast<std::size_t>(count));
  ++progress_.checked;
  if (const auto difference = test::difference(heard.contacts, contacts); !difference.empty())
    progress_.report("a pass gave another answer than a fresh collider: " + difference);
}

}  // namespace ode_ext::soak
