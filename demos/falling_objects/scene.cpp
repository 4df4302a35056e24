// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/scene.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "falling_objects/inflate.h"
#include "falling_objects/placement.h"
#include "falling_objects/sheet.h"

namespace falling_objects {
namespace {

// The quickest broad phase for a pile, measured: 0.4 ms where the quadtree takes 0.7, a hash space
// 1.2 and a simple space 2.8 (11,222 pairs). It sorts along its first axis, and a pile is wide and
// flat: sorted along z it takes 1.4 ms.
constexpr int kAxes = dSAP_AXES_XYZ;

constexpr double kDensity = 500;  // [kg/m^3], as wood: 30 to 60 kg each

dTriMeshDataID make_data(const TriangleMesh& mesh) {
  static_assert(sizeof(dTriIndex) == sizeof(unsigned));
  dTriMeshDataID data = dGeomTriMeshDataCreate();
  dGeomTriMeshDataBuildSingle(data, mesh.vertices.data(), 3 * sizeof(float),
                              static_cast<int>(mesh.vertex_count()), mesh.indices.data(),
                              static_cast<int>(mesh.indices.size()), 3 * sizeof(unsigned));
  return data;
}

// The mesh is centred on its centre of mass but for rounding; ODE insists on exactly.
dMass mass_of(const Shape& shape) {
  dMass mass;
  if (shape.closed) {
    dGeomID geom = dCreateTriMesh(nullptr, shape.data, nullptr, nullptr, nullptr);
    dMassSetTrimesh(&mass, kDensity, geom);
    dGeomDestroy(geom);
    dMassTranslate(&mass, -mass.c[0], -mass.c[1], -mass.c[2]);
  } else {
    dMassSetSphere(&mass, kDensity, kShapeRadius);
  }
  mass.c[0] = mass.c[1] = mass.c[2] = 0;
  return mass;
}

void set_up_world(dWorldID world) {
  dWorldSetGravity(world, 0, 0, -kGravity);
  dWorldSetAutoDisableFlag(world, 0);  // a pile that sleeps would be nothing to collide
  dWorldSetERP(world, 0.2);
  dWorldSetCFM(world, 1e-5);
  dWorldSetQuickStepNumIterations(world, 20);
  dWorldSetContactSurfaceLayer(world, 0.005);
  dWorldSetContactMaxCorrectingVel(world, 1.0);
  dWorldSetLinearDamping(world, 0.01);
  dWorldSetAngularDamping(world, 0.02);
}

// Sheets come to rest on what is at rest only, and a body in a pile is never quite. One that sleeps
// still collides, and wakes, with all that touch it, when it is pushed.
void let_bodies_sleep(dWorldID world) {
  dWorldSetAutoDisableFlag(world, 1);
  dWorldSetAutoDisableLinearThreshold(world, 0.05);   // [m/s]
  dWorldSetAutoDisableAngularThreshold(world, 0.15);  // [rad/s]
  dWorldSetAutoDisableAverageSamplesCount(world, 10);
  dWorldSetAutoDisableSteps(world, 20);
}

}  // namespace

void set_index(dGeomID geom, std::size_t index) {
  dGeomSetData(geom, reinterpret_cast<void*>(static_cast<std::uintptr_t>(index)));
}

std::size_t index_of(dGeomID geom) {
  return static_cast<std::size_t>(reinterpret_cast<std::uintptr_t>(dGeomGetData(geom)));
}

Scene::Scene(std::vector<NamedMesh> meshes, const Options& options,
             std::vector<std::string>& warnings)
    : skins_(options.has_sheets()),
      ground_(ground_half_size(static_cast<std::size_t>(options.objects)), options.seed),
      world_(dWorldCreate()),
      space_(dSweepAndPruneSpaceCreate(nullptr, kAxes)),
      ground_data_(make_data(ground_.mesh())) {
  set_up_world(world_);
  dRandSetSeed(static_cast<unsigned long>(options.seed));  // QuickStep shuffles its rows
  if (skins_) {
    ground_skin_ = inflate(ground_.mesh(), kSheetMargin);
    ground_skin_data_ = make_data(ground_skin_);
    let_bodies_sleep(world_);
  }
  add_geom(ground_data_, ground_skin_data_, nullptr, static_cast<std::size_t>(options.objects));
  add_shapes(std::move(meshes), warnings);
  add_objects(options);
}

void Scene::add_shapes(std::vector<NamedMesh> meshes, std::vector<std::string>& warnings) {
  // ODE keeps pointers to the vertices: no shape may move once its data is built.
  shapes_.reserve(meshes.size());
  for (NamedMesh& named : meshes) {
    const bool closed = is_closed(named.mesh);
    Shape& shape = shapes_.emplace_back(
        Shape{std::move(named.name), std::move(named.mesh), closed, nullptr, {}, {}, nullptr});
    shape.data = make_data(shape.mesh);
    if (skins_) {
      shape.skin = inflate(shape.mesh, kSheetMargin);
      shape.skin_data = make_data(shape.skin);
    }
    shape.mass = mass_of(shape);
    if (!closed) {
      warnings.push_back("the mesh '" + shape.name +
                         "' is open: it gets the mass and inertia of a ball, and how deep it gets "
                         "into others cannot be measured");
    }
  }
}

void Scene::add_objects(const Options& options) {
  Random random(options.seed);
  for (const Placement& placement :
       place_objects(static_cast<std::size_t>(options.objects), shapes_.size(), ground_, random)) {
    add_object(placement);
  }
}

void Scene::add_object(const Placement& placement) {
  const Shape& shape = shapes_[placement.shape];
  Object object{placement.shape, dBodyCreate(world_), nullptr};
  dBodySetMass(object.body, &shape.mass);
  object.geom = add_geom(shape.data, shape.skin_data, object.body, objects_.size());
  const auto& [x, y, z] = placement.position;
  dBodySetPosition(object.body, x, y, z);
  const dQuaternion q{placement.rotation[0], placement.rotation[1], placement.rotation[2],
                      placement.rotation[3]};
  dBodySetQuaternion(object.body, q);
  objects_.push_back(object);
}

void Scene::drop(std::size_t count) {
  const std::size_t first = objects_.size();
  std::vector<Object> models;
  for (const Object& object : objects_) {
    if (dBodyIsKinematic(object.body) == 0) models.push_back(object);
  }
  if (models.empty()) return;
  Point middle{};
  double top = -std::numeric_limits<double>::infinity(), radius = 0;
  for (const Object& model : models) {
    const dReal* p = dBodyGetPosition(model.body);
    for (int k = 0; k < 2; ++k) middle[k] += p[k] / static_cast<double>(models.size());
    radius = std::max(radius, bounding_radius(shapes_[model.shape].mesh));
    top = std::max(top, static_cast<double>(p[2]));
  }
  Random random(first);
  for (std::size_t i = 0; i < count; ++i) {
    const Object& model = models[random.below(models.size())];
    const dReal* q = dBodyGetQuaternion(model.body);
    const auto aside = [&] { return random.between(-radius, radius); };
    top += 2.1 * radius;
    add_object(
        {{middle[0] + aside(), middle[1] + aside(), top}, {q[0], q[1], q[2], q[3]}, model.shape});
  }
  // The ground's index is the number of objects.
  for (int i = 0; i < dSpaceGetNumGeoms(space_); ++i) {
    dGeomID geom = dSpaceGetGeom(space_, i);
    if (dGeomGetBody(geom) == nullptr && index_of(geom) == first) set_index(geom, objects_.size());
  }
}

bool Scene::touches_sheet(const dContactGeom& contact) const {
  return std::max(index_of(contact.g1), index_of(contact.g2)) > objects_.size();
}

// The mesh, and its skin if it has one. Returns the mesh's.
dGeomID Scene::add_geom(dTriMeshDataID data, dTriMeshDataID skin_data, dBodyID body,
                        std::size_t index) {
  const auto add = [&](dTriMeshDataID of, unsigned long category, unsigned long collide) {
    dGeomID geom = dCreateTriMesh(space_, of, nullptr, nullptr, nullptr);
    set_index(geom, index);
    dGeomSetCategoryBits(geom, category);
    dGeomSetCollideBits(geom, collide);
    if (body != nullptr) dGeomSetBody(geom, body);
    return geom;
  };
  if (skin_data != nullptr) add(skin_data, kSkinBit, kSheetBit);
  return add(data, kMeshBit, kMeshBit);
}

Scene::~Scene() {
  dSpaceDestroy(space_);
  dWorldDestroy(world_);
  for (const Shape& shape : shapes_) {
    dGeomTriMeshDataDestroy(shape.data);
    if (shape.skin_data != nullptr) dGeomTriMeshDataDestroy(shape.skin_data);
  }
  dGeomTriMeshDataDestroy(ground_data_);
  if (ground_skin_data_ != nullptr) dGeomTriMeshDataDestroy(ground_skin_data_);
}

}  // namespace falling_objects
