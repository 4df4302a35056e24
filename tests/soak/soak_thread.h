// SPDX-License-Identifier: BSD-3-Clause
// What one thread of the soak does: passes over a space of its own with a collider of its own, in
// which nothing stays as it is.
#pragma once

#include <ode_ext/ode_ext.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "support/ode_world.h"

namespace ode_ext::soak {

// What all threads have done.
struct Progress {
  std::atomic<long long> passes = 0, pairs = 0, contacts = 0;
  std::atomic<long long> bodies = 0, meshes = 0, spaces = 0, colliders = 0, edits = 0;  // made
  std::atomic<long long> failures = 0;  // passes whose device failed
  std::atomic<long long> checked = 0;   // pairs compared with a collider that knows nothing else
  std::atomic<bool> stop = false;

  void report(const std::string& what);  // the run has failed
  std::string flaw() const;              // the first; "": none

 private:
  mutable std::mutex mutex_;
  std::string flaw_;
};

class SoakThread {
 public:
  SoakThread(Progress& progress, std::uint64_t seed, std::size_t bodies);
  ~SoakThread();
  SoakThread(const SoakThread&) = delete;
  SoakThread& operator=(const SoakThread&) = delete;

  void run(long long passes);
  // A pass without change, check or failure, of a collider that lives: then memory can be compared.
  void settle();

 private:
  struct Body {
    dBodyID body;
    dGeomID geom;
    std::size_t mesh;
  };
  struct Mesh {
    std::unique_ptr<test::OdeMesh> ode;
    bool deformable = false;
  };
  // What the near callback of a pass hears.
  struct Heard {
    SoakThread* thread;
    int skip;  // pairs until the one that is looked at again
    dGeomID a = nullptr, b = nullptr;
    test::Contacts contacts{};
  };

  static void near(void* heard, dGeomID a, dGeomID b);
  bool once_in(int n) { return random_.below(n) == 0; }

  void change();
  void pass();
  void check(const Heard& heard);
  void put_at_random(dBodyID body);
  void add_body();
  void remove_body(std::size_t index);
  void replace_mesh(std::size_t index);
  void edit_mesh(std::size_t index);
  void replace_space();
  void replace_collider();
  bool mark_deformables(dBatchColliderID collider) const;

  Progress& progress_;
  test::Random random_;
  std::size_t most_bodies_;
  dThreadingImplementationID threading_;
  dWorldID world_;
  dJointGroupID joints_;
  dSpaceID space_ = nullptr;
  dBatchColliderID collider_ = nullptr;
  std::unique_ptr<test::OdeMesh> floor_mesh_;
  dGeomID floor_ = nullptr;
  std::vector<Mesh> meshes_;
  std::vector<Body> bodies_;
};

}  // namespace ode_ext::soak
