// SPDX-License-Identifier: BSD-3-Clause
// A thread that is cancelled (pthread_cancel) while the library works for it is so afterwards: to
// leave a wait for the device would leave the driver's locks behind. Not where code of the
// program's runs, which may leave by longjmp.
#pragma once

#include <pthread.h>

namespace ode_ext {

class NotCancelled {
 public:
  NotCancelled() { pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, &before_); }
  ~NotCancelled() { pthread_setcancelstate(before_, nullptr); }
  NotCancelled(const NotCancelled&) = delete;
  NotCancelled& operator=(const NotCancelled&) = delete;

 private:
  int before_ = PTHREAD_CANCEL_ENABLE;
};

}  // namespace ode_ext
