// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abi/types.h"
#include "search/scene.h"

namespace ode_ext {

// The leading 24 bits of x (Veltkamp 1968), which a float holds exactly, so that x - leading(x) is
// exact too. Not x - double(float(x)): g++ 12 can vectorise that into 0.
inline double leading(double x) {
  const double scaled = (0x1p29 + 1) * x;
  return scaled - (scaled - x);
}

inline ox_object object_record(const Scene& scene, const Scene::Object& object) {
  const Pose pose = frame_pose(object.pose, *scene.meshes[object.mesh]);
  ox_object record{};
  for (std::size_t k = 0; k < 9; ++k) {
    const double high = leading(pose.rotation[k]);
    record.rotation[k] = static_cast<float>(high);
    record.rotation_rest[k] = static_cast<float>(pose.rotation[k] - high);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const double high = leading(pose.position[k]);
    record.hi[k] = static_cast<float>(high);
    record.lo[k] = static_cast<float>(pose.position[k] - high);
  }
  record.mesh = object.mesh;
  return record;
}

}  // namespace ode_ext
