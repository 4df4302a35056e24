// SPDX-License-Identifier: BSD-3-Clause
// Everything that is drawn. A build without graphics libraries has another implementation
// (show/absent.cpp), which says so.
#pragma once

#include <memory>

#include "falling_objects/spectator.h"

namespace falling_objects {

// Pictures and films as the options ask for them; null if they do not. Throws UsageError where it
// cannot be done.
std::unique_ptr<Spectator> make_film(const World& world);

// There is a display, and a window to put there. Warns where the display cannot be had.
bool can_show_window();

// Until the user closes it. Returns the exit code.
int show_window(const Options& options);

}  // namespace falling_objects
