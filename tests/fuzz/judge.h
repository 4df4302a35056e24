// SPDX-License-Identifier: BSD-3-Clause
// Asks colliders for contacts and judges what they say. The first flaw stays.
#pragma once

#include <string>
#include <vector>

#include "fuzz/program.h"
#include "fuzz/world.h"

namespace ode_ext::fuzz {

class Judge {
 public:
  Judge(World& world, Colliders& colliders, const ProgramOptions& options)
      : world_(world), colliders_(colliders), options_(options) {}

  Tally tally;
  // The device is being made to fail: ODE itself may answer, and its answers are not ours to judge.
  bool device_fails = false;
  // It failed before: until its next pass a collider may leave pairs to ODE.
  bool device_failed = false;
  // A collider that is not complete is alive, and may be who answers outside of a pass.
  bool incomplete = false;

  const std::string& flaw() const { return flaw_; }
  bool slow() const { return slow_; }  // the flaw is that something took too long
  void report(const std::string& flaw);

  // dCollide(a, b) for at most `limit` contacts. `in_pass` is the collider whose pass is running on
  // this thread, or null.
  void ask(dGeomID a, dGeomID b, int limit, const Collider* in_pass);
  // dBatchColliderCollidePairs. Not in a callback.
  void ask_pairs(const std::vector<Geom*>& geoms, int limit, const Collider& collider);
  // The same in a callback, where nothing is timed, since geoms may not be moved.
  void ask_pairs_inside(const std::vector<Geom*>& geoms, int limit, const Collider& collider);

  // Runs `call`. If it takes long, every pair of meshes there is has to explain itself.
  template <class Call>
  void timed(const char* what, Call call) {
    const double start = seconds();
    if (options_.delay) options_.delay();
    call();
    const double took = seconds() - start;
    if (took > options_.slow && !device_fails) find_slow_pair(what, took);
  }

 private:
  static double seconds();
  bool not_ours(const Collider* in_pass) const {
    return device_fails || (device_failed && in_pass == nullptr);
  }
  void find_slow_pair(const char* what, double took);
  double time_of(Geom& a, Geom& b);        // with both meshes known, [s]
  double stock_time_of(Geom& a, Geom& b);  // [s]; 0 where stock ODE cannot be asked
  void judge_getters(Geom& a, Geom& b, const std::vector<dContactGeom>& contacts,
                     const Collider& by);
  void judge(Geom& a, Geom& b, const std::vector<dContactGeom>& contacts, int limit,
             const Collider* by);
  void compare(Geom& a, Geom& b, const std::vector<dContactGeom>& contacts, int limit,
               const Collider& by);

  World& world_;
  Colliders& colliders_;
  const ProgramOptions& options_;
  std::string flaw_;
  bool slow_ = false;
  int asked_ = 0, compared_ = 0;
};

}  // namespace ode_ext::fuzz
