// SPDX-License-Identifier: BSD-3-Clause
// The scenes that come with the program are read, and run.
#include <gtest/gtest.h>

#include <fstream>

#include "judging/penetration.h"
#include "scene_file/scene_file.h"
#include "scene_file/user_meshes.h"
#include "simulation/simulation.h"
#include "support/temporary_folder.h"

namespace falling_objects {
namespace {

class Scenes : public testing::TestWithParam<std::string> {
 protected:
  static void SetUpTestSuite() { dInitODE2(0); }
  static void TearDownTestSuite() { dCloseODE(); }
};
INSTANTIATE_TEST_SUITE_P(All, Scenes, testing::ValuesIn(scene_names()), [](const auto& test) {
  std::string name = test.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST_P(Scenes, AreReadAndRunForAFewStepsWithNothingThroughAnother) {
  SceneDescription description = read_scene_file(find_scene_file(GetParam()));
  EXPECT_FALSE(description.title.empty());
  EXPECT_TRUE(description.camera);
  if (description.drop) description.drop = Drop{20, description.drop->sheets > 0 ? 1 : 0};
  std::vector<std::string> warnings;
  SimulationSettings options;
  options.hz = description.hz;
  options.sheets = description.drop ? description.drop->sheets : 0;
  Scene scene(description, 1, warnings);
  EXPECT_TRUE(warnings.empty());
  Collision collision(options, scene.space());
  std::unique_ptr<Sheets> sheets;
  if (options.sheets > 0) {
    sheets = std::make_unique<Sheets>(1, 1, scene);
    sheets->introduce(collision.batch());
  }
  Simulation simulation(options, scene, collision, sheets.get());
  const PenetrationMeter meter(scene);
  const double at_the_start = meter.measure().deepest;
  for (int i = 0; i < 5; ++i) EXPECT_EQ(simulation.step().status & dBatchStatusDeviceFailed, 0u);
  EXPECT_LT(meter.measure().deepest, at_the_start + 0.01);
  for (const Object& object : scene.objects()) {
    const dReal* p = dBodyGetPosition(object.body);
    EXPECT_TRUE(std::isfinite(p[0] + p[1] + p[2]));
  }
}

class SceneBodies : public testing::Test {
 protected:
  static void SetUpTestSuite() { dInitODE2(0); }
  static void TearDownTestSuite() { dCloseODE(); }
  static SceneDescription read(const std::string& text) { return read_scene(text, "test.toml"); }
  std::vector<std::string> warnings_;
};

TEST_F(SceneBodies, MoveAsTheirMotionSays) {
  Scene scene(read(R"(
    [[body]]
    mesh = "cube"
    [[body]]
    mesh = "cube"
    at = [5, 0, 0]
    velocity = [1, 0, 0]
    motion = "fixed"
    [[body]]
    mesh = "cube"
    at = [0, 5, 0]
    velocity = [1, 0, 0]
    motion = "driven")"),
              1, warnings_);
  SimulationSettings options;
  options.collider = Collider::kOde;
  Collision collision(options, scene.space());
  Simulation simulation(options, scene, collision, nullptr);
  for (int i = 0; i < 60; ++i) simulation.step();
  const auto at = [&](std::size_t i, int k) {
    return static_cast<double>(dBodyGetPosition(scene.objects()[i].body)[k]);
  };
  EXPECT_LT(at(0, 2), -1);
  EXPECT_EQ(at(1, 0), 5);
  EXPECT_EQ(at(1, 2), 0);
  EXPECT_NEAR(at(2, 0), 1, 1e-9);
  EXPECT_EQ(at(2, 2), 0);
}

TEST_F(SceneBodies, WeighWhatTheirDensityAndVolumeAre) {
  Scene scene(read("[[body]]\nmesh = \"cube\"\ndensity = 700\n"), 1, warnings_);
  dMass mass;
  dBodyGetMass(scene.objects()[0].body, &mass);
  EXPECT_NEAR(mass.mass, 700, 1e-3);
  EXPECT_NEAR(mass.I[0], 700.0 / 6, 1e-3);
}

TEST_F(SceneBodies, RubWithTheSmallerOfTheirFrictions) {
  Scene scene(read(R"(
    [contact]
    mu = 0.4
    [[body]]
    mesh = "cube"
    mu = 0.1
    [[body]]
    mesh = "cube"
    mu = 0.9
    [[body]]
    mesh = "cube")"),
              1, warnings_);
  EXPECT_EQ(scene.mu_between(0, 1), 0.1);
  EXPECT_EQ(scene.mu_between(1, 2), 0.4);
}

TEST_F(SceneBodies, TurnWithTheMotorOfTheirHinge) {
  Scene scene(read(R"(
    [[body]]
    mesh = "spur-gear"
    [[joint]]
    body = "spur-gear"
    motor = { speed = 2 })"),
              1, warnings_);
  SimulationSettings options;
  options.collider = Collider::kOde;
  Collision collision(options, scene.space());
  Simulation simulation(options, scene, collision, nullptr);
  for (int i = 0; i < 10; ++i) simulation.step();
  // Damping takes 2 % after every step.
  EXPECT_NEAR(dBodyGetAngularVel(scene.objects()[0].body)[2], 2, 0.05);
  EXPECT_NEAR(dBodyGetPosition(scene.objects()[0].body)[2], 0, 0.01);
}

class UserMeshes : public SceneBodies {
 protected:
  UserMeshes() {
    std::ofstream(path_) << "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\n"
                            "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  }
  ode_ext::TemporaryFolder folder_{"user_meshes_test"};
  std::string path_ = folder_ / "a.obj";
};

TEST_F(UserMeshes, TakeThePlaceAndSizeOfTheMeshThatCanMove) {
  SceneDescription scene = read(
      "[mesh.floor]\nshape = \"plate\"\n[[body]]\nmesh = \"floor\"\nmotion = \"fixed\"\n"
      "[[body]]\nmesh = \"sphere\"\n");
  use_meshes(scene, {path_});
  const TriangleMesh& mesh = scene.meshes[scene.bodies[1].mesh].mesh;
  EXPECT_EQ(mesh.triangle_count(), 4u);
  EXPECT_NEAR(bounding_radius(mesh), 0.5, 1e-6);
  use_meshes(scene, {"floor=" + path_});
  EXPECT_EQ(scene.meshes[scene.bodies[0].mesh].mesh.triangle_count(), 4u);
}

TEST_F(UserMeshes, NeedANameWhereSeveralCanMove) {
  SceneDescription scene = read("[[body]]\nmesh = \"sphere\"\n[[body]]\nmesh = \"cube\"\n");
  try {
    use_meshes(scene, {path_});
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(),
                 "--mesh: write NAME=FILE with one of the meshes of the scene: sphere, cube");
  }
  use_meshes(scene, {"cube=" + path_});
  EXPECT_EQ(scene.meshes[1].mesh.triangle_count(), 4u);
}

TEST_F(UserMeshes, AreWhatIsDroppedWhereObjectsAre) {
  SceneDescription scene = read("[drop]\nmeshes = [\"jack\", \"gear\"]\n");
  use_meshes(scene, {path_});
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].name, path_);
}

}  // namespace
}  // namespace falling_objects
