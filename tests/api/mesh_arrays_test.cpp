// SPDX-License-Identifier: BSD-3-Clause
// The program's arrays, read in place, beside what ODE says of the same data.
#include "ode/mesh_arrays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "ode/mesh_import.h"
#include "ode/read_triangle.h"
#include "support/ode_world.h"

namespace ode_ext::test {
namespace {

// What ODE gives, triangle by triangle.
TriangleSoup odes_own(dTriMeshDataID data) {
  const dGeomID geom = dCreateTriMesh(nullptr, data, nullptr, nullptr, nullptr);
  const auto count = static_cast<std::size_t>(dGeomTriMeshGetTriangleCount(geom));
  TriangleSoup soup(3 * count);
  for (std::size_t t = 0; t < count; ++t) read_triangle(geom, t, &soup[3 * t]);
  dGeomDestroy(geom);
  return soup;
}

// Four vertices and two triangles in arrays with other things between them.
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
  TriangleSoup read() const { return odes_own(data); }

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
    const TriangleSoup soup = odes_own(in_ode.id());
    const auto arrays = arrays_of(in_ode.id());
    ASSERT_TRUE(arrays.has_value());
    EXPECT_TRUE(arrays->give(soup));
    SourceTriangles source;
    ASSERT_TRUE(arrays->read(source));
    EXPECT_EQ(compare_soups(source, soup), 0);
    EXPECT_EQ(source.places.size(), static_cast<std::size_t>(mesh.vertex_count()));
    EXPECT_TRUE(arrays->give(source));
  }
}

// With places apart, and every corner with its own.
template <class Real>
void expect_each_is_noticed() {
  Strided<Real> mesh;
  const auto arrays = arrays_of(mesh.data);
  ASSERT_TRUE(arrays.has_value());
  SourceTriangles with_places;
  ASSERT_TRUE(arrays->read(with_places));
  for (const SourceTriangles& source : {SourceTriangles(mesh.read()), with_places}) {
    for (auto& vertex : mesh.vertices)
      for (Real& coordinate : vertex.at) {
        const Real before = std::exchange(coordinate, coordinate + Real(0.25));
        EXPECT_FALSE(arrays->give(source));
        coordinate = before;
      }
    for (auto& triangle : mesh.triangles)
      for (dTriIndex& corner : triangle.corner) {
        const dTriIndex before = std::exchange(corner, (corner + 1) % 4);
        EXPECT_FALSE(arrays->give(source));
        corner = before;
      }
    EXPECT_TRUE(arrays->give(source));
  }
}

TEST_F(MeshArraysTest, NoticeEachCoordinateAndEachCorner) {
  expect_each_is_noticed<float>();
  expect_each_is_noticed<double>();
}

// Many vertices with nothing between them are compared in blocks.
template <class Real>
void expect_each_is_noticed_among_many() {
  const TestMesh made = make_icosphere(1, 2);
  std::vector<Real> vertices(made.vertices.begin(), made.vertices.end());
  std::vector<dTriIndex> indices(made.indices.begin(), made.indices.end());
  const dTriMeshDataID data = dGeomTriMeshDataCreate();
  const auto build_of =
      sizeof(Real) == sizeof(float) ? dGeomTriMeshDataBuildSingle : dGeomTriMeshDataBuildDouble;
  build_of(data, vertices.data(), 3 * sizeof(Real), made.vertex_count(), indices.data(),
           static_cast<int>(indices.size()), 3 * sizeof(dTriIndex));
  const auto arrays = arrays_of(data);
  ASSERT_TRUE(arrays.has_value());
  SourceTriangles source;
  ASSERT_TRUE(arrays->read(source));
  EXPECT_EQ(compare_soups(source, odes_own(data)), 0);
  for (Real& coordinate : vertices) {
    const Real before = std::exchange(coordinate, coordinate + Real(0.25));
    EXPECT_FALSE(arrays->give(source));
    coordinate = before;
  }
  for (dTriIndex& corner : indices) {
    const dTriIndex before = std::exchange(corner, corner == 0 ? 1 : corner - 1);
    EXPECT_FALSE(arrays->give(source));
    corner = before;
  }
  EXPECT_TRUE(arrays->give(source));
  dGeomTriMeshDataDestroy(data);
}

TEST_F(MeshArraysTest, NoticeEachCoordinateAmongMany) {
  expect_each_is_noticed_among_many<float>();
  expect_each_is_noticed_among_many<double>();
}

