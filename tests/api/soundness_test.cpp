// SPDX-License-Identifier: BSD-3-Clause
// Whatever the meshes are, what comes out can be handed to a solver.
#include <algorithm>
#include <cmath>
#include <string>

#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

// Three vertices in a line and a triangle without extent, besides a sound cube.
TestMesh make_degenerate() {
  TestMesh mesh = make_cube(0.9);
  const auto first = static_cast<unsigned>(mesh.vertex_count());
  mesh.vertices.insert(mesh.vertices.end(), {-1, 0, 0, 0, 0, 0, 1, 0, 0});
  mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, 0, 0, 1});
  return mesh;
}

// Nothing but such triangles: no surface at all.
TestMesh make_needles() {
  TestMesh mesh;
  mesh.vertices = {-1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0.5f};
  mesh.indices = {0, 1, 2, 1, 1, 3, 0, 2, 1};
  return mesh;
}

TestMesh without_a_triangle(TestMesh mesh) {
  mesh.indices.resize(mesh.indices.size() - 3);
  return mesh;
}

std::vector<TestMesh> all_kinds() {
  const TestMesh cube = make_cube(1, 2);
  return {make_tetrahedron(1.2),
          cube,
          make_plate(1.5, 0.05, 4),
          make_icosphere(0.6, 2),
          make_torus(0.5, 0.2, 12, 8),
          make_rod(2, 0.1),
          make_l(1),
          make_comb(4, 1.4, 0.6, 0.5),
          make_cylinder(0.4, 1, 12),
          make_sheet(1.5, 4),
          without_a_triangle(cube),
          make_triangle(1),
          make_degenerate(),
          make_needles(),
          inverted(cube),
          inverted(make_sheet(1.5, 4)),
          unshared(make_l(1)),
          merged(cube, cube),
          merged(moved(cube, {-0.4, 0, 0}), moved(make_sheet(1, 2), {0.5, 0, 0})),
          scaled(make_icosphere(0.6, 1), 1e-3)};
}

std::string complaint(const dContactGeom& c, dGeomID g1, dGeomID g2) {
  if (c.g1 != g1 || c.g2 != g2) return "geoms";
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(c.pos[k])) return "position";
    if (!std::isfinite(c.normal[k])) return "normal";
  }
  if (!(std::fabs(length(normal(c)) - 1) < 1e-6)) return "length of the normal";  // ODE's own bound
  if (!std::isfinite(c.depth) || c.depth < 0) return "depth";
  if (c.side1 < 0 || c.side1 >= dGeomTriMeshGetTriangleCount(g1)) return "side1";
  if (c.side2 < 0 || c.side2 >= dGeomTriMeshGetTriangleCount(g2)) return "side2";
  return "";
}

struct Handling {
  const char* name;
  const char* config;
  bool deformable;
};

class ApiSoundness : public ::testing::TestWithParam<Handling> {};

TEST_P(ApiSoundness, OfEveryPairOfKindsAreFiniteUnitAndValid) {
  OdeWorld world;
  const BatchCollider collider([](dBatchColliderParams& params) {
    params.max_contacts = 64;
    params.config = GetParam().config;
  });
  const std::vector<TestMesh> kinds = all_kinds();
  std::vector<dGeomID> first, second;
  std::vector<double> sizes;
  for (const TestMesh& kind : kinds) {
    const OdeMesh& mesh = world.mesh(kind);
    if (GetParam().deformable) dBatchColliderTriMeshDataSetDeformable(collider, mesh.id(), 1);
    first.push_back(world.geom(mesh, {}));
    second.push_back(world.geom(mesh, {}));
    sizes.push_back(mesh_size(kind));
  }
  Random random(77);
  std::size_t total = 0, colliding = 0;
  for (std::size_t a = 0; a < kinds.size(); ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      for (int i = 0; i < 4; ++i) {
        // The first at one pose: exactly on one another where the two are the same.
        const TestPose pose = random.pose(0.3);
        set_pose(first[a], pose);
        set_pose(second[b], i == 0 ? pose : random.pose(0.3));
        const Contacts contacts = collide(first[a], second[b]);
        colliding += contacts.empty() ? 0 : 1;
        total += contacts.size();
        for (const dContactGeom& c : contacts) {
          ASSERT_EQ(complaint(c, first[a], second[b]), "") << "kinds " << a << ", " << b;
          // Nothing is deeper than both are large, side by side.
          ASSERT_LE(c.depth, 2 * (sizes[a] + sizes[b])) << "kinds " << a << ", " << b;
        }
      }
    }
  }
  EXPECT_GT(colliding, 400u);
  EXPECT_GT(total, 4000u);
}

INSTANTIATE_TEST_SUITE_P(Each, ApiSoundness,
                         ::testing::Values(Handling{"WithEdges", "edges=on", false},
                                           Handling{"WithoutEdges", "edges=off", false},
                                           Handling{"OfDeformableMeshes", "edges=on", true}),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace ode_ext::test
