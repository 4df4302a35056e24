// SPDX-License-Identifier: BSD-3-Clause
// The ODE world: bodies where a scene puts them, ready to move.
#pragma once

#include <ode/ode.h>

#include <cstddef>
#include <string>
#include <vector>

#include "meshes/ground.h"
#include "scene_file/gravity.h"
#include "scene_file/scene_description.h"
#include "simulation/placement.h"
#include "simulation/simulation_settings.h"

namespace falling_objects {

// What collides with what: meshes with meshes, and sheets with skins and with sheets.
inline constexpr unsigned long kMeshBit = 1, kSkinBit = 2, kSheetBit = 4;

struct Shape {
  std::string name;
  TriangleMesh mesh;
  bool closed;
  double radius;        // of the mesh about its center of mass [m]
  dTriMeshDataID data;  // one for all objects of the shape
  dMass mass;           // of water
  TriangleMesh skin;    // with sheets only
  dTriMeshDataID skin_data;
};

struct Object {
  std::size_t shape;
  dBodyID body;  // kinematic: of an object that nothing moves
  dGeomID geom;
  double mu;  // of friction
};

// dGeomGetData of an object's geom is its index; that of the ground is the number of objects. With
// sheets, each has a second geom, its skin, of the same index.
class Scene {
 public:
  // `seed` is that of what is dropped, of the ground and of the solver. Warnings, a sentence each,
  // are appended.
  Scene(SceneDescription description, std::uint64_t seed, std::vector<std::string>& warnings);
  // `meshes` are dropped, as many objects and sheets as the settings say.
  Scene(std::vector<NamedMesh> meshes, const SimulationSettings& settings,
        std::vector<std::string>& warnings);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  dWorldID world() const { return world_; }
  dSpaceID space() const { return space_; }
  const SceneDescription& description() const { return description_; }
  const Ground& ground() const { return ground_; }  // empty but where objects are dropped
  const TriangleMesh& ground_skin() const { return ground_skin_; }
  const std::vector<Shape>& shapes() const { return shapes_; }
  const std::vector<Object>& objects() const { return objects_; }
  const Shape& shape_of(std::size_t object) const { return shapes_[objects_[object].shape]; }
  // Copies of objects that can move, above all of them. Without sheets only.
  void drop(std::size_t count);
  // As the file calls it, or "object 3 (jack)"; past the objects "the ground".
  std::string name_of(std::size_t index) const;
  // Sheets have the indices after that of the ground.
  bool touches_sheet(const dContactGeom& contact) const;
  // Of friction where these two touch.
  double mu_between(std::size_t i, std::size_t j) const;

 private:
  void add_ground(std::uint64_t seed);
  void add_shapes(std::vector<std::string>& warnings);
  void add_dropped(std::uint64_t seed);
  void add_object(const BodyDescription& body);
  void add_joint(const JointDescription& joint);
  dGeomID add_geom(dTriMeshDataID data, dTriMeshDataID skin_data, dBodyID body, std::size_t index,
                   bool moves);

  SceneDescription description_;
  bool skins_;
  Ground ground_;
  TriangleMesh ground_skin_;
  dWorldID world_;
  dSpaceID space_;
  dTriMeshDataID ground_data_ = nullptr;
  dTriMeshDataID ground_skin_data_ = nullptr;
  std::vector<Shape> shapes_;
  std::vector<Object> objects_;
};

// Whether anything may move this object.
inline bool can_move(const Object& object) { return dBodyIsKinematic(object.body) == 0; }

void set_index(dGeomID geom, std::size_t index);
// The index that set_index stored.
std::size_t index_of(dGeomID geom);

}  // namespace falling_objects
