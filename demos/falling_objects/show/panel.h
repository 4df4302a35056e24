// SPDX-License-Identifier: BSD-3-Clause
// The panel of the window: what happens in a step, and what a user can change.
#pragma once

#include "falling_objects/show/history.h"
#include "falling_objects/show/world_view.h"

namespace falling_objects {

// What the user wants; the window does it, and puts back what is done once.
struct Wishes {
  bool paused = false;
  bool step = false;
  bool restart = false;
  bool drop = false;
  bool other_collider = false;
  bool camera_home = false;
};

inline constexpr float kPanelWidth = 290;  // [pixels], at the right of the window

void draw_panel(const World& world, const WorldView& view, const History& history, float fps,
                PictureOptions& pictures, Wishes& wishes);

}  // namespace falling_objects
