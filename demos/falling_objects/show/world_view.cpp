// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/show/world_view.h"

#include "falling_objects/show/caption.h"
#include "falling_objects/usage_error.h"

namespace falling_objects {

void WorldView::note(const StepRecord& record) {
  record_ = record;
  if (record.deepest_penetration >= 0) deepest_ = record.deepest_penetration;
}

view::Frame WorldView::frame(const PictureOptions& options) {
  const Overlays overlays{options.shows("contacts"), options.shows("touched"),
                          options.shows("boxes")};
  view::Frame frame = view_.frame(world_.scene().space(), world_.sheets(),
                                  world_.simulation().contacts(), overlays);
  if (options.shows("caption")) frame.caption = caption(world_.options(), record_, deepest_);
  return frame;
}

view::Camera camera_of(const PictureOptions& options, const view::Frame& frame) {
  const view::Camera all = overview(frame);
  if (options.camera.empty()) return all;
  const auto camera = view::parse_camera(options.camera, all);
  if (!camera) {
    throw UsageError("--camera wants x,y,z:x,y,z or azimuth,elevation[,distance], not '" +
                     options.camera + "'");
  }
  return *camera;
}

}  // namespace falling_objects
