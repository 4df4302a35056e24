// SPDX-License-Identifier: BSD-3-Clause
// Creating a collider: parameters, defaults, refusals.
#include <gmock/gmock.h>

#include <cstdlib>
#include <cstring>
#include <limits>
#include <sstream>
#include <thread>

#include "ode/config.h"
#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

using ::testing::HasSubstr;

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

TEST(ApiParams, AreInitialisedToTheDocumentedDefaults) {
  dBatchColliderParams params;
  std::memset(&params, 0xAB, sizeof params);
  dBatchColliderParamsInit(&params);
  EXPECT_EQ(params.struct_size, sizeof params);
  EXPECT_EQ(params.device, nullptr);
  EXPECT_EQ(params.max_contacts, 16);
  EXPECT_EQ(params.max_contacts_deformable, 0);
  EXPECT_EQ(params.open_thickness, 0);
  EXPECT_EQ(params.trust_meshes, 0);
  EXPECT_EQ(params.triangle_callbacks, 0);
  EXPECT_EQ(params.config, nullptr);
}

TEST(ApiParams, RefuseANegativeTrust) {
  dBatchColliderParams params;
  dBatchColliderParamsInit(&params);
  params.trust_meshes = -1;
  EXPECT_EQ(dBatchColliderCreate(&params), nullptr);
  EXPECT_THAT(dBatchColliderGetLastErrorMessage(), HasSubstr("trust_meshes is -1"));
}

TEST(ApiParams, InitWritesNothingBeyondTheSizeItIsGiven) {
  struct {
    dBatchColliderParams params;
    unsigned char behind[64];
  } memory;
  std::memset(&memory, 0xAB, sizeof memory);
  constexpr std::size_t kOlder = offsetof(dBatchColliderParams, open_thickness);
  dBatchColliderParamsInitSize(&memory.params, kOlder);
  EXPECT_EQ(memory.params.struct_size, kOlder);
  EXPECT_EQ(memory.params.max_contacts, 16);
  for (std::size_t i = kOlder; i < sizeof memory; ++i)
    ASSERT_EQ(reinterpret_cast<const unsigned char*>(&memory)[i], 0xAB) << i;
  constexpr std::size_t kLater = sizeof(dBatchColliderParams) + 8;
  dBatchColliderParamsInitSize(&memory.params, kLater);
  EXPECT_EQ(memory.params.struct_size, kLater);
  EXPECT_EQ(memory.behind[7], 0);
  EXPECT_EQ(memory.behind[8], 0xAB);
  // A collider of this version cannot know what a later struct asks for.
  EXPECT_EQ(dBatchColliderCreate(&memory.params), nullptr);
  EXPECT_THAT(last_error(), HasSubstr("struct_size"));
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
    {"max_contacts_deformable", "Negative", [](P& p) { p.max_contacts_deformable = -1; }},
    {"max_contacts_deformable", "TooMany", [](P& p) { p.max_contacts_deformable = 65; }},
    {"open_thickness", "Negative", [](P& p) { p.open_thickness = -1; }},
    {"open_thickness", "Nan", [](P& p) { p.open_thickness = kNoNumber; }},
#ifdef dDOUBLE
    {"open_thickness", "BeyondAFloat", [](P& p) { p.open_thickness = 1e300; }},
    {"open_thickness", "BelowAFloat", [](P& p) { p.open_thickness = 1e-60; }},
#endif
    {"rays", "Unknown", with("rays=fast")},
    {"edges", "Empty", with("edges=")},
    {"workload", "InCapitals", with("workload=Exact")},
    {"prediction", "AsANumber", with("prediction=1")},
    {"organization", "TwoOfThem", with("organization=pipelined|monolithic")},
    {"deformable_target", "WithoutValue", with("deformable_target")},
    {"misprediction", "Unknown", with("misprediction=panic")},
    {"count_work", "AsANumber", with("count_work=1")},
    {"confidence", "Zero", with("confidence=0")},
    {"confidence", "Negative", with("confidence=-1")},
    {"confidence", "Nan", with("confidence=nan")},
    {"confidence", "Infinite", with("confidence=inf")},
    {"confidence", "TooLarge", with("confidence=1e999")},
    {"confidence", "FollowedByText", with("confidence=1.2x")},
    {"displacement_limit", "Zero", with("displacement_limit=0")},
    {"displacement_limit", "Nan", with("displacement_limit=nan")},
    {"walk_limit", "Negative", with("walk_limit=-1")},
    {"walk_limit", "Zero", with("walk_limit=0")},
    {"work_group_size", "Zero", with("work_group_size=0")},
    {"work_group_size", "AboveEveryDevice", with("work_group_size=16777216")},
    {"initial_capacity", "Zero", with("initial_capacity=0")},
    {"initial_capacity", "TooLarge", with("initial_capacity=2147483648")},
    {"initial_capacity", "AsAFraction", with("initial_capacity=1.5")},
    {"speed", "NotASetting", with("rays=full,speed=11")},
    {"rays", "Twice", with("rays=full,rays=full")},
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
  for (const char* config : {"", " , ", "work_group_size=1", "initial_capacity=1"}) {
    BatchCollider collider(with(config));
  }
}

