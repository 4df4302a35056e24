// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace ode_ext {

// Why the dynamic linker would not put a library before this program, the end of a sentence that
// begins with its name; "" if it would. A script is taken for what can be: its interpreter counts.
std::string why_not_preloaded(const std::string& path);

}  // namespace ode_ext
