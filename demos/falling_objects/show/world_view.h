// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "falling_objects/show/space_view.h"
#include "falling_objects/world.h"

namespace falling_objects {

// A world as it is seen: where all is, what the last step said, how deep things were when last
// measured.
class WorldView {
 public:
  WorldView(const World& world, view::Renderer& renderer) : world_(world), view_(renderer) {}

  void note(const StepRecord& record);
  const StepRecord& record() const { return record_; }
  std::optional<double> deepest() const { return deepest_; }  // [m], if it was measured yet

  view::Frame frame(const PictureOptions& options);
  void light_from(const view::Camera& camera) { view_.light_from(camera); }

 private:
  const World& world_;
  SpaceView view_;
  StepRecord record_;
  std::optional<double> deepest_;
};

// As the options say, else as the scene does, or from so much farther that all that moves is seen
// at first in a picture that is `aspect` times as wide as high. Throws UsageError where the
// options' text is none.
view::Camera camera_of(const Options& options, WorldView& world, float aspect);

}  // namespace falling_objects