TEST(ApiCreate, TakesBlanksAroundSettings) {
  OdeWorld world;
  const BatchCollider collider(with(" rays = iterative , organization=monolithic, "));
}

TEST(ApiConfig, ListsSettingsWhoseEveryWordAndDefaultIsTaken) {
  int count = 0;
  for (; dBatchConfigName(count) != nullptr; ++count) {
    const std::string name = dBatchConfigName(count), values = dBatchConfigValues(count);
    SCOPED_TRACE(name);
    EXPECT_EQ(dBatchConfigCheck((name + "=" + dBatchConfigDefault(count)).c_str()), 0);
    EXPECT_STRNE(dBatchConfigMeaning(count), "");
    if (values.find('|') == std::string::npos) continue;
    std::istringstream words(values);
    for (std::string word; std::getline(words, word, '|');)
      EXPECT_EQ(dBatchConfigCheck((name + "=" + word).c_str()), 0) << word;
  }
  EXPECT_EQ(count, 13);
  for (const int index : {-1, count, 1 << 30}) {
    EXPECT_EQ(dBatchConfigName(index), nullptr);
    EXPECT_EQ(dBatchConfigValues(index), nullptr);
    EXPECT_EQ(dBatchConfigDefault(index), nullptr);
    EXPECT_EQ(dBatchConfigMeaning(index), nullptr);
  }
}

TEST(ApiConfig, IsTheDefaultWhereItSaysTheDefaults) {
  std::string config;
  for (int i = 0; dBatchConfigName(i) != nullptr; ++i)
    config += std::string(dBatchConfigName(i)) + "=" + dBatchConfigDefault(i) + ",";
  ColliderOptions written;
  apply_config(config, written);
  const ColliderOptions untouched;
  EXPECT_EQ(written.rays, untouched.rays);
  EXPECT_EQ(written.edges, untouched.edges);
  EXPECT_EQ(written.organization, untouched.organization);
  EXPECT_EQ(written.deformable_target, untouched.deformable_target);
  EXPECT_EQ(written.launches, untouched.launches);
  EXPECT_EQ(written.prediction, untouched.prediction);
  EXPECT_EQ(written.confidence, untouched.confidence);
  EXPECT_EQ(written.misprediction, untouched.misprediction);
  EXPECT_EQ(written.initial_capacity, untouched.initial_capacity);
  EXPECT_EQ(written.work_group_size, untouched.work_group_size);
  EXPECT_EQ(written.walk_limit, untouched.walk_limit);
  EXPECT_EQ(written.displacement_limit, untouched.displacement_limit);
  EXPECT_EQ(written.count_work, untouched.count_work);
}

TEST(ApiConfig, SetsWhatItNames) {
  ColliderOptions options;
  apply_config(
      "rays=iterative-paper,edges=off,organization=monolithic,deformable_target=basic,"
      "workload=exact,prediction=plain,confidence=1.02,misprediction=backtrack,"
      "initial_capacity=7,work_group_size=32,walk_limit=9,displacement_limit=0.5,count_work=on",
      options);
  EXPECT_EQ(options.rays, Rays::kIterativePaper);
  EXPECT_FALSE(options.edges);
  EXPECT_EQ(options.organization, Organization::kMonolithic);
  EXPECT_EQ(options.deformable_target, DeformableTarget::kBasic);
  EXPECT_EQ(options.launches, LaunchRule::kExact);
  EXPECT_EQ(options.prediction, PredictionRule::kPlain);
  EXPECT_EQ(options.confidence, 1.02);
  EXPECT_EQ(options.misprediction, Misprediction::kBacktrack);
  EXPECT_EQ(options.initial_capacity, 7u);
  EXPECT_EQ(options.work_group_size, 32u);
  EXPECT_EQ(options.walk_limit, 9u);
  EXPECT_EQ(options.displacement_limit, 0.5f);
  EXPECT_TRUE(options.count_work);
}

TEST(ApiConfig, ThatIsRefusedSaysWhatThereIs) {
  EXPECT_EQ(dBatchConfigCheck("ray=full"), -1);
  EXPECT_THAT(last_error(), HasSubstr("nothing is called 'ray'; there are rays, edges,"));
  EXPECT_EQ(dBatchConfigCheck("rays=fast"), -1);
  EXPECT_THAT(last_error(), HasSubstr("rays is 'fast', expected full|iterative|iterative-paper"));
  EXPECT_EQ(dBatchConfigCheck(nullptr), -1);
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
