// SPDX-License-Identifier: BSD-3-Clause
// What --mesh does to a scene.
#pragma once

#include <string>
#include <vector>

#include "scene_file/scene_description.h"

namespace falling_objects {

// NAME=FILE, or FILE alone: then there is no name. A file may have such a name.
struct MeshOption {
  std::string name, path;
};
MeshOption mesh_option(const std::string& text);

// A scene that drops objects drops these files instead of its own. In any other each is NAME=FILE
// and takes the place and the size of the mesh NAME; a scene of which only one mesh can move needs
// no NAME. Throws std::runtime_error with a sentence.
void use_meshes(SceneDescription& scene, const std::vector<std::string>& meshes);

}  // namespace falling_objects
