// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace falling_objects {

enum ExitCode { kExitOk = 0, kExitCheckFailed = 1, kExitUsage = 2, kExitNoDevice = 3 };

}  // namespace falling_objects
