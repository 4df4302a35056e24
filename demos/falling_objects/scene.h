// SPDX-License-Identifier: BSD-3-Clause
// The ODE world: objects above the ground, ready to fall.
#pragma once

#include <ode/ode.h>

#include <cstddef>
#include <string>
#include <vector>

#include "falling_objects/ground.h"
#include "falling_objects/options.h"
#include "falling_objects/shapes.h"

namespace falling_objects {

inline constexpr double kGravity = 9.81;  // [m/s^2]

struct Shape {
  std::string name;
  TriangleMesh mesh;
  bool closed;
  dTriMeshDataID data;  // one for all objects of the shape
  dMass mass;
};

struct Object {
  std::size_t shape;
  dBodyID body;
  dGeomID geom;
};

// dGeomGetData of an object's geom is its index; that of the ground is the number of objects.
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
  const std::vector<Shape>& shapes() const { return shapes_; }
  const std::vector<Object>& objects() const { return objects_; }
  const Shape& shape_of(std::size_t object) const { return shapes_[objects_[object].shape]; }

 private:
  void add_shapes(std::vector<NamedMesh> meshes, std::vector<std::string>& warnings);
  void add_objects(const Options& options);

  Ground ground_;
  dWorldID world_;
  dSpaceID space_;
  dTriMeshDataID ground_data_;
  std::vector<Shape> shapes_;
  std::vector<Object> objects_;
};

// The index that dGeomSetData stored.
std::size_t index_of(dGeomID geom);

}  // namespace falling_objects
