// SPDX-License-Identifier: BSD-3-Clause
// What a scene file says is read, and what is wrong in one is said with its file and line.
#include "scene_file/scene_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "support/temporary_folder.h"

namespace falling_objects {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kTetrahedron =
    "v 1 0 0\nv 5 0 0\nv 1 4 0\nv 1 0 4\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

SceneDescription read(const std::string& text) { return read_scene(text, "my.toml"); }

TEST(SceneFile, SaysWhereBodiesAreAndHowTheyMove) {
  const SceneDescription scene = read(R"(
    title = "one cube"
    hz = 120
    [world]
    gravity = [0, 0, -1.6]
    [mesh.die]
    shape = "cube"
    size = 0.5
    [[body]]
    mesh = "die"
    at = [1, 2, 3]
    turn = [0, 0, 1, 90]
    velocity = [4, 0, 0]
    motion = "driven")");
  EXPECT_EQ(scene.title, "one cube");
  EXPECT_EQ(scene.hz, 120);
  EXPECT_EQ(scene.world.gravity[2], -1.6);
  ASSERT_EQ(scene.bodies.size(), 1u);
  const BodyDescription& body = scene.bodies[0];
  EXPECT_EQ(body.name, "die");
  EXPECT_THAT(body.position, ElementsAre(1, 2, 3));
  EXPECT_NEAR(body.rotation[3], std::sin(std::numbers::pi / 4), 1e-15);
  EXPECT_EQ(body.velocity[0], 4);
  EXPECT_EQ(body.motion, Motion::kDriven);
  EXPECT_NEAR(bounding_radius(scene.meshes[body.mesh].mesh), 0.25 * std::sqrt(3), 1e-7);
}

TEST(SceneFile, PlacesMeshesByTheirOwnOriginThoughBodiesAreAtTheirCenterOfMass) {
  const SceneDescription scene = read(R"(
    [mesh.cup]
    shape = "cup"
    [[body]]
    mesh = "cup"
    at = [0, 0, 5]
    turn = [1, 0, 0, 180])");
  // The middle of a cup is empty: its center of mass is below it, and above it once it is turned.
  EXPECT_GT(scene.bodies[0].position[2], 5.05);
  double lowest = INFINITY;
  const TriangleMesh& mesh = scene.meshes[0].mesh;
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i)
    lowest = std::min(lowest, scene.bodies[0].position[2] - mesh.vertex(i)[2]);
  EXPECT_NEAR(lowest, 4.5, 1e-6);
}

// Of which squares are 0 or infinite; ODE aborts where a rotation is none.
TEST(SceneFile, TurnsAboutAxesOfAnyLength) {
  for (const std::string turn :
       {"[0, 0, 1e-320, 90]", "[0, 0, 1e300, 90]", "[0, 0, 3, 90]", "[0, 0, 1, 36000000090]"}) {
    const SceneDescription scene = read("[[body]]\nmesh = \"cube\"\nturn = " + turn);
    const Quaternion& q = scene.bodies[0].rotation;
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(q[k], k == 0 || k == 3 ? std::sqrt(0.5) : 0, 1e-6) << turn << ", " << k;
  }
}

TEST(SceneFile, LaysOutGridsAndPyramids) {
  const SceneDescription grid = read(R"(
    [[body]]
    mesh = "cube"
    at = [0, 0, 1]
    count = [2, 1, 3]
    spacing = [4, 4, 2])");
  ASSERT_EQ(grid.bodies.size(), 6u);
  EXPECT_EQ(grid.bodies[0].name, "cube 1");
  EXPECT_THAT(grid.bodies[0].position, ElementsAre(-2, 0, 1));
  EXPECT_THAT(grid.bodies[5].position, ElementsAre(2, 0, 5));
  const SceneDescription pyramid = read("[[body]]\nmesh = \"cube\"\npyramid = 4\n");
  ASSERT_EQ(pyramid.bodies.size(), 10u);
  EXPECT_THAT(pyramid.bodies[9].position, ElementsAre(DoubleNear(0, 1e-15), 0, 3));
}

