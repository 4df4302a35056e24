// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/world.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "support/ode_world.h"

// dGeomTransform is, and is still in use.
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"

namespace ode_ext::fuzz {
namespace {

using namespace test;

// [m] Far more than a scene has, far less than the cells of ODE's hash space can count.
constexpr double kLimit = 1e3;

int keep_first(dGeomID, int first, int) { return first; }
int refuse_odd(dGeomID, dGeomID, int triangle) { return triangle % 2 == 0; }

template <class T>
T* chosen(ByteSource& bytes, const std::vector<std::unique_ptr<T>>& from) {
  if (from.empty()) return nullptr;
  return from[static_cast<std::size_t>(bytes.below(static_cast<int>(from.size())))].get();
}

template <class T>
void erase(std::vector<std::unique_ptr<T>>& from, const T& what) {
  std::erase_if(from, [&](const auto& owned) { return owned.get() == &what; });
}

bool within(const TestMesh& mesh, double limit) {
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                     [&](float x) { return std::fabs(x) <= limit; });
}

}  // namespace

const FclSurface* Mesh::tame_surface() {
  if (!tame(decoded.mesh)) return nullptr;
  if (!surface) surface.emplace(decoded.mesh);
  return &*surface;
}

TestPose Geom::pose() const {
  return inner == nullptr ? pose_of(id) : composed(pose_of(id), pose_of(inner));
}

Sides Geom::sides() const {
  return {inner == nullptr ? id : nullptr, merges ? 0 : mesh->triangles()};
}

World::World() {
  spaces_.push_back(std::make_unique<Space>(Space{dSimpleSpaceCreate(nullptr), true}));
  dSpaceSetCleanup(spaces_.back()->id, 0);
}

World::~World() {
  while (!geoms_.empty()) destroy(*geoms_.back());
  while (!spaces_.empty()) {  // inner ones were made after outer ones
    dSpaceDestroy(spaces_.back()->id);
    spaces_.pop_back();
  }
  while (!meshes_.empty()) destroy(*meshes_.back());
}

// ODE is given what it can take: where a geom is in a space that overflows, no wild mesh.
bool World::only_tame(const Mesh& mesh) const {
  return std::any_of(geoms_.begin(), geoms_.end(), [&](const auto& geom) {
    return geom->mesh == &mesh && geom->space != nullptr && !geom->space->simple;
  });
}

void World::build(Mesh& mesh) {
  const TestMesh& m = mesh.decoded.mesh;
  mesh.surface.reset();
  mesh.doubles.assign(m.vertices.begin(), m.vertices.end());
  const int indices = static_cast<int>(m.indices.size());
  if (mesh.in_doubles) {
    dGeomTriMeshDataBuildDouble(mesh.id, mesh.doubles.data(), 3 * sizeof(double), m.vertex_count(),
                                m.indices.data(), indices, 3 * sizeof(dTriIndex));
  } else {
    dGeomTriMeshDataBuildSingle(mesh.id, m.vertices.data(), 3 * sizeof(float), m.vertex_count(),
                                m.indices.data(), indices, 3 * sizeof(dTriIndex));
  }
}

Mesh* World::make_mesh(ByteSource& bytes) {
  if (meshes_.size() >= kMeshes) return nullptr;
  meshes_.push_back(std::make_unique<Mesh>());
  Mesh& mesh = *meshes_.back();
  mesh.in_doubles = bytes.coin();
  mesh.decoded = decode_mesh(bytes);
  mesh.id = dGeomTriMeshDataCreate();
  build(mesh);
  return &mesh;
}

Space* World::make_space(ByteSource& bytes) {
  if (spaces_.size() >= kSpaces) return nullptr;
  const int kind = bytes.below(4), place = bytes.below(static_cast<int>(spaces_.size()) + 1);
  const Space* parent = place == 0 ? nullptr : spaces_[static_cast<std::size_t>(place) - 1].get();
  const dSpaceID in = parent == nullptr ? nullptr : parent->id;
  auto space = std::make_unique<Space>();
  space->simple = kind == 0 && (parent == nullptr || parent->simple);
  const dVector3 centre = {0, 0, 0}, extents = {4, 4, 4};
  switch (kind) {
    case 0:
      space->id = dSimpleSpaceCreate(in);
      break;
    case 1:
      space->id = dHashSpaceCreate(in);
      break;
    case 2:
      space->id = dSweepAndPruneSpaceCreate(in, bytes.coin() ? dSAP_AXES_XYZ : dSAP_AXES_ZXY);
      break;
    default:
      space->id = dQuadTreeSpaceCreate(in, centre, extents, bytes.between(1, 4));
  }
  dSpaceSetCleanup(space->id, 0);
  spaces_.push_back(std::move(space));
  return spaces_.back().get();
}

