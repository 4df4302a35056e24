// SPDX-License-Identifier: BSD-3-Clause
// What of a run is drawn, and where to.
#pragma once

#include <array>
#include <set>
#include <string>

namespace CLI {
class App;  // its header takes seconds to compile
}

namespace falling_objects {

// What may be drawn over the objects.
inline constexpr std::array kOverlays{"caption",  "contacts", "touched", "regions",
                                      "meshlets", "inside",   "boxes"};

struct PictureOptions {
  std::string frames;  // a file's name, perhaps with a number in it: "out/%04d.png"
  std::string video;
  int width = 1280, height = 720;  // [pixels]
  double fps = 30;                 // pictures per simulated second
  std::string camera;              // as view::parse_camera; empty: sees all
  std::set<std::string> overlays{"caption"};
  bool beside_ode = false;  // a second world, driven by ODE's own collider
  bool window = false, no_window = false;

  bool has_film() const { return !frames.empty() || !video.empty(); }
  bool shows(const char* overlay) const { return overlays.contains(overlay); }
};

void add_picture_options(CLI::App& app, PictureOptions& options);

}  // namespace falling_objects
