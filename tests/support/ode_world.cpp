// SPDX-License-Identifier: BSD-3-Clause
#include "support/ode_world.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace ode_ext::test {

const char* name_of(SpaceKind kind) {
  switch (kind) {
    case SpaceKind::Simple:
      return "Simple";
    case SpaceKind::Hash:
      return "Hash";
    case SpaceKind::SweepAndPrune:
      return "SweepAndPrune";
    case SpaceKind::QuadTree:
      return "QuadTree";
  }
  return "";
}

OdeMesh::OdeMesh(TestMesh mesh) : id_(dGeomTriMeshDataCreate()) { rebuild(std::move(mesh)); }

OdeMesh::~OdeMesh() { dGeomTriMeshDataDestroy(id_); }

void OdeMesh::rebuild(TestMesh mesh) {
  mesh_ = std::move(mesh);
  static_assert(sizeof(unsigned) == sizeof(dTriIndex));
  dGeomTriMeshDataBuildSingle(id_, mesh_.vertices.data(), 3 * sizeof(float), mesh_.vertex_count(),
                              mesh_.indices.data(), static_cast<int>(mesh_.indices.size()),
                              3 * sizeof(dTriIndex));
}

namespace {

// What ODE frees is what it is given next, if that is as large: the same address for certain.
struct Reuse {
  static void* allocate(std::size_t size) {
    return kept != nullptr && size == kept_size ? std::exchange(kept, nullptr) : std::malloc(size);
  }
  static void release(void* block, std::size_t size) {
    std::free(kept);
    kept = block;
    kept_size = size;
  }
  Reuse() {
    dSetAllocHandler(&allocate);
    dSetFreeHandler(&release);
  }
  ~Reuse() {
    dSetAllocHandler(nullptr);
    dSetFreeHandler(nullptr);
    std::free(std::exchange(kept, nullptr));
  }
  static inline void* kept = nullptr;
  static inline std::size_t kept_size = 0;
};

}  // namespace

bool OdeMesh::replace_at_same_address(TestMesh mesh) {
  const dTriMeshDataID address = id_;
  {
    const Reuse reuse;
    dGeomTriMeshDataDestroy(id_);
    id_ = dGeomTriMeshDataCreate();
  }
  rebuild(std::move(mesh));
  return id_ == address;
}

OdeWorld::OdeWorld() { dInitODE2(0); }

OdeWorld::~OdeWorld() {
  clear();
  dCloseODE();
}

void OdeWorld::clear() {
  for (const dGeomID geom : geoms_) dGeomDestroy(geom);
  // Inner spaces were created after outer ones.
  std::for_each(spaces_.rbegin(), spaces_.rend(), dSpaceDestroy);
  geoms_.clear();
  spaces_.clear();
  meshes_.clear();
}

void OdeWorld::restart() {
  clear();
  dCloseODE();
  dInitODE2(0);
}

OdeMesh& OdeWorld::mesh(TestMesh mesh) {
  meshes_.push_back(std::make_unique<OdeMesh>(std::move(mesh)));
  return *meshes_.back();
}

dSpaceID OdeWorld::space(SpaceKind kind, dSpaceID parent) {
  const dVector3 centre = {0, 0, 0}, extents = {16, 16, 16};
  switch (kind) {
    case SpaceKind::Simple:
      spaces_.push_back(dSimpleSpaceCreate(parent));
      break;
    case SpaceKind::Hash:
      spaces_.push_back(dHashSpaceCreate(parent));
      break;
    case SpaceKind::SweepAndPrune:
      spaces_.push_back(dSweepAndPruneSpaceCreate(parent, dSAP_AXES_XYZ));
      break;
    case SpaceKind::QuadTree:
      spaces_.push_back(dQuadTreeSpaceCreate(parent, centre, extents, 4));
      break;
  }
  dSpaceSetCleanup(spaces_.back(), 0);
  return spaces_.back();
}

dGeomID OdeWorld::geom(const OdeMesh& mesh, const TestPose& pose, dSpaceID space) {
  const dGeomID geom = own(dCreateTriMesh(space, mesh.id(), nullptr, nullptr, nullptr));
  set_pose(geom, pose);
  return geom;
}

dGeomID OdeWorld::own(dGeomID geom) {
  geoms_.push_back(geom);
  return geom;
}

void OdeWorld::destroy(dGeomID geom) {
  std::erase(geoms_, geom);
  dGeomDestroy(geom);
}

void OdeWorld::destroy(OdeMesh& mesh) {
  std::erase_if(meshes_, [&](const auto& owned) { return owned.get() == &mesh; });
}

void set_pose(dGeomID geom, const TestPose& pose) {
  dMatrix3 rotation{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) rotation[4 * i + j] = pose.rotation[3 * i + j];
  }
  dGeomSetPosition(geom, pose.position[0], pose.position[1], pose.position[2]);
  dGeomSetRotation(geom, rotation);
}

void set_mesh(dGeomID geom, dTriMeshDataID mesh) {
  const dSpaceID space = dGeomGetSpace(geom);
  if (space != nullptr) dSpaceRemove(space, geom);
  dGeomTriMeshSetData(geom, mesh);
  if (space != nullptr) dSpaceAdd(space, geom);
  dReal box[6];
  dGeomGetAABB(geom, box);
}

TestPose pose_of(dGeomID geom) {
  TestPose pose;
  const dReal* position = dGeomGetPosition(geom);
  const dReal* rotation = dGeomGetRotation(geom);
  for (std::size_t i = 0; i < 3; ++i) {
    pose.position[i] = position[i];
    for (std::size_t j = 0; j < 3; ++j) pose.rotation[3 * i + j] = rotation[4 * i + j];
  }
  return pose;
}

bool is_mesh(dGeomID geom) { return dGeomGetClass(geom) == dTriMeshClass; }

Pile::Pile(OdeWorld& world, dSpaceID space, int count, std::uint64_t seed, const Point& where)
    : origin(where) {
  const OdeMesh* kinds[] = {&world.mesh(make_torus(0.6, 0.25, 12, 8)),
                            &world.mesh(make_icosphere(0.6, 2)), &world.mesh(make_l(1.2)),
                            &world.mesh(make_cube(0.9, 3))};
  for (int i = 0; i < count; ++i) geoms.push_back(world.geom(*kinds[i % 4], {}, space));
  shake(seed);
}

void Pile::shake(std::uint64_t seed) {
  Random random(seed);
  for (const dGeomID geom : geoms) {
    TestPose pose = random.pose(1);
    // Multiples of 2^-10, so that adding a large origin to them rounds nothing.
    for (double& c : pose.position) c = std::round(c * 1024) / 1024;
    pose.position = pose.position + origin;
    set_pose(geom, pose);
  }
}

}  // namespace ode_ext::test
