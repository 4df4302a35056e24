// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/colliders.h"

#include <stdexcept>

namespace ode_ext::fuzz {
namespace {

// Kernels are compiled anew for each size, which takes PoCL seconds: two are enough.
constexpr int kGroupSizes[] = {0, 16};

Collider make_kept(std::size_t index) {
  dBatchColliderParams params;
  dBatchColliderParamsInit(&params);
  Collider collider;
  switch (index) {
    case 0:
      break;
    case 1:  // everything must be grown and redone
      params.workload = dBatchWorkloadExact;
      params.initial_capacity = 1;
      params.confidence = 0.01;
      break;
    case 2:  // looks at every vertex, so its contacts are others
      params.rays = dBatchRaysIterative;
      params.organization = dBatchOrganizationMonolithic;
      collider.alike = false;
      params.deformable_target = dBatchDeformableBasic;
      params.work_group_size = kGroupSizes[1];
      break;
    default:
      params.max_contacts = 3;
      params.triangle_callbacks = 1;
      params.prediction = dBatchPredictionPlain;
      collider.alike = false;
  }
  collider.id = dBatchColliderCreate(&params);
  if (collider.id == nullptr) throw std::runtime_error(dBatchColliderGetLastErrorMessage());
  return collider;
}

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
  constexpr int kCapacities[] = {0, 1, 64, 100000, -1};
  dBatchColliderParams params;
  dBatchColliderParamsInit(&params);
  for (int changes = bytes.below(5); changes > 0; --changes) {
    switch (bytes.below(18)) {
      case 0:
        params.max_contacts = bytes.between(0, 65);
        break;
      case 1:
        params.workload = bytes.below(3);
        break;
      case 2:
        params.prediction = bytes.below(3);
        break;
      case 3:
        params.trust_meshes = bytes.below(2);
        break;
      case 4:
        params.confidence = bytes.wild();
        break;
      case 5:
        params.open_thickness = bytes.wild();
        break;
      case 6:
        params.work_group_size = kGroupSizes[bytes.below(2)];
        break;
      case 7:
        params.initial_capacity = kCapacities[bytes.below(5)];
        break;
      case 8:
        params.rays = bytes.below(4);
        break;
      case 9:
        params.deformable_target = bytes.below(3);
        break;
      case 10:
        params.organization = bytes.below(3);
        break;
      case 11:
        params.misprediction = bytes.below(4);
        break;
      case 12:
        params.max_contacts_deformable = bytes.between(-1, 65);
        break;
      case 13:
        params.walk_limit = bytes.between(-1, 40);
        break;
      case 14:
        params.displacement_limit = bytes.wild();
        break;
      case 15:
        params.edges = bytes.below(3);
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
  Collider collider;
  collider.complete = params.trust_meshes == 0 && params.rays != dBatchRaysIterativePaper &&
                      params.misprediction == dBatchMispredictionRedo &&
                      params.edges == dBatchEdgesOn && params.triangle_callbacks == 0;
  collider.alike = false;
  collider.id = dBatchColliderCreate(&params);
  return collider;
}

}  // namespace ode_ext::fuzz
