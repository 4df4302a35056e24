// SPDX-License-Identifier: BSD-3-Clause
// What a batch collides.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/vec.h"

namespace ode_ext {

// Rigid placement: world = rotation * local + position; rotation row-major 3x3.
struct Pose {
  Vec3d position{};
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
  bool operator==(const Pose&) const = default;

  Vec3d rotate(Vec3d v) const {
    const auto& r = rotation;
    return {r[0] * v.x + r[1] * v.y + r[2] * v.z, r[3] * v.x + r[4] * v.y + r[5] * v.z,
            r[6] * v.x + r[7] * v.y + r[8] * v.z};
  }
  Vec3d rotate_back(Vec3d v) const {
    const auto& r = rotation;
    return {r[0] * v.x + r[3] * v.y + r[6] * v.z, r[1] * v.x + r[4] * v.y + r[7] * v.z,
            r[2] * v.x + r[5] * v.y + r[8] * v.z};
  }
  Vec3d transform(Vec3d p) const { return rotate(p) + position; }
};

// Of the frame in which a mesh has its vertices, where the mesh is at `pose`.
inline Pose frame_pose(const Pose& pose, const Mesh& mesh) {
  return {pose.transform(Vec3d(mesh.origin)), pose.rotation};
}

struct Scene {
  struct Object {
    Pose pose;                   // of what the mesh was made of
    std::uint32_t mesh;          // index into meshes
    std::uint64_t identity = 0;  // the same from pass to pass; 0: none, nothing is remembered of it
  };
  std::vector<std::shared_ptr<const Mesh>> meshes;
  std::vector<Object> objects;
  std::vector<std::array<std::uint32_t, 2>> pairs;  // of objects
  // Of each pair: as many features as were found of it the last time; 0: not known. Or empty.
  std::vector<std::uint32_t> features;
};

// Pairs of a scene that are collided together.
struct Tile {
  std::size_t first, count;
};

}  // namespace ode_ext
