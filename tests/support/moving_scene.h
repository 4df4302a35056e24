// SPDX-License-Identifier: BSD-3-Clause
// Scenes that move a little from pass to pass, as a simulation's do; objects keep their identities.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "support/test_scene.h"

namespace ode_ext::test {

class MovingScene {
 public:
  // `count` pairs of overlapping meshes; each pass moves every object by about `motion` [m] and
  // turns it by about `motion` [rad].
  MovingScene(const std::vector<TestMesh>& meshes, int count, double motion, std::uint64_t seed)
      : random_(seed), motion_(motion) {
    for (const TestMesh& mesh : meshes) scene_.add_mesh(mesh);
    for (int i = 0; i < count; ++i) {
      TestPose a = random_.pose(0.3), b = random_.pose(0.3);
      const Point place{4.0 * (i % 8), 4.0 * (i / 8 % 8), 4.0 * (i / 64)};
      a.position = a.position + place;
      b.position = b.position + place;
      const int kinds = static_cast<int>(meshes.size());
      scene_.add_pair(static_cast<std::uint32_t>(random_.below(kinds)), a,
                      static_cast<std::uint32_t>(random_.below(kinds)), b);
    }
    for (std::size_t i = 0; i < scene_.scene.objects.size(); ++i)
      scene_.scene.objects[i].identity = i + 1;
  }

  Scene& scene() { return scene_.scene; }

  void advance() {
    for (Scene::Object& object : scene_.scene.objects) {
      const TestPose nudge = turned({random_.uniform(-1, 1), random_.uniform(-1, 1), 1},
                                    random_.uniform(-motion_, motion_));
      const Pose by = collider_pose(nudge);
      std::array<double, 9> rotation{};
      for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c)
          for (std::size_t k = 0; k < 3; ++k)
            rotation[3 * r + c] += by.rotation[3 * r + k] * object.pose.rotation[3 * k + c];
      object.pose.rotation = rotation;
      object.pose.position = object.pose.position + Vec3d{random_.uniform(-motion_, motion_),
                                                          random_.uniform(-motion_, motion_),
                                                          random_.uniform(-motion_, motion_)};
    }
  }

 private:
  Random random_;
  double motion_;
  TestScene scene_;
};

// Round, and of a few hundred triangles.
inline std::vector<TestMesh> smooth_meshes() {
  return {make_icosphere(0.6, 3), make_torus(0.5, 0.2, 48, 24), make_icosphere(0.4, 2)};
}

}  // namespace ode_ext::test
