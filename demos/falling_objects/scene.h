// SPDX-License-Identifier: BSD-3-Clause
// The ODE world: objects above the ground, ready to fall.
#pragma once

#include <ode/ode.h>

#include <cstddef>
#include <string>
#include <vector>

#include "falling_objects/gravity.h"
#include "falling_objects/ground.h"
#include "falling_objects/options.h"
#include "falling_objects/placement.h"
#include "falling_objects/shapes.h"

namespace falling_objects {

// What collides with what: meshes with meshes, and sheets with skins and with sheets.
inline constexpr unsigned long kMeshBit = 1, kSkinBit = 2, kSheetBit = 4;

struct Shape {
  std::string name;
  TriangleMesh mesh;
  bool closed;
  dTriMeshDataID data;  // one for all objects of the shape
  dMass mass;
  TriangleMesh skin;  // with sheets only
  dTriMeshDataID skin_data;
};

struct Object {
  std::size_t shape;
  dBodyID body;
  dGeomID geom;
};

// dGeomGetData of an object's geom is its index; that of the ground is the number of objects. With
// sheets, each has a second geom, its skin, of the same index.
class Scene {
 public:
  // `meshes` are dropped in equal numbers. Warnings, a sentence each, are appended.
  Scene(std::vector<NamedMesh> meshes, const Options& options, std::vector<std::string>& warnings);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  dWorldID world() const { return world_; }
  dSpaceID space() const { return space_; }
  const Ground& ground() const { return ground_; }
  const TriangleMesh& ground_skin() const { return ground_skin_; }
  const std::vector<Shape>& shapes() const { return shapes_; }
  const std::vector<Object>& objects() const { return objects_; }
  const Shape& shape_of(std::size_t object) const { return shapes_[objects_[object].shape]; }
  // Copies of objects that can move, above all of them. Without sheets only.
  void drop(std::size_t count);
  // Sheets have the indices after that of the ground.
  bool touches_sheet(const dContactGeom& contact) const;

 private:
  void add_shapes(std::vector<NamedMesh> meshes, std::vector<std::string>& warnings);
  void add_objects(const Options& options);
  void add_object(const Placement& placement);
  dGeomID add_geom(dTriMeshDataID data, dTriMeshDataID skin_data, dBodyID body, std::size_t index);

  bool skins_;
  Ground ground_;
  TriangleMesh ground_skin_;
  dWorldID world_;
  dSpaceID space_;
  dTriMeshDataID ground_data_;
  dTriMeshDataID ground_skin_data_ = nullptr;
  std::vector<Shape> shapes_;
  std::vector<Object> objects_;
};

void set_index(dGeomID geom, std::size_t index);
// The index that set_index stored.
std::size_t index_of(dGeomID geom);

}  // namespace falling_objects
