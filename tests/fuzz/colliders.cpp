// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/colliders.h"

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace ode_ext::fuzz {
namespace {

// Kernels are compiled anew for each size, which takes PoCL seconds: two are enough.
constexpr const char* kGroupSizes[] = {"64", "16"};

Collider make_kept(std::size_t index) {
  dBatchColliderParams params;
  dBatchColliderParamsInit(&params);
  Collider collider;
  switch (index) {
    case 0:
      break;
    case 1:  // everything must be grown and redone
      params.config = "workload=exact,initial_capacity=1,confidence=0.01";
      break;
    case 2:  // looks at every vertex, so its contacts are others
      params.config =
          "rays=iterative,organization=monolithic,deformable_target=basic,work_group_size=16";
      collider.alike = false;
      break;
    default:
      params.max_contacts = 3;
      params.triangle_callbacks = 1;
      params.config = "prediction=plain";
      collider.alike = false;
  }
  collider.id = dBatchColliderCreate(&params);
  if (collider.id == nullptr) throw std::runtime_error(dBatchColliderGetLastErrorMessage());
  return collider;
}

// Settings, some of which are wrong.
class Config {
 public:
  void set(const char* name, std::string_view value) {
    text_ += std::string(text_.empty() ? "" : ",") + name + "=" + std::string(value);
  }
  void choose(const char* name, std::span<const char* const> values, int index) {
    set(name, values[static_cast<std::size_t>(index)]);
  }
  bool says(std::string_view value) const { return text_.find(value) != std::string::npos; }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

constexpr const char* kWorkloads[] = {"predicted", "exact", "exac"};
constexpr const char* kPredictions[] = {"pair-scaled", "plain", ""};
constexpr const char* kRays[] = {"full", "iterative", "iterative-paper", "0"};
constexpr const char* kTargets[] = {"refit", "basic", "refit|basic"};
constexpr const char* kOrganizations[] = {"pipelined", "monolithic", "="};
constexpr const char* kMispredictions[] = {"redo", "ignore", "backtrack", "Redo"};
constexpr const char* kEdges[] = {"on", "off", "1"};
constexpr const char* kCapacities[] = {"16384", "1", "64", "100000", "-1"};

}  // namespace

const Collider& Colliders::kept(std::size_t index) {
  Collider& collider = kept_[index % kKept];
  if (collider.id == nullptr) collider = make_kept(index % kKept);
  return collider;
}

void Colliders::renew() {
  for (Collider& collider : kept_) {
    dBatchColliderDestroy(collider.id);
    collider = {};
  }
}

Collider decode_collider(ByteSource& bytes) {
  dBatchColliderParams params;
  dBatchColliderParamsInit(&params);
  Config config;
  for (int changes = bytes.below(5); changes > 0; --changes) {
    switch (bytes.below(18)) {
      case 0:
        params.max_contacts = bytes.between(0, 65);
        break;
      case 1:
        config.choose("workload", kWorkloads, bytes.below(3));
        break;
      case 2:
        config.choose("prediction", kPredictions, bytes.below(3));
        break;
      case 3:
        params.trust_meshes = bytes.below(2);
        break;
      case 4:
        config.set("confidence", std::to_string(bytes.wild()));
        break;
      case 5:
        params.open_thickness = bytes.wild();
        break;
      case 6:
        config.choose("work_group_size", kGroupSizes, bytes.below(2));
        break;
      case 7:
        config.choose("initial_capacity", kCapacities, bytes.below(5));
        break;
      case 8:
        config.choose("rays", kRays, bytes.below(4));
        break;
      case 9:
        config.choose("deformable_target", kTargets, bytes.below(3));
        break;
      case 10:
        config.choose("organization", kOrganizations, bytes.below(3));
        break;
      case 11:
        config.choose("misprediction", kMispredictions, bytes.below(4));
        break;
      case 12:
        params.max_contacts_deformable = bytes.between(-1, 65);
        break;
      case 13:
        config.set("walk_limit", std::to_string(bytes.between(-1, 40)));
        break;
      case 14:
        config.set("displacement_limit", std::to_string(bytes.wild()));
        break;
      case 15:
        config.choose("edges", kEdges, bytes.below(3));
        break;
      case 16:
        params.triangle_callbacks = bytes.below(2);
        break;
      default:
        if (bytes.coin()) {
          params.device = "no such device";
        } else {
          params.struct_size = static_cast<std::size_t>(bytes.byte());
        }
    }
  }
  params.config = config.text().c_str();
  Collider collider;
  collider.complete = params.trust_meshes == 0 && params.triangle_callbacks == 0 &&
                      !config.says("iterative-paper") && !config.says("ignore") &&
                      !config.says("backtrack") && !config.says("off");
  collider.alike = false;
  collider.id = dBatchColliderCreate(&params);
  return collider;
}

}  // namespace ode_ext::fuzz
