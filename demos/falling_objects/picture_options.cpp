// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/picture_options.h"

#include <CLI/CLI.hpp>
#include <sstream>
#include <vector>

#include "falling_objects/option_checks.h"
#include "falling_objects/output_file.h"

namespace falling_objects {
namespace {

// Even: what films are made of (yuv420p) has half as many pixels of color.
bool read_size(const std::string& text, PictureOptions& options) {
  std::istringstream in(text);
  char times = 0, rest = 0;
  int width = 0, height = 0;
  if (!(in >> width >> times >> height) || times != 'x' || in >> rest) return false;
  const auto fits = [](int side) { return side >= 64 && side <= 8192 && side % 2 == 0; };
  if (!fits(width) || !fits(height)) return false;
  options.width = width;
  options.height = height;
  return true;
}

std::vector<std::string> overlay_names() {
  std::vector<std::string> names(kOverlays.begin(), kOverlays.end());
  names.emplace_back("none");
  return names;
}

}  // namespace

void add_picture_options(CLI::App& app, PictureOptions& o) {
  const auto add = [&](const char* name, auto& value, const char* help) {
    return app.add_option(name, value, help)->group("Pictures");
  };
  app.add_flag("--window", o.window,
               "Show the run in a window, and let it be steered (default where there is a display "
               "and no other output is asked for)")
      ->group("Pictures");
  app.add_flag("--no-window", o.no_window, "Never")->excludes("--window")->group("Pictures");
  add("--frames", o.frames,
      "Write pictures to PNG files: out/%04d.png; without a number one of the end")
      ->check(ends_in({".png"}))
      ->check(why_not_written);
  add("--video", o.video, "Make a film by ffmpeg: FILE.mp4, .webm, .webp or .gif")
      ->check(ends_in({".mp4", ".webm", ".webp", ".gif"}))
      ->check(why_not_written);
  app.add_option_function<std::string>(
         "--size",
         [&o](const std::string& text) {
           if (!read_size(text, o)) {
             throw CLI::ValidationError("--size",
                                        "wants two even numbers from 64 to 8192, as in 1280x720");
           }
         },
         "Of pictures and window, pixels (default: 1280x720)")
      ->group("Pictures");
  add("--fps", o.fps, "Pictures per simulated second")
      ->check(within(0.1, 1000))
      ->capture_default_str();
  add("--camera", o.camera,
      "Eye and target, x,y,z:x,y,z [m]; or azimuth,elevation[,distance] [degrees, m]");
  app.add_option("--overlay", o.overlays,
                 "What is drawn over the objects: any of caption (default), contacts (arrows along "
                 "their normals, as long as they are deep), touched (the triangles that contacts "
                 "name), regions (of overlap, each a color, as its contacts span it), meshlets "
                 "(clusters of triangles that ode_ext collides at a time), inside (what is wholly "
                 "inside something, through what it is in), boxes (as ODE's broad phase has them); "
                 "or none")
      ->delimiter(',')
      ->check(CLI::IsMember(overlay_names()))
      ->group("Pictures");
  app.add_option_function<std::string>(
         "--beside", [&o](const std::string&) { o.beside_ode = true; },
         "ode: a second world from the same start, driven by ODE's own collider, to the left")
      ->check(CLI::IsMember({"ode"}))
      ->group("Pictures");
}

}  // namespace falling_objects
