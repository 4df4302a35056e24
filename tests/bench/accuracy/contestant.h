// SPDX-License-Identifier: BSD-3-Clause
// Whose contacts are measured: the batch collider's, and those of ODE's own.
#pragma once

#include <ode_ext/ode_ext.h>

#include <span>
#include <vector>

#include "support/ode_world.h"

namespace ode_ext::accuracy {

class Contestant {
 public:
  virtual ~Contestant() = default;
  // The contacts of each pair of meshes, normals into the first.
  virtual std::vector<test::Contacts> collide(std::span<const test::GeomPair> pairs) = 0;
  virtual std::size_t limit() const = 0;  // contacts per pair; a list as long may be cut
};

// As long as no batch collider lives, which takes its place. Where triangles coincide it can fail
// an assertion of its own, which ends the program; here the pair is then one without contacts.
class StockOde : public Contestant {
 public:
  std::vector<test::Contacts> collide(std::span<const test::GeomPair> pairs) override;
  std::size_t limit() const override { return 1000; }  // one for every two triangles that cross
  int pairs_given_up() const { return pairs_given_up_; }

 private:
  int pairs_given_up_ = 0;
};

// With its defaults, through its public API.
class BatchOde : public Contestant {
 public:
  BatchOde();  // throws where there is no device
  ~BatchOde() override;
  BatchOde(const BatchOde&) = delete;
  BatchOde& operator=(const BatchOde&) = delete;

  std::vector<test::Contacts> collide(std::span<const test::GeomPair> pairs) override;
  std::size_t limit() const override { return limit_; }

 private:
  dBatchColliderID batch_;
  std::size_t limit_;
};

// The deepest; none of none.
const dContactGeom* deepest_of(const test::Contacts& contacts);

}  // namespace ode_ext::accuracy
