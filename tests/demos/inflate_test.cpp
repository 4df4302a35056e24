// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/inflate.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "cloth/sheet.h"
#include "geometry/mesh_oracle.h"
#include "judging/crossings.h"
#include "meshes/ground.h"
#include "meshes/shapes.h"
#include "meshes/surface.h"

namespace falling_objects {
namespace {

ode_ext::oracle::Mesh oracle(const TriangleMesh& mesh) { return {mesh.vertices, mesh.indices}; }

std::vector<NamedMesh> all_meshes() {
  std::vector<NamedMesh> meshes = make_shapes();
  meshes.push_back({"ground", Ground(12, 1).mesh()});
  return meshes;
}

// Faces move by the margin; where they are curved inwards, or a corner is too sharp, vertices get
// no closer than this. Vertices are floats: 1e-6 m, 12 m from the middle.
TEST(Inflate, MovesEveryVertexOutByAboutTheMargin) {
  for (const auto& [name, mesh] : all_meshes()) {
    const TriangleMesh skin = inflate(mesh, kSheetMargin);
    ASSERT_TRUE(is_closed(skin)) << name;
    const ode_ext::oracle::Mesh surface = oracle(mesh);
    for (std::size_t i = 0; i < skin.vertex_count(); ++i) {
      const auto [x, y, z] = skin.vertex(i);
      const double distance = surface.signed_distance({x, y, z});
      EXPECT_GT(distance, 0.9 * kSheetMargin) << name << " vertex " << i;
      EXPECT_LT(distance, 2 * kSheetMargin + 1e-6) << name << " vertex " << i;
    }
  }
}

TEST(Inflate, LetsNoSkinCrossTheMeshThatItIsAround) {
  for (const auto& [name, mesh] : all_meshes()) {
    const CrossingFinder finder(oracle(mesh).triangles());
    const ode_ext::oracle::Mesh skin = oracle(inflate(mesh, kSheetMargin));
    EXPECT_FALSE(std::any_of(skin.triangles().begin(), skin.triangles().end(),
                             [&](const auto& triangle) { return finder.crossed_by(triangle); }))
        << name;
  }
}

// From a place on the other side of the tube there is a way round; from opposite sides of the whole
// object there need not be.
TEST(Surface, WalksToTheClosestPlaceFromATriangleNotFarAway) {
  const TriangleMesh torus = make_bumpy_torus();
  const Surface surface(torus);
  const ode_ext::oracle::Mesh mesh = oracle(torus);
  for (std::size_t triangle = 0; triangle < torus.triangle_count(); triangle += 7) {
    const auto [a, b, c] = torus.corners(triangle);
    const ode_ext::oracle::Vector on{(a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3,
                                     (a[2] + b[2] + c[2]) / 3};
    const ode_ext::oracle::Vector inside = 0.98 * on + ode_ext::oracle::Vector{0, 0, 0.001};
    const Surface::Place near =
        surface.closest_from((triangle + 8) % torus.triangle_count(), inside);
    EXPECT_NEAR(length(near.point - inside), std::abs(mesh.signed_distance(inside)), 1e-12);
  }
}

}  // namespace
}  // namespace falling_objects
