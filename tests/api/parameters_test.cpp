// SPDX-License-Identifier: BSD-3-Clause
// Creating a collider: parameters, defaults, refusals.
#include <gmock/gmock.h>

#include <cstdlib>
#include <cstring>
#include <limits>
#include <thread>

#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(ApiParams, AreInitialisedToTheDocumentedDefaults) {
  dBatchColliderParams params;
  std::memset(&params, 0xAB, sizeof params);
  dBatchColliderParamsInit(&params);
  EXPECT_EQ(params.struct_size, sizeof params);
  EXPECT_EQ(params.device, nullptr);
  EXPECT_EQ(params.max_contacts, 16);
  EXPECT_EQ(params.workload, dBatchWorkloadPredicted);
  EXPECT_EQ(params.prediction, dBatchPredictionPairScaled);
  EXPECT_EQ(params.trust_meshes, 0);
  EXPECT_EQ(params.confidence, 1.2);
  EXPECT_EQ(params.open_thickness, 0);
  EXPECT_EQ(params.work_group_size, 0);
  EXPECT_EQ(params.initial_capacity, 0);
  EXPECT_EQ(params.rays, dBatchRaysFull);
  EXPECT_EQ(params.deformable_target, dBatchDeformableRefit);
  EXPECT_EQ(params.organization, dBatchOrganizationPipelined);
  EXPECT_EQ(params.misprediction, dBatchMispredictionRedo);
  EXPECT_EQ(params.max_contacts_deformable, 0);
  EXPECT_EQ(params.walk_limit, 0);
  EXPECT_EQ(params.displacement_limit, 0);
  EXPECT_EQ(params.count_work, 0);
  EXPECT_EQ(params.edges, dBatchEdgesOn);
  EXPECT_EQ(params.triangle_callbacks, 0);
}

TEST(ApiParams, InitIgnoresNull) { dBatchColliderParamsInit(nullptr); }

TEST(ApiCreate, TakesNullForDefaults) {
  OdeWorld world;
  const dBatchColliderID collider = dBatchColliderCreate(nullptr);
  EXPECT_NE(collider, nullptr) << last_error();
  dBatchColliderDestroy(collider);
}

struct BadParameter {
  const char* field;
  const char* what;
  BatchCollider::Change change;
};

class ApiCreateRefuses : public ::testing::TestWithParam<BadParameter> {};

TEST_P(ApiCreateRefuses, AParameterOutOfRangeAndNamesIt) {
  OdeWorld world;
  dBatchColliderParams params;
  dBatchColliderParamsInit(&params);
  GetParam().change(params);
  const dBatchColliderID collider = dBatchColliderCreate(&params);
  EXPECT_EQ(collider, nullptr);
  EXPECT_THAT(last_error(), HasSubstr(GetParam().field));
  dBatchColliderDestroy(collider);
}

using P = dBatchColliderParams;
const BadParameter kBadParameters[] = {
    {"struct_size", "Zero", [](P& p) { p.struct_size = 0; }},
    {"max_contacts", "Zero", [](P& p) { p.max_contacts = 0; }},
    {"max_contacts", "Negative", [](P& p) { p.max_contacts = -1; }},
    {"max_contacts", "TooMany", [](P& p) { p.max_contacts = 65; }},
    {"workload", "Unknown", [](P& p) { p.workload = 2; }},
    {"workload", "Negative", [](P& p) { p.workload = -1; }},
    {"prediction", "Unknown", [](P& p) { p.prediction = 2; }},
    {"prediction", "Negative", [](P& p) { p.prediction = -1; }},
    {"confidence", "Zero", [](P& p) { p.confidence = 0; }},
    {"confidence", "Negative", [](P& p) { p.confidence = -1; }},
    {"confidence", "Nan", [](P& p) { p.confidence = kNan; }},
    {"confidence", "Infinite", [](P& p) { p.confidence = kInfinity; }},
    {"open_thickness", "Negative", [](P& p) { p.open_thickness = -1; }},
    {"open_thickness", "Nan", [](P& p) { p.open_thickness = kNan; }},
    {"rays", "Unknown", [](P& p) { p.rays = 3; }},
    {"rays", "Negative", [](P& p) { p.rays = -1; }},
    {"deformable_target", "Unknown", [](P& p) { p.deformable_target = 2; }},
    {"organization", "Unknown", [](P& p) { p.organization = 2; }},
    {"misprediction", "Unknown", [](P& p) { p.misprediction = 3; }},
    {"max_contacts_deformable", "Negative", [](P& p) { p.max_contacts_deformable = -1; }},
    {"max_contacts_deformable", "TooMany", [](P& p) { p.max_contacts_deformable = 65; }},
    {"walk_limit", "Negative", [](P& p) { p.walk_limit = -1; }},
    {"displacement_limit", "Negative", [](P& p) { p.displacement_limit = -1; }},
    {"displacement_limit", "Nan", [](P& p) { p.displacement_limit = kNan; }},
    {"work_group_size", "Negative", [](P& p) { p.work_group_size = -1; }},
    {"work_group_size", "AboveEveryDevice", [](P& p) { p.work_group_size = 1 << 24; }},
    {"initial_capacity", "Negative", [](P& p) { p.initial_capacity = -1; }},
};

