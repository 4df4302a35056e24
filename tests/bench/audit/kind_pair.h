// SPDX-License-Identifier: BSD-3-Clause
// Two kinds of mesh in a given order, posed at random and put to both colliders.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/audit/kinds.h"
#include "bench/audit/pair_audit.h"
#include "support/ode_world.h"

namespace ode_ext::audit {

// Of a kind, with what ODE and the oracles make of it.
struct Body {
  explicit Body(const test::TestMesh& mesh) : shape(mesh), ode(mesh) {}
  const test::TestMesh& mesh() const { return ode.mesh(); }

  Shape shape;
  test::OdeMesh ode;
};

// One pair and what was found wrong with the batch collider's answer.
struct Miss {
  int index;
  PosedPair poses;
  Answers answers;
  int contacts;
};

struct Trial {
  int poses = 2000;
  std::uint64_t seed = 1;
  int max_contacts = 16;
  std::string device;      // as in ODE_EXT_DEVICE; empty: the library's choice
  bool reference = false;  // the reference contacts (tests/reference) in the library's place
};

class KindPair {
 public:
  KindPair(const Body& a, const Body& b, std::uint64_t seed);

  // Every twentieth is a small mesh inside a closed one, if there is one; of the others, half are
  // shallow and half are deep.
  PosedPair posed(int index) const;

  // Tallies by approach. `report` is called of every wrong answer. Throws std::runtime_error. No
  // batch collider may exist: the stock collider is asked first.
  std::array<Tally, 3> run(const Trial& trial,
                           const std::function<void(const Miss&)>& report) const;

 private:
  const Body& body(std::size_t side, Approach approach) const {
    return approach == Approach::kContained && side == inner_ ? *small_ : *bodies_[side];
  }

  std::array<const Body*, 2> bodies_;
  std::uint64_t seed_;
  std::size_t inner_ = 1;  // which of the two is scaled down
  std::optional<Hollow> hollow_;
  std::unique_ptr<Body> small_;
};

}  // namespace ode_ext::audit
