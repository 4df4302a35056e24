// SPDX-License-Identifier: BSD-3-Clause
// fork() copies a process but not its threads, and a driver's threads are what runs its queue: the
// first wait in the child never ends, and a lock that some thread held at that moment is never
// released. So a child of a process that has used OpenCL leaves OpenCL, and all that was made with
// it, alone.
#pragma once

namespace ode_ext {

// From now on children of this process count as lost. Called before the first OpenCL call.
void note_opencl_is_used();

// Whether this process is such a child. Takes no lock.
bool is_lost_by_fork();

}  // namespace ode_ext
