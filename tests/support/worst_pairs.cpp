// SPDX-License-Identifier: BSD-3-Clause
#include "support/worst_pairs.h"

namespace ode_ext::test {
namespace {

// `mesh`, turned and moved in its own frame.
TestMesh placed(TestMesh mesh, const TestPose& pose) {
  for (std::size_t i = 0; i < mesh.vertices.size() / 3; ++i) {
    const Point v = to_world(pose, mesh.vertex(i));
    for (std::size_t k = 0; k < 3; ++k) mesh.vertices[3 * i + k] = static_cast<float>(v[k]);
  }
  return mesh;
}

TestMesh rough_ball(int subdivisions) {
  TestMesh mesh = make_icosphere(1, subdivisions);
  Random random(7);
  for (std::size_t i = 0; i < mesh.vertices.size() / 3; ++i) {
    const double scale = random.uniform(0.98, 1.02);
    for (std::size_t k = 0; k < 3; ++k)
      mesh.vertices[3 * i + k] = static_cast<float>(scale * mesh.vertices[3 * i + k]);
  }
  return mesh;
}

TestMesh sticks(int count, std::uint64_t seed) {
  TestMesh mesh;
  Random random(seed);
  for (int i = 0; i < count; ++i) mesh = merged(mesh, placed(make_rod(1, 0.02), random.pose(0.3)));
  return mesh;
}

TestMesh rough_sheet(int cuts) {
  TestMesh mesh = make_sheet(1, cuts);
  Random random(3);
  for (std::size_t i = 2; i < mesh.vertices.size(); i += 3)
    mesh.vertices[i] = static_cast<float>(random.uniform(-0.02, 0.02));
  return mesh;
}

}  // namespace

WorstPair rough_balls(int subdivisions) {
  const TestMesh ball = rough_ball(subdivisions);
  return {"rough balls", ball, ball, turned({1, 2, 0.5}, 0.023)};
}

WorstPair soups(int triangles) {
  return {"soups", make_soup(triangles, 7), make_soup(triangles, 8), {}};
}

WorstPair bundles_of_sticks(int count) {
  return {"sticks", sticks(count, 7), sticks(count, 8), at(0.05, 0.02, 0.03)};
}

WorstPair finely_cut_cubes(int cuts) {
  const TestMesh cube = make_cube(1, cuts);
  return {"cubes", cube, cube, turned({1, 2, 3}, 0.3, {0.02, 0.03, 0.04})};
}

WorstPair rough_sheet_in_a_face(int cuts) {
  return {"rough sheet", rough_sheet(cuts), make_cube(0.9), at(0.01, 0.02, -0.45)};
}

std::vector<WorstPair> worst_pairs() {
  std::vector<WorstPair> pairs;
  for (const int subdivisions : {3, 4, 5}) pairs.push_back(rough_balls(subdivisions));
  for (const int triangles : {100, 400, 1600}) pairs.push_back(soups(triangles));
  for (const int count : {60, 240}) pairs.push_back(bundles_of_sticks(count));
  for (const int cuts : {40, 80, 160}) pairs.push_back(finely_cut_cubes(cuts));
  for (const int cuts : {60, 120, 240}) pairs.push_back(rough_sheet_in_a_face(cuts));
  return pairs;
}

}  // namespace ode_ext::test
