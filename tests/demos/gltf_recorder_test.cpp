// SPDX-License-Identifier: BSD-3-Clause
// What a recording says when it is read again, by Assimp, which has code of its own for it.
#include "record/gltf_recorder.h"

#include <assimp/scene.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <map>

#include "scene_file/scene_file.h"
#include "support/temporary_folder.h"

namespace falling_objects {
namespace {

constexpr double kPoseFloat = 1e-6;  // poses are floats, of a few meters

class GltfRecording : public testing::Test {
 protected:
  static void SetUpTestSuite() { dInitODE2(0); }
  static void TearDownTestSuite() { dCloseODE(); }

  static void put(dBodyID body, const std::array<double, 3>& p, const dQuaternion q) {
    dBodySetPosition(body, p[0], p[1], p[2]);
    dBodySetQuaternion(body, q);
  }
  const aiScene* write_and_read(const GltfRecorder& recorder) {
    recorder.write(path_);
    const aiScene* read = importer_.ReadFile(path_, 0);
    EXPECT_NE(read, nullptr) << importer_.GetErrorString();
    return read;
  }
  static std::map<std::string, const aiNodeAnim*> channels_of(const aiScene& read) {
    std::map<std::string, const aiNodeAnim*> channels;
    for (unsigned i = 0; read.mNumAnimations > 0 && i < read.mAnimations[0]->mNumChannels; ++i) {
      const aiNodeAnim* channel = read.mAnimations[0]->mChannels[i];
      channels[channel->mNodeName.C_Str()] = channel;
    }
    return channels;
  }

  std::vector<std::string> warnings_;
  Scene scene_{read_scene(R"(
    [[body]]
    mesh = "plate"
    motion = "fixed"
    [[body]]
    name = "one"
    mesh = "cup"
    at = [0, 0, 1]
    [[body]]
    name = "other"
    mesh = "cup"
    at = [3, 0, 1])",
                          "test.toml"),
               1, warnings_};
  ode_ext::TemporaryFolder folder_{"gltf_recorder_test"};
  std::string path_ = folder_ / "a.glb";
  Assimp::Importer importer_;
};

TEST_F(GltfRecording, HasANodeForEveryObjectAndAMeshForEveryShape) {
  GltfRecorder recorder(scene_);
  recorder.record(0);
  const aiScene* read = write_and_read(recorder);
  ASSERT_NE(read, nullptr);
  ASSERT_EQ(read->mNumMeshes, 2u);
  EXPECT_EQ(read->mMeshes[0]->mNumFaces, scene_.shapes()[0].mesh.triangle_count());
  EXPECT_EQ(read->mMeshes[1]->mNumFaces, scene_.shapes()[1].mesh.triangle_count());
  for (const char* name : {"plate", "one", "other"}) {
    const aiNode* node = read->mRootNode->FindNode(name);
    ASSERT_NE(node, nullptr) << name;
    ASSERT_EQ(node->mNumMeshes, 1u);
  }
  EXPECT_EQ(read->mRootNode->FindNode("one")->mMeshes[0],
            read->mRootNode->FindNode("other")->mMeshes[0]);
}

TEST_F(GltfRecording, TurnsUpFromZToY) {
  GltfRecorder recorder(scene_);
  recorder.record(0);
  const aiScene* read = write_and_read(recorder);
  ASSERT_NE(read, nullptr);
  aiMatrix4x4 whole;
  for (const aiNode* node = read->mRootNode->FindNode("other"); node != nullptr;
       node = node->mParent) {
    whole = node->mTransformation * whole;
  }
  const dReal* p = dBodyGetPosition(scene_.objects()[2].body);
  EXPECT_NEAR(whole.a4, p[0], kPoseFloat);
  EXPECT_NEAR(whole.b4, p[2], kPoseFloat);
  EXPECT_NEAR(whole.c4, -p[1], kPoseFloat);
}

TEST_F(GltfRecording, HasThePosesOfWhatMovedAtTheTimesTheyWereRecorded) {
  GltfRecorder recorder(scene_);
  const dBodyID one = scene_.objects()[1].body;
  const std::vector<double> times{0, 0.1, 0.35};
  std::vector<std::array<double, 7>> poses;
  for (const double time : times) {
    const dQuaternion q{std::cos(3 * time), std::sin(3 * time) * 0.6, 0, std::sin(3 * time) * 0.8};
    put(one, {time, 2 - time, 5 * time}, q);
    const dReal* p = dBodyGetPosition(one);
    poses.push_back({p[0], p[1], p[2], q[0], q[1], q[2], q[3]});
    recorder.record(time);
  }
  const aiScene* read = write_and_read(recorder);
  ASSERT_NE(read, nullptr);
  const auto channels = channels_of(*read);
  EXPECT_FALSE(channels.contains("plate"));
  EXPECT_FALSE(channels.contains("other"));
  ASSERT_TRUE(channels.contains("one"));
  const aiNodeAnim& channel = *channels.at("one");
  ASSERT_EQ(channel.mNumPositionKeys, times.size());
  ASSERT_EQ(channel.mNumRotationKeys, times.size());
  for (unsigned i = 0; i < times.size(); ++i) {
    EXPECT_NEAR(channel.mPositionKeys[i].mTime, 1000 * times[i], 1e-3);  // Assimp's are in [ms]
    EXPECT_NEAR(channel.mPositionKeys[i].mValue.x, poses[i][0], kPoseFloat);
    EXPECT_NEAR(channel.mPositionKeys[i].mValue.y, poses[i][1], kPoseFloat);
    EXPECT_NEAR(channel.mPositionKeys[i].mValue.z, poses[i][2], kPoseFloat);
    EXPECT_NEAR(channel.mRotationKeys[i].mValue.w, poses[i][3], kPoseFloat);
    EXPECT_NEAR(channel.mRotationKeys[i].mValue.x, poses[i][4], kPoseFloat);
    EXPECT_NEAR(channel.mRotationKeys[i].mValue.z, poses[i][6], kPoseFloat);
  }
}

// Both quaternions of a rotation mean the same, but the ways from them to the next do not.
TEST_F(GltfRecording, TurnsTheShortWayBetweenTwoPoses) {
  GltfRecorder recorder(scene_);
  const dBodyID one = scene_.objects()[1].body;
  const dQuaternion before{0.1, 0, 0, std::sqrt(0.99)}, after{-0.1, 0, 0, -std::sqrt(0.99)};
  put(one, {0, 0, 0}, before);
  recorder.record(0);
  put(one, {0, 0, 1}, after);
  recorder.record(1);
  const dQuaternion further{0, 0, 0, -1};
  put(one, {0, 0, 1}, further);
  recorder.record(2);
  const aiScene* read = write_and_read(recorder);
  ASSERT_NE(read, nullptr);
  const aiNodeAnim& channel = *channels_of(*read).at("one");
  for (unsigned i = 0; i < channel.mNumRotationKeys; ++i)
    EXPECT_GT(channel.mRotationKeys[i].mValue.z, 0.9) << i;
}

TEST_F(GltfRecording, ThatCannotBeWrittenSaysWhere) {
  GltfRecorder recorder(scene_);
  recorder.record(0);
  EXPECT_THROW(recorder.write("/no/such/folder/a.glb"), std::runtime_error);
}

}  // namespace
}  // namespace falling_objects
