// SPDX-License-Identifier: BSD-3-Clause
#include "view/processor_time.h"

#include <ctime>

namespace view {

double processor_time() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace view
