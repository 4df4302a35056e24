// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/scene.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "cloth/sheet.h"
#include "meshes/inflate.h"
#include "simulation/placement.h"

namespace falling_objects {
namespace {

// The quickest broad phase for a pile, measured: 0.4 ms where the quadtree takes 0.7, a hash space
// 1.2 and a simple space 2.8 (11,222 pairs). It sorts along its first axis, and a pile is wide and
// flat: sorted along z it takes 1.4 ms.
constexpr int kAxes = dSAP_AXES_XYZ;

constexpr double kWater = 1000;  // [kg/m^3]

dTriMeshDataID make_data(const TriangleMesh& mesh) {
  static_assert(sizeof(dTriIndex) == sizeof(unsigned));
  dTriMeshDataID data = dGeomTriMeshDataCreate();
  dGeomTriMeshDataBuildSingle(data, mesh.vertices.data(), 3 * sizeof(float),
                              static_cast<int>(mesh.vertex_count()), mesh.indices.data(),
                              static_cast<int>(mesh.indices.size()), 3 * sizeof(unsigned));
  return data;
}

dMass mass_of_ball(double radius) {
  dMass mass;
  dMassSetSphere(&mass, kWater, radius);
  return mass;
}

// The mesh is centred on its centre of mass but for rounding; ODE insists on exactly, and aborts
// where a mass or its inertia is not positive: parts may be wound against one another.
std::optional<dMass> mass_of(const Shape& shape) {
  if (!shape.closed) return std::nullopt;
  dMass mass;
  dGeomID geom = dCreateTriMesh(nullptr, shape.data, nullptr, nullptr, nullptr);
  dMassSetTrimesh(&mass, kWater, geom);
  dGeomDestroy(geom);
  dMassTranslate(&mass, -mass.c[0], -mass.c[1], -mass.c[2]);
  mass.c[0] = mass.c[1] = mass.c[2] = 0;
  if (!(mass.mass > 0) || dMassCheck(&mass) == 0) return std::nullopt;
  return mass;
}

void set_up_world(dWorldID world, const WorldSettings& settings) {
  const auto& [x, y, z] = settings.gravity;
  dWorldSetGravity(world, x, y, z);
  dWorldSetAutoDisableFlag(world, 0);  // a pile that sleeps would be nothing to collide
  dWorldSetERP(world, settings.erp);
  dWorldSetCFM(world, settings.cfm);
  dWorldSetQuickStepNumIterations(world, settings.iterations);
  dWorldSetContactSurfaceLayer(world, settings.surface_layer);
  dWorldSetContactMaxCorrectingVel(world, settings.correcting_speed);
  dWorldSetLinearDamping(world, settings.linear_damping);
  dWorldSetAngularDamping(world, settings.angular_damping);
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

SceneDescription describe_drop(std::vector<NamedMesh> meshes, const SimulationSettings& settings) {
  SceneDescription description;
  description.meshes = std::move(meshes);
  description.drop = Drop{settings.objects, settings.sheets};
  return description;
}

}  // namespace

void set_index(dGeomID geom, std::size_t index) {
  dGeomSetData(geom, reinterpret_cast<void*>(static_cast<std::uintptr_t>(index)));
}

std::size_t index_of(dGeomID geom) {
  return static_cast<std::size_t>(reinterpret_cast<std::uintptr_t>(dGeomGetData(geom)));
}

Scene::Scene(std::vector<NamedMesh> meshes, const SimulationSettings& settings,
             std::vector<std::string>& warnings)
    : Scene(describe_drop(std::move(meshes), settings), settings.seed, warnings) {}

Scene::Scene(SceneDescription description, std::uint64_t seed, std::vector<std::string>& warnings)
    : description_(std::move(description)),
      skins_(description_.drop && description_.drop->sheets > 0),
      world_(dWorldCreate()),
      space_(dSweepAndPruneSpaceCreate(nullptr, kAxes)) {
  set_up_world(world_, description_.world);
  dRandSetSeed(static_cast<unsigned long>(seed));  // QuickStep shuffles its rows
  if (skins_) let_bodies_sleep(world_);
  if (description_.drop) add_ground(seed);
  add_shapes(warnings);
  if (description_.drop) add_dropped(seed);
  for (const BodyDescription& body : description_.bodies) add_object(body);
  for (const JointDescription& joint : description_.joints) add_joint(joint);
}

void Scene::add_ground(std::uint64_t seed) {
  const auto objects = static_cast<std::size_t>(description_.drop->objects);
  ground_ = Ground(ground_half_size(objects), seed);
  ground_data_ = make_data(ground_.mesh());
  if (skins_) {
    ground_skin_ = inflate(ground_.mesh(), kSheetMargin);
    ground_skin_data_ = make_data(ground_skin_);
  }
  add_geom(ground_data_, ground_skin_data_, nullptr, objects, false);
}

void Scene::add_shapes(std::vector<std::string>& warnings) {
  // ODE keeps pointers to the vertices: no shape may move once its data is built.
  shapes_.reserve(description_.meshes.size());
  for (const NamedMesh& named : description_.meshes) {
    const bool closed = is_closed(named.mesh);
    Shape& shape = shapes_.emplace_back(Shape{
        named.name, named.mesh, closed, bounding_radius(named.mesh), nullptr, {}, {}, nullptr});
    shape.data = make_data(shape.mesh);
    if (skins_) {
      shape.skin = inflate(shape.mesh, kSheetMargin);
      shape.skin_data = make_data(shape.skin);
    }
    const std::optional<dMass> mass = mass_of(shape);
    shape.mass = mass ? *mass : mass_of_ball(shape.radius);
    if (closed && !mass) {
      warnings.push_back("the mesh '" + shape.name +
                         "' has parts that are wound against one another: it gets the mass and "
                         "inertia of a ball");
    }
    if (!closed) {
      warnings.push_back(
          "the mesh '" + shape.name +
          "' is not closed (of each edge two triangles are expected, wound to either "
          "side): it gets the mass and inertia of a ball, and how deep it gets into "
          "others cannot be measured");
    }
  }
}

void Scene::add_dropped(std::uint64_t seed) {
  Random random(seed);
  const auto count = static_cast<std::size_t>(description_.drop->objects);
  for (const Placement& placement : place_objects(count, shapes_.size(), ground_, random)) {
    BodyDescription body;
    body.mesh = placement.shape;
    body.position = placement.position;
    body.rotation = placement.rotation;
    add_object(body);
  }
}

void Scene::add_object(const BodyDescription& body) {
  const Shape& shape = shapes_[body.mesh];
  const bool moves = body.motion == Motion::kFree;
  Object object{body.mesh, dBodyCreate(world_), nullptr, body.mu.value_or(description_.contact.mu)};
  dMass mass = shape.mass;
  dMassAdjust(&mass, mass.mass * (body.density / kWater));
  dBodySetMass(object.body, &mass);
  object.geom = add_geom(shape.data, shape.skin_data, object.body, objects_.size(), moves);
  const auto& [x, y, z] = body.position;
  dBodySetPosition(object.body, x, y, z);
  const dQuaternion q{body.rotation[0], body.rotation[1], body.rotation[2], body.rotation[3]};
  dBodySetQuaternion(object.body, q);
  if (!moves) {
    dBodySetKinematic(object.body);
    dBodySetLinearDamping(object.body, 0);
    dBodySetAngularDamping(object.body, 0);
  }
  if (body.motion != Motion::kFixed) {
    dBodySetLinearVel(object.body, body.velocity[0], body.velocity[1], body.velocity[2]);
    dBodySetAngularVel(object.body, body.spin[0], body.spin[1], body.spin[2]);
  }
  objects_.push_back(object);
}

void Scene::add_joint(const JointDescription& joint) {
  const dBodyID body = objects_[joint.body].body;
  const dBodyID other = joint.other ? objects_[*joint.other].body : nullptr;
  const auto& [x, y, z] = joint.axis;
  if (joint.kind == JointDescription::Kind::kHinge) {
    dJointID hinge = dJointCreateHinge(world_, nullptr);
    dJointAttach(hinge, body, other);
    dJointSetHingeAnchor(hinge, joint.anchor[0], joint.anchor[1], joint.anchor[2]);
    dJointSetHingeAxis(hinge, x, y, z);
    if (joint.motor) {
      dJointSetHingeParam(hinge, dParamVel, joint.motor->speed);
      dJointSetHingeParam(hinge, dParamFMax, joint.motor->force);
    }
  } else {
    dJointID slider = dJointCreateSlider(world_, nullptr);
    dJointAttach(slider, body, other);
    dJointSetSliderAxis(slider, x, y, z);
    if (joint.motor) {
      dJointSetSliderParam(slider, dParamVel, joint.motor->speed);
      dJointSetSliderParam(slider, dParamFMax, joint.motor->force);
    }
  }
}

std::string Scene::name_of(std::size_t index) const {
  if (index >= objects_.size()) return "the ground";
  if (index < description_.bodies.size()) return description_.bodies[index].name;
  return "object " + std::to_string(index) + " (" + shape_of(index).name + ")";
}

void Scene::drop(std::size_t count) {
  const std::size_t first = objects_.size();
  std::vector<Object> models;
  for (const Object& object : objects_) {
    if (can_move(object)) models.push_back(object);
  }
  if (models.empty()) return;
  Point middle{};
  double top = -std::numeric_limits<double>::infinity(), radius = 0;
  for (const Object& model : models) {
    const dReal* p = dBodyGetPosition(model.body);
    for (int k = 0; k < 2; ++k) middle[k] += p[k] / static_cast<double>(models.size());
    radius = std::max(radius, shapes_[model.shape].radius);
    top = std::max(top, static_cast<double>(p[2]));
  }
  Random random(first);
  for (std::size_t i = 0; i < count; ++i) {
    const Object& model = models[random.below(models.size())];
    const dReal* q = dBodyGetQuaternion(model.body);
    const auto aside = [&] { return random.between(-radius, radius); };
    top += 2.1 * radius;
    BodyDescription body;
    body.mesh = model.shape;
    body.position = {middle[0] + aside(), middle[1] + aside(), top};
    body.rotation = {q[0], q[1], q[2], q[3]};
    body.mu = model.mu;
    add_object(body);
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

double Scene::mu_between(std::size_t i, std::size_t j) const {
  double mu = std::numeric_limits<double>::infinity();
  for (const std::size_t index : {i, j}) {
    mu = std::min(mu, index < objects_.size() ? objects_[index].mu : description_.contact.mu);
  }
  return mu;
}

// The mesh, and its skin if it has one. Returns the mesh's. What nothing moves does not look for
// others: they find it.
dGeomID Scene::add_geom(dTriMeshDataID data, dTriMeshDataID skin_data, dBodyID body,
                        std::size_t index, bool moves) {
  const auto add = [&](dTriMeshDataID of, unsigned long category, unsigned long collide) {
    dGeomID geom = dCreateTriMesh(space_, of, nullptr, nullptr, nullptr);
    set_index(geom, index);
    dGeomSetCategoryBits(geom, category);
    dGeomSetCollideBits(geom, collide);
    if (body != nullptr) dGeomSetBody(geom, body);
    return geom;
  };
  if (skin_data != nullptr) add(skin_data, kSkinBit, kSheetBit);
  return add(data, kMeshBit, moves ? kMeshBit : 0);
}

Scene::~Scene() {
  dSpaceDestroy(space_);
  dWorldDestroy(world_);
  for (const Shape& shape : shapes_) {
    dGeomTriMeshDataDestroy(shape.data);
    if (shape.skin_data != nullptr) dGeomTriMeshDataDestroy(shape.skin_data);
  }
  if (ground_data_ != nullptr) dGeomTriMeshDataDestroy(ground_data_);
  if (ground_skin_data_ != nullptr) dGeomTriMeshDataDestroy(ground_skin_data_);
}

}  // namespace falling_objects
