// SPDX-License-Identifier: BSD-3-Clause
// A run as an animation in a glTF file (.glb): a node for every object, those of a shape share its
// mesh, and those that move have their poses at the times that were recorded. Blender and every
// viewer of glTF 2.0 play it. glTF has y up: the root node turns z there.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "simulation/scene.h"

namespace falling_objects {

class GltfRecorder {
 public:
  explicit GltfRecorder(const Scene& scene);

  // Where all objects are, at a time [s] later than the last.
  void record(double time);

  // Throws std::runtime_error with a sentence that names the file.
  void write(const std::string& path) const;

 private:
  struct Track {
    std::vector<std::array<float, 3>> positions;  // [m]
    std::vector<std::array<float, 4>> rotations;  // x, y, z, w, as glTF has them
  };

  const Scene& scene_;
  std::vector<float> times_;
  std::vector<Track> tracks_;  // of the objects
};

}  // namespace falling_objects
