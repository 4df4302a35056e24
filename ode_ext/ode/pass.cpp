// SPDX-License-Identifier: BSD-3-Clause
#include "ode/pass.h"

#include <atomic>
#include <functional>

#include "ode/registry.h"
#include "ode/thread_state.h"
#include "opencl/fork_guard.h"

namespace ode_ext {
namespace {

// A pass that has begun. The collider lives as long: its handle may be gone before, or the pass
// left for good.
struct Begun {
  std::shared_ptr<BatchCollider> collider;
  PassRoot root;
  bool outer_failed;  // see BatchCollider::claim
  const CallMark* mark;
  const void* frame;
  std::uint64_t number;
};

// The passes of a thread, outermost first. What a thread leaves behind ends with it.
struct PassesOfAThread {
  std::vector<Begun> begun;

  ~PassesOfAThread() {
    while (!begun.empty()) end_last();
  }
  void end_last() {
    if (is_lost_by_fork())
      new std::shared_ptr(begun.back().collider);  // neither its lock nor its end may be had here
    else
      begun.back().collider->unclaim(begun.back().outer_failed);
    begun.pop_back();
  }
};
PassesOfAThread& passes() { return of_this_thread<PassesOfAThread>(); }

std::uint64_t next_number() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

}  // namespace

// The frame, and not the address of the mark, which a sanitizer may keep off the stack. The numbers
// stand nowhere else on a stack.
CallMark::CallMark()
    : frame_(__builtin_frame_address(0)), number_(next_number() * 0x9e3779b97f4a7c15u) {}

__attribute__((no_sanitize("address"))) bool CallMark::is(std::uint64_t number) const {
  return number_ == number;
}

Pass::Pass(const std::shared_ptr<BatchCollider>& collider, const PassRoot& root,
           const CallMark& mark)
    : root_(root), number_(mark.number()) {
  const std::vector<PassRoot> traversed = roots_on_this_thread();
  passes().begun.reserve(passes().begun.size() + 1);
  const bool outer_failed = collider->claim();
  note_pass_here(collider);
  // Before the batch: already gathering calls code of the program's, which may leave by longjmp.
  passes().begun.push_back({collider, root, outer_failed, &mark, mark.frame(), number_});
  try {
    backtracked_ = collider->run_batch(root, traversed);
  } catch (...) {
    passes().end_last();
    throw;
  }
}

// Passes within this one that were left by longjmp end with it. It may itself have been taken for
// one that was left: a callback may switch stacks.
Pass::~Pass() {
  for (std::size_t i = 0; i < passes().begun.size(); ++i) {
    if (passes().begun[i].number != number_) continue;
    while (passes().begun.size() > i) passes().end_last();
  }
}

bool Pass::deliver(void* data, dNearCallback* callback) {
  if (backtracked_) return false;
  if (root_.second == nullptr)
    dSpaceCollide(reinterpret_cast<dSpaceID>(root_.first), data, callback);
  else
    dSpaceCollide2(root_.first, root_.second, data, callback);
  return true;
}

BatchCollider* Pass::collider_on_this_thread() {
  return passes().begun.empty() ? nullptr : passes().begun.back().collider.get();
}

std::vector<PassRoot> Pass::roots_on_this_thread() {
  std::vector<PassRoot> roots;
  for (const Begun& pass : passes().begun) roots.push_back(pass.root);
  return roots;
}

// Stacks grow downwards: within a pass every call stands below that of the pass.
void Pass::end_those_left(const CallMark& mark) {
  while (!passes().begun.empty()) {
    const Begun& last = passes().begun.back();
    if (std::less<>()(mark.frame(), last.frame) && last.mark->is(last.number)) return;
    passes().end_last();
  }
}

}  // namespace ode_ext
