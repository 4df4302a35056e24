// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/show/world_view.h"

#include <vector>

#include "falling_objects/show/caption.h"
#include "falling_objects/usage_error.h"

namespace falling_objects {
namespace {

std::vector<glm::vec3> corners_of(const std::vector<view::Box>& boxes) {
  std::vector<glm::vec3> corners;
  for (const view::Box& box : boxes) {
    for (unsigned i = 0; i < 8; ++i) {
      corners.push_back(glm::mix(box.low, box.high, glm::vec3(i & 1U, (i >> 1U) & 1U, i >> 2U)));
    }
  }
  return corners;
}

}  // namespace

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

view::Camera camera_of(const Options& options, WorldView& world, float aspect) {
  PictureOptions with_boxes;
  with_boxes.overlays = {"boxes"};
  const view::Frame frame = world.frame(with_boxes);
  view::Camera start = overview(frame);
  if (const auto& hint = options.description.camera) {
    const auto place = [](const Point& p) { return glm::vec3(glm::dvec3(p[0], p[1], p[2])); };
    start = view::camera_at(place(hint->eye), place(hint->target));
  }
  const std::string& text = options.pictures.camera;
  if (text.empty()) return view::seeing(start, corners_of(frame.boxes), aspect);
  const auto camera = view::parse_camera(text, start);
  if (!camera) {
    throw UsageError(
        "--camera wants x,y,z:x,y,z, an eye and a target elsewhere, or "
        "azimuth,elevation[,distance], not '" +
        text + "'");
  }
  return *camera;
}

}  // namespace falling_objects
