// SPDX-License-Identifier: BSD-3-Clause
// What each thread has for itself.
#pragma once

#include <new>

namespace ode_ext {

// The T of this thread, made when it is asked for first. A program may ask while the thread or the
// whole of it ends, from destructors of its own that run after those of a thread's objects: then
// another T takes its place, which is never destroyed.
template <class T>
T& of_this_thread() {
  thread_local bool is_gone = false;  // has no destructor, and is there to the end
  struct Owned {
    T value{};
    ~Owned() { is_gone = true; }
  };
  if (is_gone) {
    alignas(T) thread_local unsigned char place[sizeof(T)];
    thread_local T* late = nullptr;
    if (late == nullptr) late = new (place) T{};
    return *late;
  }
  thread_local Owned owned;
  return owned.value;
}

}  // namespace ode_ext
