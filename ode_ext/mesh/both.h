// SPDX-License-Identifier: BSD-3-Clause
// Two things at a time: what meshes of millions of triangles take seconds for is cut in halves.
#pragma once

#include <cstddef>
#include <future>
#include <optional>
#include <system_error>
#include <thread>

namespace ode_ext {

// How many threads are worth having for so much work: one for every `each`, no more than there are
// processors.
inline std::size_t worthwhile_threads(std::size_t work, std::size_t each) {
  const std::size_t processors = std::thread::hardware_concurrency();
  return work / each < processors ? work / each : processors;
}

// Both are called, and both have returned or thrown when it does; the first by another thread if
// there are two, and one can be had. They must not touch what the other writes.
template <class First, class Second>
void do_both(std::size_t threads, First first, Second second) {
  std::optional<std::future<void>> running;
  if (threads > 1) {
    try {
      running = std::async(std::launch::async, first);
    } catch (const std::system_error&) {  // no more threads: one after the other
    }
  }
  if (!running) first();
  second();
  if (running) running->get();
}

}  // namespace ode_ext