TEST(SceneFile, JittersAlikeInEveryRun) {
  const char* text = "[[body]]\nmesh = \"rock\"\ncount = [3, 3, 1]\njitter = 0.3\ntumble = true\n";
  const SceneDescription one = read(text), other = read(text);
  EXPECT_NE(one.bodies[0].position[2], one.bodies[1].position[2]);
  for (std::size_t i = 0; i < one.bodies.size(); ++i) {
    EXPECT_EQ(one.bodies[i].position, other.bodies[i].position);
    EXPECT_EQ(one.bodies[i].rotation, other.bodies[i].rotation);
  }
}

TEST(SceneFile, JoinsBodiesByName) {
  const SceneDescription scene = read(R"(
    [[body]]
    name = "wheel"
    mesh = "spur-gear"
    at = [0, 0, 2]
    [[joint]]
    body = "wheel"
    axis = [0, 1, 0]
    motor = { speed = 3, force = 50 })");
  ASSERT_EQ(scene.joints.size(), 1u);
  EXPECT_EQ(scene.joints[0].kind, JointDescription::Kind::kHinge);
  EXPECT_EQ(scene.joints[0].anchor, scene.bodies[0].position);
  EXPECT_EQ(scene.joints[0].motor->speed, 3);
}

TEST(SceneFile, DropsMeshesInTheOrderInWhichTheyAreNamed) {
  const SceneDescription scene = read(R"(
    [mesh.b]
    shape = "sphere"
    radius = 0.3
    [mesh.unused]
    shape = "plate"
    [drop]
    objects = 7
    meshes = ["jack", "b"])");
  EXPECT_EQ(scene.drop->objects, 7);
  ASSERT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(scene.meshes[0].name, "jack");
  EXPECT_EQ(scene.meshes[1].name, "b");
}

TEST(SceneFile, FindsFilesOfMeshesBesideItself) {
  const ode_ext::TemporaryFolder folder("scene_file_test");
  std::ofstream(folder / "a.obj") << kTetrahedron;
  const auto radius = [&](const std::string& size) {
    const SceneDescription scene = read_scene(
        "[mesh.part]\nfile = \"a.obj\"\n" + size + "\n[[body]]\nmesh = \"part\"\nat = [0, 0, 7]\n",
        folder / "my.toml");
    EXPECT_EQ(scene.meshes[0].mesh.triangle_count(), 4u);
    EXPECT_EQ(scene.bodies[0].position[2], 7);  // a file's mesh is placed by its middle
    return bounding_radius(scene.meshes[0].mesh);
  };
  const double as_it_is = std::sqrt(9.0 + 1 + 1);
  EXPECT_NEAR(radius(""), as_it_is, 1e-6);
  EXPECT_NEAR(radius("scale = 0.01"), 0.01 * as_it_is, 1e-6);
  EXPECT_NEAR(radius("radius = 0.4"), 0.4, 1e-6);
}

