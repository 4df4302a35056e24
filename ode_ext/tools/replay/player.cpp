// SPDX-License-Identifier: BSD-3-Clause
#include "tools/replay/player.h"

#include <algorithm>
#include <chrono>
#include <functional>

#include "tools/replay/played_mesh.h"

namespace ode_ext::replay {
namespace {

// What a call of so many pairs writes is 50 MB.
constexpr std::size_t kPairsACall = 32768;

constexpr int kMostContacts = 0xffff;

capture::Contact to_record(const dContactGeom& c) {
  return {{c.pos[0], c.pos[1], c.pos[2]},
          {c.normal[0], c.normal[1], c.normal[2]},
          c.depth,
          c.side1,
          c.side2};
}

}  // namespace

Player::Player(const ColliderRecord& record, const std::vector<MeshRecord>& meshes,
               const char* device, const char* config)
    : records_(meshes),
      empty_(dSimpleSpaceCreate(nullptr)),
      max_contacts_(static_cast<int>(record.max_contacts)) {
  dBatchColliderParams params;
  dBatchColliderParamsInit(&params);
  params.device = device;
  params.max_contacts = max_contacts_;
  params.max_contacts_deformable = static_cast<int>(record.max_contacts_deformable);
  params.open_thickness = record.open_thickness;
  params.trust_meshes = 1;  // what changes is announced
  params.config = config != nullptr ? config : record.config.c_str();
  collider_ = dBatchColliderCreate(&params);
  if (collider_ != nullptr) return;
  dSpaceDestroy(empty_);
  throw DeviceError(dBatchColliderGetLastErrorMessage());
}

Player::~Player() {
  meshes_.clear();
  dBatchColliderDestroy(collider_);
  dSpaceDestroy(empty_);
}

const char* Player::device_name() const { return dBatchColliderGetDeviceName(collider_); }

PlayedMesh& Player::mesh(std::uint32_t number) {
  std::unique_ptr<PlayedMesh>& known = meshes_[number];
  if (known == nullptr) {
    const MeshRecord& record = records_[number];
    const bool is_shape = record.base != capture::kNoBase;
    known = std::make_unique<PlayedMesh>(collider_, record,
                                         is_shape ? &records_[record.base] : nullptr);
  }
  return *known;
}

// A shape is mostly of one pass, and would be on the device in all that follow.
void Player::forget_shapes() {
  std::erase_if(meshes_, [](const auto& item) { return item.second->is_shape(); });
}

std::vector<Played> Player::play(const PassRecord& pass, int repetitions) {
  std::vector<Played> played;
  std::vector<dGeomID> all;
  for (int i = 0; i < repetitions; ++i) {
    const std::vector<dGeomID> geoms = place(pass);
    all.insert(all.end(), geoms.begin(), geoms.end());
    played.push_back(collide(geoms, pass.pair_list));
  }
  for (const dGeomID geom : all) dGeomDestroy(geom);
  forget_shapes();
  return played;
}

// The objects of a pass are listed by their handles: they get handles in the same order.
std::vector<dGeomID> Player::place(const PassRecord& pass) {
  std::vector<dGeomID> geoms;
  for (std::uint32_t i = 0; i < pass.objects; ++i)
    geoms.push_back(
        dCreateTriMesh(nullptr, mesh(pass.object_list[i].mesh).data(), nullptr, nullptr, nullptr));
  std::ranges::sort(geoms, std::less<>());
  for (std::size_t i = 0; i < geoms.size(); ++i) {
    const capture::Object& object = pass.object_list[i];
    dGeomTriMeshSetData(geoms[i], mesh(object.mesh).data());
    dGeomSetPosition(geoms[i], object.position[0], object.position[1], object.position[2]);
    dMatrix3 rotation{};
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        rotation[4 * row + column] = object.rotation[3 * row + column];
    dGeomSetRotation(geoms[i], rotation);
  }
  return geoms;
}

Played Player::collide(const std::vector<dGeomID>& geoms, std::span<const capture::Pair> pairs) {
  Played played;
  for (std::size_t first = 0; first < pairs.size(); first += kPairsACall) {
    std::vector<dGeomID> asked;
    for (const capture::Pair& pair :
         pairs.subspan(first).first(std::min(kPairsACall, pairs.size() - first)))
      asked.insert(asked.end(), {geoms[pair.first], geoms[pair.second]});
    dBatchColliderSpaceCollide(collider_, empty_, nullptr, [](void*, dGeomID, dGeomID) {});
    std::vector<int> counts;
    const auto begin = std::chrono::steady_clock::now();
    collide_call(asked, max_contacts_, counts);
    played.ms +=
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();

    const std::vector<dContactGeom> found = contacts_;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const auto* contacts = &found[i * static_cast<std::size_t>(max_contacts_)];
      std::vector<int> count{counts[i]};
      if (counts[i] == max_contacts_) {  // of a deformable mesh there may be more, known by now
        collide_call({&asked[2 * i], 2}, kMostContacts, count);
        contacts = contacts_.data();
      }
      played.counts.push_back(static_cast<std::uint32_t>(count[0]));
      std::transform(contacts, contacts + count[0], std::back_inserter(played.contacts), to_record);
    }
  }
  return played;
}

void Player::collide_call(std::span<const dGeomID> geoms, int limit, std::vector<int>& counts) {
  const std::size_t pairs = geoms.size() / 2;
  counts.assign(pairs, 0);
  contacts_.resize(pairs * static_cast<std::size_t>(limit));
  const int total =
      dBatchColliderCollidePairs(collider_, geoms.data(), static_cast<int>(pairs), limit,
                                 contacts_.data(), sizeof(dContactGeom), counts.data());
  if (total < 0 || (dBatchColliderGetStatus(collider_) & dBatchStatusDeviceFailed) != 0)
    throw DeviceError(dBatchColliderGetLastErrorMessage());
}

}  // namespace ode_ext::replay
