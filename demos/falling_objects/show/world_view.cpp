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
                          options.shows("boxes"),    options.shows("regions"),
                          options.shows("meshlets"), options.shows("inside")};
  const bool batch = world_.options().collider == Collider::kBatch;
  view::Frame frame =
      view_.frame(world_.scene().space(), world_.sheets(), world_.simulation().contacts(), overlays,
                  batch ? world_.collision().batch() : nullptr);
  if (options.shows("caption")) frame.caption = caption(world_.options(), record_, deepest_);
  return frame;
}

view::Camera camera_of(const Options& options, const view::Frame& frame) {
  view::Camera start = overview(frame);
  if (const auto& hint = options.description.camera) {
    const auto place = [](const Point& p) { return glm::vec3(glm::dvec3(p[0], p[1], p[2])); };
    start = view::camera_at(place(hint->eye), place(hint->target));
  }
  const std::string& text = options.pictures.camera;
  if (text.empty()) return start;
  const auto camera = view::parse_camera(text, start);
  if (!camera) {
    throw UsageError("--camera wants x,y,z:x,y,z or azimuth,elevation[,distance], not '" + text +
                     "'");
  }
  return *camera;
}

}  // namespace falling_objects
