// SPDX-License-Identifier: BSD-3-Clause
// What all functions of the C boundary do: exceptions become errors, handles colliders.
#pragma once

#include <cxxabi.h>

#include <exception>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>

#include "ode/batch_collider.h"
#include "ode/messages.h"
#include "ode/registry.h"
#include "ode_ext/ode_ext.h"
#include "opencl/fork_guard.h"

namespace ode_ext::api {

// Runs `body`; an exception becomes the last error, prefixed with the call, and `failure`. A thread
// that ends (pthread_exit, pthread_cancel) in a callback of the program's within goes on ending.
template <class Result, class Body>
Result guarded(const char* call, Result failure, Body body) {
  try {
    try {
      return body();
    } catch (const abi::__forced_unwind&) {
      throw;
    } catch (const std::bad_alloc&) {
      set_last_error(std::string(call) + ": out of memory");
    } catch (const std::exception& error) {
      set_last_error(std::string(call) + ": " + error.what());
    } catch (...) {
      set_last_error(std::string(call) + ": unknown exception");
    }
  } catch (const abi::__forced_unwind&) {
    throw;
  } catch (...) {  // no memory for the message either
  }
  return failure;
}

[[noreturn]] inline void refuse(const std::string& why) { throw std::invalid_argument(why); }

inline std::shared_ptr<BatchCollider> live(dBatchColliderID handle) {
  auto collider = find_collider(handle);
  if (collider == nullptr) refuse("this is not the handle of a live collider");
  return collider;
}

inline void refuse_in_a_fork() {
  if (is_lost_by_fork())
    refuse("this process was forked from one that had used OpenCL; call exec in the child");
}

}  // namespace ode_ext::api
