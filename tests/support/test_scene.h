// SPDX-License-Identifier: BSD-3-Clause
// Scenes of small meshes, kept both as the reference sees them and as the collider does.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "contacts/contact.h"
#include "search/scene.h"
#include "support/mesh_makers.h"

namespace ode_ext::test {

inline TriangleSoup soup_of(const TestMesh& mesh) {
  TriangleSoup soup;
  for (const unsigned index : mesh.indices)
    soup.push_back(
        {mesh.vertices[3 * index], mesh.vertices[3 * index + 1], mesh.vertices[3 * index + 2]});
  return soup;
}

inline Pose collider_pose(const TestPose& pose) {
  return {{pose.position[0], pose.position[1], pose.position[2]}, pose.rotation};
}

struct TestScene {
  struct Object {
    std::uint32_t mesh;
    TestPose pose;
  };
  std::vector<TestMesh> meshes;
  std::vector<Object> objects;
  std::vector<std::array<std::uint32_t, 2>> pairs;
  Scene scene;  // the same, for the collider

  std::uint32_t add_mesh(const TestMesh& mesh) {
    meshes.push_back(mesh);
    scene.meshes.push_back(std::make_shared<const Mesh>(build_mesh(soup_of(mesh))));
    return static_cast<std::uint32_t>(meshes.size() - 1);
  }
  std::uint32_t add_object(std::uint32_t mesh, const TestPose& pose) {
    objects.push_back({mesh, pose});
    scene.objects.push_back({collider_pose(pose), mesh});
    return static_cast<std::uint32_t>(objects.size() - 1);
  }
  void add_pair(std::uint32_t mesh_a, const TestPose& pose_a, std::uint32_t mesh_b,
                const TestPose& pose_b) {
    pairs.push_back({add_object(mesh_a, pose_a), add_object(mesh_b, pose_b)});
    scene.pairs.push_back(pairs.back());
  }

  const TestMesh& mesh_of(std::size_t pair, std::size_t side) const {
    return meshes[objects[pairs[pair][side]].mesh];
  }
  const TestPose& pose_of(std::size_t pair, std::size_t side) const {
    return objects[pairs[pair][side]].pose;
  }
  const Mesh& built_mesh_of(std::size_t pair, std::size_t side) const {
    return *scene.meshes[objects[pairs[pair][side]].mesh];
  }
};

inline TestScene one_pair(const TestMesh& a, const TestPose& pa, const TestMesh& b,
                          const TestPose& pb) {
  TestScene scene;
  const std::uint32_t mesh_a = scene.add_mesh(a);
  scene.add_pair(mesh_a, pa, scene.add_mesh(b), pb);
  return scene;
}

// Every vertex moved by up to `amount` [m] along each axis: no two edges parallel, no rays that go
// exactly through an edge.
inline TestMesh jittered(TestMesh mesh, double amount, std::uint64_t seed) {
  Random random(seed);
  for (float& coordinate : mesh.vertices)
    coordinate += static_cast<float>(random.uniform(-amount, amount));
  return mesh;
}

// Sharp and round, convex and not, thin and thick; the last two are open.
inline std::vector<TestMesh> small_meshes() {
  return {make_tetrahedron(1.2),   make_cube(1, 2),
          make_icosphere(0.6, 1),  make_torus(0.5, 0.2, 9, 6),
          make_rod(2, 0.2),        jittered(make_l(1), 0.03, 1),
          make_plate(1.4, 0.1, 3), inverted(make_cube(0.8)),
          make_sheet(1.5, 3),      make_triangle(1)};
}
inline constexpr int kSmallMeshCount = 10;
inline constexpr int kSmallClosedMeshCount = 8;

// Those against which rays of all vertices find what crossings lead to. What pierces a face of a
// mesh and meets none of its edges parts none of its vertices from the others; a solid then has its
// own inside, an open mesh has not.
inline std::vector<TestMesh> small_closed_meshes() {
  std::vector<TestMesh> meshes = small_meshes();
  meshes.resize(kSmallClosedMeshCount);
  return meshes;
}

// `count` pairs of the first `kinds` small meshes, turned at random, most of them overlapping; each
// pair somewhere else.
inline TestScene random_scene(int count, std::uint64_t seed, int kinds = kSmallMeshCount) {
  TestScene scene;
  for (const TestMesh& mesh : small_meshes()) scene.add_mesh(mesh);
  Random random(seed);
  for (int i = 0; i < count; ++i) {
    TestPose a = random.pose(0.35), b = random.pose(0.35);
    const Point place{random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(-20, 20)};
    a.position = a.position + place;
    b.position = b.position + place;
    const auto mesh_a = static_cast<std::uint32_t>(random.below(kinds));
    const auto mesh_b = static_cast<std::uint32_t>(random.below(kinds));
    scene.add_pair(mesh_a, a, mesh_b, b);
  }
  return scene;
}

// [m] what the pair step takes for what is not known of a coordinate (kernels/pair_step.cl).
inline double pair_epsilon(const TestScene& scene, std::size_t pair) {
  const TestPose &pa = scene.pose_of(pair, 0), &pb = scene.pose_of(pair, 1);
  double largest = 0;
  for (const double x : rotate_back(pb, pa.position - pb.position)) largest += std::fabs(x);
  for (const std::size_t side : {0u, 1u})
    largest += length(Vec3d(farthest_corner(scene.built_mesh_of(pair, side).box)));
  return 0x1p-20 * largest;
}

// OX_INFLATION of kernels/lib/general_position.h: how far A is taken out along its vertices'
// normals [epsilons of the pair]. Which side of the surface a vertex is on that is nearer to it
// than kDoubt epsilons is not known: the growth of the surface and of the body that the vertex is
// of, and what rounds.
inline constexpr double kInflation = 2;
inline constexpr double kDoubt = 10;

// A contact's bits: position, normal, depth, triangles.
using ContactBits = std::array<std::uint64_t, 9>;

inline ContactBits bits_of(const Contact& c) {
  const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
  return {bits(c.position.x), bits(c.position.y), bits(c.position.z),
          bits(c.normal.x),   bits(c.normal.y),   bits(c.normal.z),
          bits(c.depth),      c.triangles[0],     c.triangles[1]};
}

// Per pair, in order.
inline std::vector<std::vector<ContactBits>> bits_of(const PairContacts& result) {
  std::vector<std::vector<ContactBits>> bits;
  for (const PairContacts::Range& range : result.ranges) {
    bits.emplace_back();
    for (std::size_t k = range.first; k < range.first + range.count; ++k)
      bits.back().push_back(bits_of(result.contacts[k]));
  }
  return bits;
}

inline Point point_of(Vec3d v) { return {v.x, v.y, v.z}; }
inline Point point_of(Vec3f v) { return point_of(Vec3d(v)); }
inline Point point_of(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

}  // namespace ode_ext::test