INSTANTIATE_TEST_SUITE_P(Each, ApiCreateRefuses, ::testing::ValuesIn(kBadParameters),
                         [](const auto& instance) {
                           return std::string(instance.param.field) + instance.param.what;
                         });

TEST(ApiCreate, TakesTheLimitsOfEveryParameter) {
  OdeWorld world;
  for (const int contacts : {1, 64}) {
    BatchCollider([&](P& p) { p.max_contacts = contacts; });
  }
  BatchCollider([](P& p) { p.workload = dBatchWorkloadExact; });
  BatchCollider([](P& p) { p.prediction = dBatchPredictionPlain; });
  BatchCollider([](P& p) { p.work_group_size = 1; });
  BatchCollider([](P& p) { p.initial_capacity = 1; });
}

TEST(ApiDestroy, IgnoresNull) { dBatchColliderDestroy(nullptr); }

TEST(ApiErrorMessage, IsEmptyInAThreadThatHadNoError) {
  dBatchColliderParams params{};  // not initialised: refused
  EXPECT_EQ(dBatchColliderCreate(&params), nullptr);
  EXPECT_NE(last_error(), "");
  std::string message = "unset";
  std::thread([&] { message = dBatchColliderGetLastErrorMessage(); }).join();
  EXPECT_EQ(message, "");
}

// A handle that was destroyed and one that never was: each function refuses both with a message.
class ApiRefusal : public ::testing::TestWithParam<bool> {
 protected:
  dBatchColliderID foreign() {
    if (GetParam()) return reinterpret_cast<dBatchColliderID>(&world);
    BatchCollider collider;
    const dBatchColliderID id = collider;
    collider.destroy();
    return id;
  }
  void TearDown() override { EXPECT_NE(last_error(), ""); }

  OdeWorld world;
};

INSTANTIATE_TEST_SUITE_P(Handle, ApiRefusal, ::testing::Bool(), [](const auto& instance) {
  return instance.param ? "ThatNeverWas" : "ThatWasDestroyed";
});

TEST_P(ApiRefusal, BySpaceCollide) {
  Collected collected;
  const dSpaceID space = world.space(SpaceKind::Simple);
  world.own(dCreateSphere(space, 1));
  world.own(dCreateSphere(space, 1));
  EXPECT_EQ(dBatchColliderSpaceCollide(foreign(), space, &collected, &collect), -1);
  EXPECT_TRUE(collected.order.empty());
}

TEST_P(ApiRefusal, BySpaceCollide2) {
  Collected collected;
  const dGeomID g1 = world.own(dCreateSphere(nullptr, 1)),
                g2 = world.own(dCreateSphere(nullptr, 1));
  EXPECT_EQ(dBatchColliderSpaceCollide2(foreign(), g1, g2, &collected, &collect), -1);
  EXPECT_TRUE(collected.order.empty());
}

TEST_P(ApiRefusal, ByCollidePairs) {
  const OdeMesh& mesh = world.mesh(make_cube(1));
  const dGeomID pair[] = {world.geom(mesh, {}), world.geom(mesh, at(0.5, 0, 0))};
  dContactGeom contact;
  EXPECT_EQ(dBatchColliderCollidePairs(foreign(), pair, 1, 1, &contact, sizeof contact, nullptr),
            -1);
}

TEST_P(ApiRefusal, ByGetStatus) { EXPECT_EQ(dBatchColliderGetStatus(foreign()), -1); }

TEST_P(ApiRefusal, ByGetCount) {
  EXPECT_EQ(dBatchColliderGetCount(foreign(), dBatchCounterPasses), -1);
}

TEST_P(ApiRefusal, ByGetTime) { EXPECT_EQ(dBatchColliderGetTime(foreign(), dBatchStagePass), -1); }

TEST_P(ApiRefusal, ByGetDeviceName) { EXPECT_EQ(dBatchColliderGetDeviceName(foreign()), nullptr); }

TEST_P(ApiRefusal, ByTriMeshDataUpdate) {
  dBatchColliderTriMeshDataUpdate(foreign(), world.mesh(make_cube(1)).id());
}

TEST_P(ApiRefusal, ByTriMeshDataSetDeformable) {
  dBatchColliderTriMeshDataSetDeformable(foreign(), world.mesh(make_cube(1)).id(), 1);
}

TEST_P(ApiRefusal, ByTriMeshDataDestroyed) {
  dBatchColliderTriMeshDataDestroyed(foreign(), world.mesh(make_cube(1)).id());
}

TEST_P(ApiRefusal, ByDestroy) { dBatchColliderDestroy(foreign()); }

}  // namespace
}  // namespace ode_ext::test
