// SPDX-License-Identifier: BSD-3-Clause
// The tables [mesh.NAME] and [[body]] of a scene file.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scene_file/scene_description.h"
#include "scene_file/toml_table.h"

namespace falling_objects {

class BodyReader {
 public:
  // `folder` is where files of meshes are looked for.
  BodyReader(SceneDescription& scene, std::string folder);

  void read_mesh(const std::string& name, TomlTable& table);
  void read_body(TomlTable& table);
  // The number of the mesh that the text at `key` of a table names: one that was read, or a shape
  // as it is without parameters.
  std::size_t mesh_named(const std::string& name, const char* key, const TomlTable& table);
  // What two are named names none.
  std::size_t body_named(const char* key, TomlTable& table) const;
  // The one of this name, or all that a [[body]] of this name made.
  std::vector<std::size_t> bodies_named(const char* key, TomlTable& table) const;

 private:
  std::size_t body_named(const char* key, const std::string& name, const TomlTable& table) const;
  void add_mesh(const std::string& name, TriangleMesh mesh);

  SceneDescription& scene_;
  std::string folder_;
  std::map<std::string, std::size_t> numbers_;
  std::vector<Point> origins_;  // of each mesh as it was made, seen from its center of mass
};

}  // namespace falling_objects
