// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/mesh_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "meshes/shapes.h"
#include "support/temporary_folder.h"

namespace falling_objects {
namespace {

class MeshFile : public testing::Test {
 protected:
  std::string write_file(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  static std::string message_of(const std::string& path) {
    try {
      load_mesh(path);
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "";
  }

 private:
  ode_ext::TemporaryFolder folder_{"mesh_file_test"};
};

// A unit cube of quads, as a modeller writes it, far from the origin.
constexpr const char* kCube =
    "v 10 0 0\nv 11 0 0\nv 11 1 0\nv 10 1 0\nv 10 0 1\nv 11 0 1\nv 11 1 1\nv 10 1 1\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

TEST_F(MeshFile, ReadsAnObjAsAClosedCentredMeshOfTheRightSize) {
  const TriangleMesh cube = load_mesh(write_file("cube.obj", kCube));
  EXPECT_EQ(cube.vertex_count(), 8u);
  EXPECT_EQ(cube.triangle_count(), 12u);
  EXPECT_TRUE(is_closed(cube));
  // A cube of bounding radius 0.5 has an edge of 1 / sqrt(3).
  EXPECT_NEAR(signed_volume(cube), 1 / (3 * std::sqrt(3.0)), 1e-6);
  for (const double x : centre(cube, true)) EXPECT_NEAR(x, 0, 1e-6);
  EXPECT_NEAR(bounding_radius(cube), kShapeRadius, 1e-6);
}

TEST_F(MeshFile, TurnsAClosedMeshThatIsInsideOut) {
  std::string inverted = kCube;
  for (const auto& [from, to] : {std::pair{"f 4 3 2 1", "f 1 2 3 4"},
                                 {"f 5 6 7 8", "f 8 7 6 5"},
                                 {"f 1 2 6 5", "f 5 6 2 1"},
                                 {"f 2 3 7 6", "f 6 7 3 2"},
                                 {"f 3 4 8 7", "f 7 8 4 3"},
                                 {"f 4 1 5 8", "f 8 5 1 4"}}) {
    inverted.replace(inverted.find(from), 9, to);
  }
  EXPECT_GT(signed_volume(load_mesh(write_file("inverted.obj", inverted))), 0.1);
}

TEST_F(MeshFile, WeldsTheLooseTrianglesOfAnStl) {
  const std::string stl =
      "solid t\n"
      "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 "
      "0\nendloop\nendfacet\n"
      "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 "
      "1\nendloop\nendfacet\n"
      "facet normal 0 0 0\nouter loop\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 "
      "1\nendloop\nendfacet\n"
      "facet normal 0 0 0\nouter loop\nvertex 0 1 0\nvertex 0 0 0\nvertex 0 0 "
      "1\nendloop\nendfacet\n"
      "endsolid t\n";
  const TriangleMesh mesh = load_mesh(write_file("tetrahedron.stl", stl));
  EXPECT_EQ(mesh.vertex_count(), 4u);
  EXPECT_TRUE(is_closed(mesh));
}

TEST_F(MeshFile, ReadsAPly) {
  const TriangleMesh mesh = load_mesh(write_file(
      "triangle.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"));
  EXPECT_EQ(mesh.triangle_count(), 1u);
  EXPECT_FALSE(is_closed(mesh));
}

TEST_F(MeshFile, NamesAFileThatCannotBeRead) {
  const std::string message = message_of("no_such_file.obj");
  EXPECT_NE(message.find("no_such_file.obj"), std::string::npos) << message;
  const std::string garbage = write_file("garbage.obj", "\x01\x02 nothing\n");
  EXPECT_NE(message_of(garbage).find("garbage.obj"), std::string::npos);
}

TEST_F(MeshFile, RefusesAMeshWithoutTriangles) {
  for (const char* text : {"", "v 0 0 0\n", "v 0 0 0\nv 1 0 0\nl 1 2\n"}) {
    const std::string path = write_file("empty.obj", text);
    EXPECT_NE(message_of(path).find("empty.obj"), std::string::npos) << text;
  }
}

// A tetrahedron in the corner at x, with edges of this length along the axes.
std::string tetrahedron(double edge, double x) {
  std::ostringstream text;
  text.precision(17);
  text << "v " << x << " 0 0\nv " << x + edge << " 0 0\nv " << x << ' ' << edge << " 0\nv " << x
       << " 0 " << edge << "\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  return text.str();
}

TEST_F(MeshFile, RefusesAMeshThatIsTooSmallOrTooFlatForAMass) {
  for (const std::string& text :
       {tetrahedron(1e-12, 0), tetrahedron(1e-20, 0), tetrahedron(1e-7, 5),
        std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.2 0.2 0\n"
                    "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")}) {
    const std::string path = write_file("small.obj", text);
    EXPECT_EQ(message_of(path), "the mesh '" + path + "' is too small or too flat to have a volume")
        << text;
  }
}

// One beside the other and inside out: each part is solid.
TEST_F(MeshFile, TurnsEachPartOutwards) {
  std::string text = tetrahedron(1, 0) + tetrahedron(0.9, 10);
  text.replace(text.rfind("f 1 3 2"), std::string::npos, "f 5 6 7\nf 5 8 6\nf 5 7 8\nf 6 8 7\n");
  const TriangleMesh mesh = read_mesh_file(write_file("two.obj", text));
  ASSERT_TRUE(is_closed(mesh));
  EXPECT_NEAR(signed_volume(mesh), (1 + 0.9 * 0.9 * 0.9) / 6, 1e-5);
}

// A cavity stays one, whichever way the whole is wound.
TEST_F(MeshFile, LeavesACavityThatIsInAPart) {
  const auto cube = [](double size, int first, bool inwards) {
    std::ostringstream text;
    for (int i = 0; i < 8; ++i) {
      text << 'v';
      for (int k = 0; k < 3; ++k) text << ' ' << (((i >> k) & 1) != 0 ? size : -size);
      text << '\n';
    }
    const int faces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                              {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    for (const auto& [a, b, c] : faces) {
      text << "f " << a + first << ' ' << (inwards ? c : b) + first << ' '
           << (inwards ? b : c) + first << '\n';
    }
    return text.str();
  };
  for (const bool turned : {false, true}) {
    const std::string path = write_file("hollow.obj", cube(1, 1, turned) + cube(0.5, 9, !turned));
    const TriangleMesh mesh = read_mesh_file(path);
    EXPECT_NEAR(signed_volume(mesh), 8 - 1, 1e-5) << turned;
  }
}

TEST_F(MeshFile, TakesAMeshThatIsSmallOrThinOrFarAway) {
  for (const std::string& text : {tetrahedron(1e-7, 0), tetrahedron(1, 1e5), tetrahedron(1e30, 0),
                                  std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.2 0.2 1e-5\n"
                                              "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")}) {
    const std::string path = write_file("small.obj", text);
    EXPECT_EQ(message_of(path), "") << text;
  }
}

}  // namespace
}  // namespace falling_objects
