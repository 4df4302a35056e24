// SPDX-License-Identifier: BSD-3-Clause
#include "bench/accuracy/contestant.h"

#include <algorithm>
#include <cstdarg>
#include <stdexcept>

namespace ode_ext::accuracy {
namespace {

constexpr std::size_t kBatch = 500;  // pairs, so that no buffer becomes large

struct FailedAssertion {};

// While it lives, ODE's failed assertions throw, and what else it has to say is not printed.
class QuietOde {
 public:
  QuietOde() {
    dSetDebugHandler([](int, const char*, va_list) { throw FailedAssertion(); });
    dSetMessageHandler([](int, const char*, va_list) {});
  }
  ~QuietOde() {
    dSetDebugHandler(debug_);
    dSetMessageHandler(message_);
  }
  QuietOde(const QuietOde&) = delete;
  QuietOde& operator=(const QuietOde&) = delete;

 private:
  dMessageFunction* debug_ = dGetDebugHandler();
  dMessageFunction* message_ = dGetMessageHandler();
};

}  // namespace

std::vector<test::Contacts> StockOde::collide(std::span<const test::GeomPair> pairs) {
  const QuietOde quiet;
  std::vector<test::Contacts> answers;
  for (const auto& [g1, g2] : pairs) {
    try {
      answers.push_back(test::collide(g1, g2, static_cast<int>(limit())));
    } catch (const FailedAssertion&) {
      answers.emplace_back();
      ++pairs_given_up_;
    }
  }
  return answers;
}

BatchOde::BatchOde() {
  dBatchColliderParams params;
  dBatchColliderParamsInit(&params);
  limit_ = static_cast<std::size_t>(params.max_contacts);
  batch_ = dBatchColliderCreate(&params);
  if (batch_ == nullptr) throw std::runtime_error(dBatchColliderGetLastErrorMessage());
}

BatchOde::~BatchOde() { dBatchColliderDestroy(batch_); }

std::vector<test::Contacts> BatchOde::collide(std::span<const test::GeomPair> pairs) {
  std::vector<test::Contacts> answers;
  while (!pairs.empty()) {
    const auto some = pairs.first(std::min(pairs.size(), kBatch));
    pairs = pairs.subspan(some.size());
    std::vector<dGeomID> geoms;
    for (const auto& [g1, g2] : some) geoms.insert(geoms.end(), {g1, g2});
    test::Contacts contacts(some.size() * limit_);
    std::vector<int> counts(some.size());
    if (dBatchColliderCollidePairs(batch_, geoms.data(), static_cast<int>(some.size()),
                                   static_cast<int>(limit_), contacts.data(), sizeof(dContactGeom),
                                   counts.data()) < 0)
      throw std::runtime_error(dBatchColliderGetLastErrorMessage());
    for (std::size_t i = 0; i < some.size(); ++i) {
      const auto first = contacts.begin() + static_cast<std::ptrdiff_t>(i * limit_);
      answers.emplace_back(first, first + counts[i]);
    }
  }
  return answers;
}

const dContactGeom* deepest_of(const test::Contacts& contacts) {
  const auto deepest =
      std::max_element(contacts.begin(), contacts.end(),
                       [](const auto& a, const auto& b) { return a.depth < b.depth; });
  return deepest == contacts.end() ? nullptr : &*deepest;
}

}  // namespace ode_ext::accuracy
