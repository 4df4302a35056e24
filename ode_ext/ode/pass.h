// SPDX-License-Identifier: BSD-3-Clause
// A collide pass: the batch is computed where it begins, and while it lives dCollide on this thread
// asks its collider first. Passes nest.
#pragma once

#include <ode/ode.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "ode/batch_collider.h"

namespace ode_ext {

// Where on the stack the call of the API stands that a pass belongs to. A program's callback may
// leave by longjmp: no destructor runs then, and all that tells is that a later call stands where
// that one stood, or that its mark has been overwritten.
class CallMark {
 public:
  __attribute__((noinline)) CallMark();
  CallMark(const CallMark&) = delete;
  CallMark& operator=(const CallMark&) = delete;
  std::uint64_t number() const { return number_; }
  const void* frame() const { return frame_; }
  bool is(std::uint64_t number) const;  // reads memory that may be anything by now

 private:
  const void* frame_;
  volatile std::uint64_t number_;
};

class Pass {
 public:
  // Throws std::runtime_error if another thread runs a pass of this collider. A failing device is
  // not an error: ODE's own collider then answers this pass. `mark` lives as long as the pass.
  Pass(const std::shared_ptr<BatchCollider>& collider, const PassRoot& root, const CallMark& mark);
  ~Pass();
  Pass(const Pass&) = delete;
  Pass& operator=(const Pass&) = delete;

  // ODE's own pass with the program's callback, which may throw. False: nothing is delivered
  // (misprediction=backtrack), and no callback was made.
  bool deliver(void* data, dNearCallback* callback);

  // Of this thread: the innermost collider that passes, or null; what all passes traverse.
  static BatchCollider* collider_on_this_thread();
  static std::vector<PassRoot> roots_on_this_thread();

  // Ends the passes of this thread that the program has left by longjmp, as far as a call with this
  // mark can tell.
  static void end_those_left(const CallMark& mark);

 private:
  PassRoot root_;
  std::uint64_t number_;
  bool backtracked_ = false;
};

}  // namespace ode_ext
