// SPDX-License-Identifier: BSD-3-Clause
// How much memory this process has, and whether it grew.
#pragma once

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "support/sanitizers.h"

namespace ode_ext::soak {

// A sanitizer keeps shadows of all memory ever touched, several times its size, and freed blocks in
// quarantine: resident memory then says nothing about this program.
#if ODE_EXT_THREAD_SANITIZER || ODE_EXT_ADDRESS_SANITIZER
constexpr bool kResidentMemoryIsOurs = false;
#else
constexpr bool kResidentMemoryIsOurs = true;
#endif

// [MiB]
struct Memory {
  double resident = 0;  // what the process holds
  double in_use = 0;    // what was allocated and not freed, by the program and the driver
};

// Blocks that were freed are no leak, yet resident memory grows with them for hours where compilers
// in the driver's threads ask for tens of MiB and give them back: each thread has blocks of its
// own, in pieces.
inline Memory memory_now() {
  long long pages = 0, resident = 0;
  if (FILE* file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%lld %lld", &pages, &resident) != 2) resident = 0;
    std::fclose(file);
  }
  constexpr double kMiB = 1 << 20;
  const struct mallinfo2 heap = mallinfo2();
  return {static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / kMiB,
          static_cast<double>(heap.uordblks + heap.hblkhd) / kMiB};
}

// The median of the last third of the samples less that of the middle third: what comes and goes
// cancels out, such as a collider made anew before a driver gave back what the last one had,
// and what is kept for good does not. The first third is for warming up.
inline double growth(const std::vector<double>& samples) {
  const auto third = static_cast<std::ptrdiff_t>(samples.size() / 3);
  if (third == 0) return 0;
  const auto median = [&](auto first) {
    std::vector<double> part(first, first + third);
    std::nth_element(part.begin(), part.begin() + third / 2, part.end());
    return part[static_cast<std::size_t>(third / 2)];
  };
  return median(samples.end() - third) - median(samples.end() - 2 * third);
}

}  // namespace ode_ext::soak
