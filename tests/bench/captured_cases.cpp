// SPDX-License-Identifier: BSD-3-Clause
#include "bench/captured_cases.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "tools/replay/capture_file.h"

namespace ode_ext::bench {
namespace {

// Corners become vertices that triangles share, as colliders are used to.
TestMesh welded(const std::vector<float>& corners) {
  TestMesh mesh;
  std::map<std::array<float, 3>, unsigned> seen;
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const std::array<float, 3> corner{corners[i], corners[i + 1], corners[i + 2]};
    const auto [known, is_new] = seen.try_emplace(corner, static_cast<unsigned>(seen.size()));
    if (is_new) mesh.vertices.insert(mesh.vertices.end(), corner.begin(), corner.end());
    mesh.indices.push_back(known->second);
  }
  return mesh;
}

TestPose pose_of(const capture::Object& object) {
  TestPose pose;
  std::copy_n(object.position, 3, pose.position.begin());
  std::copy_n(object.rotation, 9, pose.rotation.begin());
  return pose;
}

}  // namespace

std::vector<PairCase> captured_cases(const std::string& path, int pairs) {
  replay::CaptureFile file(path);
  std::vector<TestMesh> meshes;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<PosedPair>> met;
  for (replay::Record record = file.next(); !std::holds_alternative<replay::EndOfCapture>(record);
       record = file.next()) {
    if (const auto* mesh = std::get_if<replay::MeshRecord>(&record))
      meshes.push_back(welded(mesh->corners));
    const auto* pass = std::get_if<replay::PassRecord>(&record);
    if (pass == nullptr) continue;
    for (const capture::Pair& pair : pass->pair_list) {
      const capture::Object& a = pass->object_list[pair.first];
      const capture::Object& b = pass->object_list[pair.second];
      met[{a.mesh, b.mesh}].push_back({pose_of(a), pose_of(b)});
    }
  }
  std::vector<std::pair<std::size_t, PairCase>> cases;
  for (auto& [which, posed] : met) {
    PairCase one{"meshes " + std::to_string(which.first) + " and " + std::to_string(which.second),
                 meshes[which.first],
                 meshes[which.second],
                 {}};
    const std::size_t count = std::min(posed.size(), static_cast<std::size_t>(pairs));
    for (std::size_t i = 0; i < count; ++i) one.pairs.push_back(posed[i * posed.size() / count]);
    cases.emplace_back(posed.size(), std::move(one));
  }
  std::ranges::stable_sort(cases, std::greater<>(), [](const auto& one) { return one.first; });
  std::vector<PairCase> result;
  for (auto& [count, one] : cases) result.push_back(std::move(one));
  return result;
}

}  // namespace ode_ext::bench