TEST_F(MeshArraysTest, GiveTheSameWhateverVerticesOfNoTriangleAre) {
  Strided<double> mesh;
  mesh.triangles[0].corner[1] = 3;
  mesh.triangles[1].corner[2] = 2;  // the second vertex is of neither
  SourceTriangles source;
  ASSERT_TRUE(arrays_of(mesh.data)->read(source));
  EXPECT_EQ(compare_soups(source, mesh.read()), 0);
  for (const double other : {7.0, std::numeric_limits<double>::quiet_NaN()}) {
    mesh.vertices[1].at[2] = other;
    EXPECT_TRUE(arrays_of(mesh.data)->give(source));
    SourceTriangles again;
    ASSERT_TRUE(arrays_of(mesh.data)->read(again));
    EXPECT_EQ(compare_soups(again, source), 0);
  }
}

// ODE goes on with the strides that it had.
TEST_F(MeshArraysTest, OfStridesThatAreTooSmallAreLeftToOde) {
  const TestMesh made = make_cube(1);
  const std::vector<dTriIndex> indices(made.indices.begin(), made.indices.end());
  for (const auto& [vertex_stride, index_stride] :
       {std::pair{12, 4}, std::pair{12, 3}, std::pair{4, 12}}) {
    const dTriMeshDataID data = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildSingle(data, made.vertices.data(), vertex_stride, made.vertex_count(),
                                indices.data(), static_cast<int>(indices.size()), index_stride);
    EXPECT_FALSE(arrays_of(data).has_value());
    const TriangleSoup expected = odes_own(data);
    SourceTriangles source;
    MeshReader(data).read(source);
    EXPECT_EQ(compare_soups(source, expected), 0);
    EXPECT_EQ(expected[35].x, made.vertices[3 * indices[35]]);
    dGeomTriMeshDataDestroy(data);
  }
}

// Vertices that no triangle names may be gone, or another thread's.
TEST_F(MeshArraysTest, AreNotReadBeyondTheLastVertexThatIsNamed) {
  Strided<double> mesh;
  mesh.triangles[1].corner[1] = 2;
  SourceTriangles source;
  ASSERT_TRUE(arrays_of(mesh.data)->read(source));
  EXPECT_EQ(source.places.size(), 3u);
}

TEST_F(MeshArraysTest, OfManyMoreVerticesThanCornersKeepTheCornersOnly) {
  std::vector<double> vertices(3 * 1000);
  for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i] = 0.5 * static_cast<double>(i % 7);
  const std::vector<dTriIndex> indices = {0, 500, 999};
  const dTriMeshDataID data = dGeomTriMeshDataCreate();
  dGeomTriMeshDataBuildDouble(data, vertices.data(), 3 * sizeof(double), 1000, indices.data(), 3,
                              3 * sizeof(dTriIndex));
  SourceTriangles source;
  ASSERT_TRUE(arrays_of(data)->read(source));
  EXPECT_EQ(source.places.size(), 3u);
  EXPECT_EQ(compare_soups(source, odes_own(data)), 0);
  EXPECT_TRUE(arrays_of(data)->give(source));
  dGeomTriMeshDataDestroy(data);
}

TEST_F(MeshArraysTest, RoundAsOdeDoes) {
  Strided<double> mesh;
  const double values[] = {0.1,      -1e-40, 1e-46, 1.0 / 3,
                           16777217, 1e38,   -0.0,  0x1.fffffep-2 + 1e-12};
  for (std::size_t i = 0; i < 9; ++i) mesh.vertices[1 + i / 3].at[i % 3] = values[i % 8];
  SourceTriangles source;
  ASSERT_TRUE(arrays_of(mesh.data)->read(source));
  EXPECT_EQ(compare_soups(source, mesh.read()), 0);
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
  SourceTriangles source;
  EXPECT_FALSE(arrays_of(mesh.data)->read(source));
  MeshReader(mesh.data).read(source);
  EXPECT_EQ(compare_soups(source, mesh.read()), 0);
}

TEST_F(MeshArraysTest, AreNotReadBeyondTheLastVertex) {
  Strided<double> mesh;
  SourceTriangles source;
  ASSERT_TRUE(arrays_of(mesh.data)->read(source));
  const TriangleSoup soup = mesh.read();
  mesh.triangles[1].corner[2] = 4000000000u;
  EXPECT_FALSE(arrays_of(mesh.data)->give(soup));
  EXPECT_FALSE(arrays_of(mesh.data)->give(source));
  EXPECT_FALSE(arrays_of(mesh.data)->read(source));
}

}  // namespace
}  // namespace ode_ext::test
