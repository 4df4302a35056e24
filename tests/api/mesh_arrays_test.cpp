// SPDX-License-Identifier: BSD-3-Clause
// The program's arrays, read in place, beside what ODE says of the same data.
#include "ode/mesh_arrays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "ode/mesh_import.h"
#include "support/ode_world.h"

namespace ode_ext::test {
namespace {

// Three vertices and two triangles in arrays with other things between them.
template <class Real>
struct Strided {
  struct Vertex {
    Real at[3];
    Real color[2];
  };
  struct Triangle {
    dTriIndex corner[3];
    dTriIndex material;
  };

  Strided() { build(); }
  ~Strided() { dGeomTriMeshDataDestroy(data); }
  void build() {
    const auto build_of =
        sizeof(Real) == sizeof(float) ? dGeomTriMeshDataBuildSingle : dGeomTriMeshDataBuildDouble;
    build_of(data, vertices, sizeof(Vertex), 4, triangles, 6, sizeof(Triangle));
  }
  TriangleSoup read() const {
    TriangleSoup soup;
    MeshReader(data).read(soup);
    return soup;
  }

  Vertex vertices[4] = {
      {{0, 0, 0}, {9, 9}}, {{1, 0, 0}, {9, 9}}, {{0, 2, 0}, {9, 9}}, {{0, 0, Real(0.1)}, {9, 9}}};
  Triangle triangles[2] = {{{0, 1, 2}, 77}, {{0, 3, 1}, 78}};
  dTriMeshDataID data = dGeomTriMeshDataCreate();
};

class MeshArraysTest : public ::testing::Test {
 protected:
  OdeWorld world_;
};

template <class Real>
void expect_found(const Strided<Real>& mesh) {
  const auto arrays = arrays_of(mesh.data);
  ASSERT_TRUE(arrays.has_value());
  EXPECT_EQ(static_cast<const void*>(arrays->vertices), mesh.vertices);
  EXPECT_EQ(arrays->vertex_stride, sizeof(mesh.vertices[0]));
  EXPECT_EQ(arrays->vertex_count, 4u);
  EXPECT_EQ(static_cast<const void*>(arrays->indices), mesh.triangles);
  EXPECT_EQ(arrays->index_stride, sizeof(mesh.triangles[0]));
  EXPECT_EQ(arrays->triangle_count, 2u);
  EXPECT_EQ(arrays->is_single, sizeof(Real) == sizeof(float));
  EXPECT_TRUE(arrays->give(mesh.read()));
}

TEST_F(MeshArraysTest, AreThoseTheProgramBuiltTheMeshOf) {
  expect_found(Strided<float>());
  expect_found(Strided<double>());
}

TEST_F(MeshArraysTest, AreTheLastThatTheMeshWasBuiltOf) {
  Strided<double> mesh;
  const Strided<float> other;
  dGeomTriMeshDataBuildSingle(mesh.data, other.vertices, sizeof(other.vertices[0]), 4,
                              other.triangles, 6, sizeof(other.triangles[0]));
  const auto arrays = arrays_of(mesh.data);
  ASSERT_TRUE(arrays.has_value());
  EXPECT_EQ(static_cast<const void*>(arrays->vertices), other.vertices);
  EXPECT_TRUE(arrays->is_single);
  mesh.build();
  expect_found(mesh);
}

TEST_F(MeshArraysTest, GiveWhatOdeGivesOfMeshesOfAllKinds) {
  for (const TestMesh& mesh : {make_icosphere(1, 3), make_torus(1, 0.3, 24, 12)}) {
    const OdeMesh& in_ode = world_.mesh(mesh);
    TriangleSoup soup;
    MeshReader(in_ode.id()).read(soup);
    const auto arrays = arrays_of(in_ode.id());
    ASSERT_TRUE(arrays.has_value());
    EXPECT_TRUE(arrays->give(soup));
  }
}

TEST_F(MeshArraysTest, NoticeEachCoordinateAndEachCorner) {
  Strided<double> mesh;
  const TriangleSoup soup = mesh.read();
  const auto arrays = arrays_of(mesh.data);
  ASSERT_TRUE(arrays.has_value());
  for (auto& vertex : mesh.vertices)
    for (double& coordinate : vertex.at) {
      const double before = std::exchange(coordinate, coordinate + 0.25);
      EXPECT_FALSE(arrays->give(soup));
      coordinate = before;
    }
  for (auto& triangle : mesh.triangles)
    for (dTriIndex& corner : triangle.corner) {
      const dTriIndex before = std::exchange(corner, (corner + 1) % 4);
      EXPECT_FALSE(arrays->give(soup));
      corner = before;
    }
  EXPECT_TRUE(arrays->give(soup));
}

TEST_F(MeshArraysTest, ReadZeroOfEitherSignAsOdeDoes) {
  Strided<double> mesh;
  mesh.vertices[1].at[1] = -0.0;
  const TriangleSoup soup = mesh.read();
  ASSERT_FALSE(std::signbit(soup[1].y));
  EXPECT_TRUE(arrays_of(mesh.data)->give(soup));
}

TEST_F(MeshArraysTest, LeaveWhatIsNotFiniteToOde) {
  Strided<double> mesh;
  mesh.vertices[1].at[1] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(arrays_of(mesh.data)->give(mesh.read()));
}

TEST_F(MeshArraysTest, AreNotReadBeyondTheLastVertex) {
  Strided<double> mesh;
  const TriangleSoup soup = mesh.read();
  mesh.triangles[1].corner[2] = 4000000000u;
  EXPECT_FALSE(arrays_of(mesh.data)->give(soup));
}

}  // namespace
}  // namespace ode_ext::test
