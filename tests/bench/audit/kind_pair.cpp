// SPDX-License-Identifier: BSD-3-Clause
#include "bench/audit/kind_pair.h"

#include <ode_ext/ode_ext.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

#include "reference/reference_collider.h"

namespace ode_ext::audit {
namespace {

using namespace test;

constexpr int kContainedEvery = 20;

// Geoms without a space, for as long as it lives.
class Geoms {
 public:
  ~Geoms() {
    for (const dGeomID geom : geoms_) dGeomDestroy(geom);
  }
  Geoms() = default;
  Geoms(const Geoms&) = delete;
  Geoms& operator=(const Geoms&) = delete;

  void add(const OdeMesh& mesh, const TestPose& pose) {
    geoms_.push_back(dCreateTriMesh(nullptr, mesh.id(), nullptr, nullptr, nullptr));
    set_pose(geoms_.back(), pose);
  }
  std::span<const dGeomID> all() const { return geoms_; }

 private:
  std::vector<dGeomID> geoms_;
};

// Room for `most` contacts a pair, and how many there are.
struct PairContacts {
  PairContacts(std::size_t pairs, int most)
      : limit(static_cast<std::size_t>(most)), contacts(pairs * limit), counts(pairs) {}

  dContactGeom* first_of(std::size_t pair) { return &contacts[pair * limit]; }
  std::span<const dContactGeom> of(std::size_t pair) const {
    return std::span(contacts).subspan(pair * limit, static_cast<std::size_t>(counts[pair]));
  }

  std::size_t limit;
  std::vector<dContactGeom> contacts;
  std::vector<int> counts;
};

PairContacts ask_stock(const Geoms& geoms, const Trial& trial) {
  PairContacts result(geoms.all().size() / 2, trial.max_contacts);
  for (std::size_t i = 0; i < result.counts.size(); ++i) {
    result.counts[i] = dCollide(geoms.all()[2 * i], geoms.all()[2 * i + 1], trial.max_contacts,
                                result.first_of(i), sizeof(dContactGeom));
  }
  return result;
}

PairContacts ask_batch(const Geoms& geoms, const Trial& trial) {
  dBatchColliderParams params;
  dBatchColliderParamsInit(&params);
  params.max_contacts = trial.max_contacts;
  if (!trial.device.empty()) params.device = trial.device.c_str();
  const std::unique_ptr<dxBatchCollider, decltype(&dBatchColliderDestroy)> collider(
      dBatchColliderCreate(&params), &dBatchColliderDestroy);
  if (!collider) throw std::runtime_error(dBatchColliderGetLastErrorMessage());

  PairContacts result(geoms.all().size() / 2, trial.max_contacts);
  if (dBatchColliderCollidePairs(collider.get(), geoms.all().data(),
                                 static_cast<int>(result.counts.size()), trial.max_contacts,
                                 result.contacts.data(), sizeof(dContactGeom),
                                 result.counts.data()) < 0) {
    throw std::runtime_error(dBatchColliderGetLastErrorMessage());
  }
  const int status = dBatchColliderGetStatus(collider.get());
  if ((status & (dBatchStatusDeviceFailed | dBatchStatusMeshRefused)) != 0) {
    throw std::runtime_error("the batch collider did not answer by itself: status " +
                             std::to_string(status));
  }
  return result;
}

PairContacts ask_reference(const Geoms& geoms, const Trial& trial) {
  PairContacts result(geoms.all().size() / 2, trial.max_contacts);
  ContactOptions options;
  options.max_contacts = result.limit;
  for (std::size_t i = 0; i < result.counts.size(); ++i) {
    const Contacts found =
        ReferenceCollider::collide(geoms.all()[2 * i], geoms.all()[2 * i + 1], options);
    std::copy(found.begin(), found.end(), result.first_of(i));
    result.counts[i] = static_cast<int>(found.size());
  }
  ReferenceCollider::forget();
  return result;
}

}  // namespace

KindPair::KindPair(const Body& a, const Body& b, std::uint64_t seed)
    : bodies_{&a, &b}, seed_(seed) {
  Random random(seed);
  for (const std::size_t outer : {0u, 1u}) {
    if (hollow_) break;
    hollow_ = Hollow::find(bodies_[outer]->shape.solid, random);
    inner_ = 1 - outer;
  }
  if (!hollow_) return;
  const TestMesh& mesh = bodies_[inner_]->mesh();
  small_ = std::make_unique<Body>(scaled(mesh, hollow_->scale_for(mesh)));
}

PosedPair KindPair::posed(int index) const {
  Random random(Random(seed_ + static_cast<std::uint64_t>(index)).next());
  if (index % kContainedEvery == 0 && hollow_) {
    PosedPair pair{Approach::kContained, random.pose(0.5), {}};
    pair.b = composed(pair.a, hollow_->pose(random));
    if (inner_ == 0) std::swap(pair.a, pair.b);
    return pair;
  }
  return (index % 2 == 0 ? deep_pair : shallow_pair)(bodies_[0]->mesh(), bodies_[1]->mesh(),
                                                     random);
}

std::array<Tally, 3> KindPair::run(const Trial& trial,
                                   const std::function<void(const Miss&)>& report) const {
  std::vector<PosedPair> pairs;
  Geoms geoms;
  for (int i = 0; i < trial.poses; ++i) {
    pairs.push_back(posed(i));
    geoms.add(body(0, pairs.back().approach).ode, pairs.back().a);
    geoms.add(body(1, pairs.back().approach).ode, pairs.back().b);
  }
  const PairContacts stock = ask_stock(geoms, trial);
  const PairContacts batch =
      trial.reference ? ask_reference(geoms, trial) : ask_batch(geoms, trial);

  std::array<Tally, 3> tallies;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Approach approach = pairs[i].approach;
    const PairTruth truth(body(0, approach).shape, body(1, approach).shape, pairs[i]);
    const Answers answers = truth.judge(batch.of(i), trial.max_contacts);
    Tally& tally = tallies[static_cast<std::size_t>(approach)];
    tally += {1,
              truth.intersecting(),
              truth.contained(),
              static_cast<long long>(truth.regions()),
              answers,
              truth.judge(stock.of(i), trial.max_contacts)};
    if (answers.errors() > 0) report({static_cast<int>(i), pairs[i], answers, batch.counts[i]});
  }
  return tallies;
}

}  // namespace ode_ext::audit