TEST(SceneFile, IsReadAsTheDocumentationShowsIt) {
  std::ifstream file(ODE_EXT_SOURCE_DIR "/docs/scenes.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}}, opening = "```toml\n";
  const std::size_t start = page.find(opening) + opening.size();
  const ode_ext::TemporaryFolder folder("scene_file_test");
  std::ofstream(folder / "part.obj") << kTetrahedron;
  const SceneDescription scene =
      read_scene(page.substr(start, page.find("```", start) - start), folder / "my.toml");
  EXPECT_EQ(scene.bodies.size(), 3u);
  EXPECT_EQ(scene.meshes[scene.bodies[1].mesh].name, "die");
}

struct Wrong {
  const char* text;
  const char* begins;  // the message, after the file's name
  const char* says;
};

class WrongSceneFile : public testing::TestWithParam<Wrong> {};
INSTANTIATE_TEST_SUITE_P(
    All, WrongSceneFile,
    testing::Values(
        Wrong{"", "1: ", "needs [[body]] or [drop]"}, Wrong{"steps = 60\nhz = = 3\n", "2: ", ""},
        Wrong{
            "stepz = 60\n[[body]]\nmesh = \"cube\"\n", "1: ",
            "a scene knows no 'stepz', only body, camera, contact, drop, expect, hz, joint, mesh, "
            "steps, title, world"},
        Wrong{"hz = \"fast\"\n", "1: ", "'hz' must be a number from 1e-06 to 1e+06"},
        Wrong{"hz = nan\n", "1: ", "'hz' must be a number"},
        Wrong{"steps = 0\n", "1: ", "'steps' must be a whole number from 1"},
        Wrong{"\n[[body]]\nat = [0, 0, 0]\n", "2: ", "[[body]] needs 'mesh'"},
        Wrong{"[[body]]\nmesh = \"cub\"\n", "2: ",
              "there is no mesh 'cub'; the file has none, and every shape is one: cube, box"},
        Wrong{"[[body]]\nmesh = \"cube\"\nat = [1, 2]\n",
              "3: ", "'at' must be 3 numbers in brackets"},
        Wrong{"[[body]]\nmesh = \"cube\"\nat = [1, 2, \"3\"]\n", "3: ", "'at' must be 3 numbers"},
        Wrong{"[[body]]\nmesh = \"cube\"\nturn = [0, 0, 0, 90]\n", "3: ", "must have a length"},
        Wrong{"[[body]]\nmesh = \"cube\"\nmotion = \"stuck\"\n",
              "3: ", "'motion' is 'stuck', expected one of free, fixed, driven"},
        Wrong{"[[body]]\nmesh = \"cube\"\ncount = [2, 0, 1]\n",
              "3: ", "'count' must be three whole"},
        Wrong{"[[body]]\nmesh = \"cube\"\ncount = [1000, 1000, 1000]\n",
              "3: ", "'count' makes 1000000000 bodies, at most 1000000"},
        Wrong{"[[body]]\nmesh = \"cube\"\ncount = [1, 1e6, 2]\n",
              "3: ", "'count' makes 2000000 bodies, at most 1000000"},
        Wrong{"[[body]]\nmesh = \"cube\"\ntumble = 1\n", "3: ", "'tumble' must be true or false"},
        Wrong{"[mesh.a]\nshape = \"cub\"\n", "2: ", "'cub' is no shape; there are cube, box"},
        Wrong{"[mesh.a]\nshape = \"cube\"\nsides = 3\n",
              "3: ", "[mesh.a] knows no 'sides', only cells, file, shape, size"},
        Wrong{"[mesh.a]\nshape = \"cube\"\ncells = 1.5\n", "3: ", "'cells' must be a whole number"},
        Wrong{"[mesh.a]\nshape = \"torus\"\nring = 0.1\ntube = 0.2\n",
              "1: ", "a torus: 'ring' must be larger than 'tube'"},
        Wrong{"[mesh.a]\nfile = \"none.obj\"\n", "2: ", "cannot read the mesh"},
        Wrong{"[[body]]\nmesh = \"cube\"\n[[joint]]\nbody = \"cub\"\n",
              "4: ", "there is no body 'cub'; there are cube"},
        Wrong{"[[body]]\nmesh = \"cube\"\n[[body]]\nmesh = \"cube\"\n[[joint]]\nbody = \"cube\"\n",
              "6: ", "2 bodies are named 'cube': give each [[body]] a 'name' of its own"},
        Wrong{"[[body]]\nmesh = \"cube\"\n[[joint]]\nbody = \"cube\"\nother = \"cube\"\n",
              "5: ", "a body is not joined to itself"},
        Wrong{"[camera]\neye = [0, 0, 0]\n[[body]]\nmesh = \"cube\"\n",
              "2: ", "'eye' and 'target' must be two places"},
        Wrong{"[[body]]\nmesh = \"cube\"\nspin = [0, 0, 1e160]\n",
              "3: ", "'spin' must not be beyond 1e+09"},
        Wrong{"[mesh.a]\nshape = \"shell\"\nouter = 0.5\ninner = 0.4999999999\n",
              "2: ", "the mesh 'a' is too small or too flat to have a volume"},
        Wrong{"[[body]]\nmesh = \"cube\"\ncount = [2, 1, 1]\n[[body]]\nmesh = \"cube\"\n"
              "count = [2, 1, 1]\n[[expect]]\nkind = \"still\"\nbody = \"cube\"\nspeed = 1\n",
              "9: ", "2 bodies are named 'cube 1': give each [[body]] a 'name' of its own"},
        Wrong{"[[body]]\nmesh = \"cube\"\ncount = [2, 1, 1]\n[[body]]\nmesh = \"cube\"\n"
              "[[expect]]\nkind = \"still\"\nbody = \"cube\"\nspeed = 1\n",
              "8: ", "one body is named 'cube', and others 'cube 1' to 'cube 2'"},
        Wrong{"[[body]]\nmesh = \"cube\"\n[[expect]]\nkind = \"luck\"\n", "4: ",
              "'kind' is 'luck', expected one of ratio, screw, still, stays, moves, above, apart"},
        Wrong{"[[body]]\nmesh = \"cube\"\n[[expect]]\nkind = \"stays\"\ndistance = 1\n"
              "after = 2\nuntil = 1\n",
              "7: ", "'until' must be later than 'after'"},
        Wrong{"[[body]]\nmesh = \"cube\"\nmotion = \"fixed\"\n[[expect]]\nkind = \"above\"\n"
              "height = 0\n",
              "5: ", "no body of the scene is free: nothing can be expected of what cannot move"},
        Wrong{"[[body]]\nmesh = \"cube\"\n[[body]]\nname = \"wall\"\nmesh = \"cube\"\n"
              "motion = \"fixed\"\n[[expect]]\nkind = \"stays\"\nbody = \"wall\"\ndistance = 1\n",
              "9: ", "'wall' is fixed: nothing can be expected of what cannot move"},
        Wrong{"[[body]]\nmesh = \"cube\"\n[[body]]\nname = \"wall\"\nmesh = \"cube\"\n"
              "motion = \"fixed\"\n[[expect]]\nkind = \"ratio\"\nbody = \"cube\"\n"
              "other = \"wall\"\nratio = 2\n",
              "10: ", "'wall' is fixed: nothing turns in a ratio to what cannot move"},
        Wrong{"[[body]]\nmesh = \"cube\"\n[[expect]]\nkind = \"screw\"\nbody = \"cube\"\n"
              "pitch = 0\n",
              "6: ", "'pitch' must not be 0"},
        Wrong{"[drop]\nobjects = 3\nmeshes = []\n", "3: ", "'meshes' must be texts in brackets"},
        Wrong{"[drop]\nmeshes = [\"plate\"]\n", "1: ", "must fit into a ball of radius 0.5"},
        Wrong{"[[body]]\nmesh = \"cube\"\n[drop]\nmeshes = [\"jack\"]\n", "3: ", "not both"}));

TEST_P(WrongSceneFile, IsRefusedWithItsLineAndWhatWasExpected) {
  try {
    read(GetParam().text);
    FAIL() << GetParam().text;
  } catch (const SceneFileError& e) {
    EXPECT_THAT(e.what(), AllOf(StartsWith(std::string("my.toml:") + GetParam().begins),
                                HasSubstr(GetParam().says)));
  }
}

TEST(SceneFile, ThatDoesNotExistIsAnErrorThatNamesThoseThatDo) {
  try {
    find_scene_file("soft");
    FAIL();
  } catch (const SceneFileError& e) {
    EXPECT_THAT(e.what(), AllOf(HasSubstr("no scene 'soft'"), HasSubstr("rigid-deformable, ")));
  }
  EXPECT_THROW(read_scene_file("/no/such/file.toml"), SceneFileError);
}

TEST(SceneFile, IsFoundByTheNameOfAScene) {
  EXPECT_THAT(scene_names(), Contains("nut-on-bolt"));
  EXPECT_THAT(find_scene_file("nut-on-bolt"), testing::EndsWith("nut-on-bolt.toml"));
  EXPECT_EQ(find_scene_file("mine.toml"), "mine.toml");
}

}  // namespace
}  // namespace falling_objects
