// SPDX-License-Identifier: BSD-3-Clause
// Scenes as TOML files; docs/scenes.md says what is in them.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "scene_file/scene_description.h"

namespace falling_objects {

// A sentence that names the file, the line, what was expected and what exists.
struct SceneFileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Of the scenes that come with the program, in alphabetical order.
std::vector<std::string> scene_names();

// The file of a scene: one of those names, or a file's own. Throws SceneFileError, as all below.
std::string find_scene_file(const std::string& name);

SceneDescription read_scene_file(const std::string& path);

// `path` is for messages, and what files of meshes are found beside.
SceneDescription read_scene(const std::string& text, const std::string& path);

}  // namespace falling_objects
