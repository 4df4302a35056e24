// SPDX-License-Identifier: BSD-3-Clause
// The reference contacts (tests/reference), measured like a collider.
#pragma once

#include "bench/accuracy/contestant.h"
#include "reference/reference_contacts.h"

namespace ode_ext::accuracy {

class ReferenceContestant : public Contestant {
 public:
  explicit ReferenceContestant(const test::ContactOptions& options) : options_(options) {}
  ~ReferenceContestant() override;

  std::vector<test::Contacts> collide(std::span<const test::GeomPair> pairs) override;
  std::size_t limit() const override { return options_.max_contacts; }

 private:
  test::ContactOptions options_;
};

}  // namespace ode_ext::accuracy
