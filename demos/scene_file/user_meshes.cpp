// SPDX-License-Identifier: BSD-3-Clause
#include "scene_file/user_meshes.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "meshes/mesh_file.h"

namespace falling_objects {
namespace {

std::size_t number_of(const SceneDescription& scene, const std::string& name) {
  std::set<std::size_t> that_move;
  std::string names;
  for (const BodyDescription& body : scene.bodies) {
    if (body.motion == Motion::kFree) that_move.insert(body.mesh);
  }
  if (name.empty() && that_move.size() == 1) return *that_move.begin();
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    if (scene.meshes[i].name == name) return i;
    names += (names.empty() ? "" : ", ") + scene.meshes[i].name;
  }
  throw std::runtime_error("--mesh: write NAME=FILE with one of the meshes of the scene: " + names);
}

}  // namespace

MeshOption mesh_option(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || std::filesystem::exists(text)) return {"", text};
  return {text.substr(0, equals), text.substr(equals + 1)};
}

void use_meshes(SceneDescription& scene, const std::vector<std::string>& meshes) {
  if (meshes.empty()) return;
  if (scene.drop) {
    scene.meshes.clear();
    for (const std::string& path : meshes) scene.meshes.push_back({path, load_mesh(path)});
    return;
  }
  std::set<std::size_t> taken;
  for (const std::string& text : meshes) {
    const MeshOption option = mesh_option(text);
    const std::size_t number = number_of(scene, option.name);
    NamedMesh& mesh = scene.meshes[number];
    if (!taken.insert(number).second)
      throw std::runtime_error("--mesh: there are two for '" + mesh.name + "'");
    const double radius = bounding_radius(mesh.mesh);
    mesh.mesh = load_mesh(option.path);
    scale_mesh(mesh.mesh, radius / kShapeRadius);
  }
}

}  // namespace falling_objects
