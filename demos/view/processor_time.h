// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace view {

// What all threads of this process have computed since it began [s], however busy the machine is.
double processor_time();

}  // namespace view