Geom* World::make_geom(ByteSource& bytes) {
  Mesh* mesh = choose_mesh(bytes);
  if (mesh == nullptr || geoms_.size() >= kGeoms) return nullptr;
  const int place = bytes.below(static_cast<int>(spaces_.size()) + 1);
  Space* space = place == 0 ? nullptr : spaces_[static_cast<std::size_t>(place) - 1].get();
  if (space != nullptr && !space->simple && !within(mesh->decoded.mesh, kLimit)) space = nullptr;
  auto geom = std::make_unique<Geom>();
  geom->mesh = mesh;
  const int kind = bytes.byte();
  const dGeomID id = dCreateTriMesh(nullptr, mesh->id, nullptr, nullptr, nullptr);
  geom->id = id;
  if ((kind & 7) == 1) {
    geom->merges = true;
    dGeomTriMeshSetTriMergeCallback(id, &keep_first);
  }
  if ((kind & 7) == 2) {
    geom->refuses = true;
    dGeomTriMeshSetCallback(id, &refuse_odd);
  }
  if ((kind & 7) == 3) {
    test::set_pose(id, decode_pose(bytes, false));
    geom->inner = id;
    geom->id = dCreateGeomTransform(nullptr);
    dGeomTransformSetCleanup(geom->id, 1);
    dGeomTransformSetGeom(geom->id, id);
  }
  geoms_.push_back(std::move(geom));
  Geom& made = *geoms_.back();
  pose(made, bytes);
  if (space != nullptr) move_to(made, *space);
  return &made;
}

Mesh* World::choose_mesh(ByteSource& bytes) { return chosen(bytes, meshes_); }
Space* World::choose_space(ByteSource& bytes) { return chosen(bytes, spaces_); }
Geom* World::choose_geom(ByteSource& bytes) { return chosen(bytes, geoms_); }

void World::set_pose(Geom& geom, const TestPose& pose) { test::set_pose(geom.id, pose); }

void World::pose(Geom& geom, ByteSource& bytes) {
  const bool simple = geom.space == nullptr || geom.space->simple;
  set_pose(geom, decode_pose(bytes, bytes.below(8) == 7 && simple && geom.inner == nullptr));
}

void World::shake(ByteSource& bytes) {
  for (const auto& geom : geoms_) {
    TestPose pose = pose_of(geom->id);
    for (double& x : pose.position) x += bytes.lattice() / 256;
    set_pose(*geom, pose);
  }
}

void World::move_to(Geom& geom, Space& space) {
  if (!space.simple && (!within(geom.mesh->decoded.mesh, kLimit) || !tame(pose_of(geom.id))))
    return;
  if (geom.space != nullptr) dSpaceRemove(geom.space->id, geom.id);
  dSpaceAdd(space.id, geom.id);
  // A geom whose box is known hides those before which it is put and whose boxes are not: the next
  // collision in that space would end in an assertion of ODE's (docs/reliability.md).
  test::set_pose(geom.id, pose_of(geom.id));
  geom.space = &space;
}

void World::give(Geom& geom, Mesh& mesh) {
  const bool simple = geom.space == nullptr || geom.space->simple;
  if (geom.inner != nullptr || (!simple && !within(mesh.decoded.mesh, kLimit))) return;
  test::set_mesh(geom.id, mesh.id);
  geom.mesh = &mesh;
}

void World::edit(Mesh& mesh, ByteSource& bytes) {
  // The arrays stay where they are: ODE refers to them.
  DecodedMesh changed = mesh.decoded;
  spoil(bytes, changed);
  if (only_tame(mesh)) tame_down(changed.mesh, kLimit);
  std::copy(changed.mesh.vertices.begin(), changed.mesh.vertices.end(),
            mesh.decoded.mesh.vertices.begin());
  std::copy(changed.mesh.vertices.begin(), changed.mesh.vertices.end(), mesh.doubles.begin());
  std::copy(changed.mesh.indices.begin(), changed.mesh.indices.end(),
            mesh.decoded.mesh.indices.begin());
  mesh.decoded.solid = changed.solid;
  mesh.surface.reset();
  if (mesh.triangles() > 1 && bytes.coin()) dGeomTriMeshDataUpdate(mesh.id);
}

void World::rebuild(Mesh& mesh, ByteSource& bytes) {
  mesh.decoded = decode_mesh(bytes);
  if (only_tame(mesh)) tame_down(mesh.decoded.mesh, kLimit), mesh.decoded.solid = false;
  build(mesh);
  for (const auto& geom : geoms_) {
    if (geom->mesh == &mesh) set_pose(*geom, pose_of(geom->id));  // ODE sizes its box anew
  }
}

void World::destroy(Geom& geom) {
  dGeomDestroy(geom.id);
  erase(geoms_, geom);
}

void World::destroy(Mesh& mesh) {
  for (std::size_t i = geoms_.size(); i-- > 0;) {
    if (geoms_[i]->mesh == &mesh) destroy(*geoms_[i]);
  }
  dGeomTriMeshDataDestroy(mesh.id);
  erase(meshes_, mesh);
}

Geom* World::find(dGeomID id) const {
  const auto found =
      std::find_if(geoms_.begin(), geoms_.end(), [&](const auto& geom) { return geom->id == id; });
  return found == geoms_.end() ? nullptr : found->get();
}

bool World::all_tame() const {
  return std::all_of(geoms_.begin(), geoms_.end(), [](const auto& geom) {
    return finite(geom->mesh->decoded.mesh) && tame(geom->pose());
  });
}

}  // namespace ode_ext::fuzz
