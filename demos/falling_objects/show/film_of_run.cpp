// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <optional>

#include "falling_objects/penetration.h"
#include "falling_objects/show.h"
#include "falling_objects/show/caption.h"
#include "falling_objects/show/space_view.h"
#include "falling_objects/usage_error.h"
#include "view/film.h"
#include "view/studio.h"

namespace falling_objects {
namespace {

view::Size size_of(const PictureOptions& options) { return {options.width, options.height}; }

class FilmOfRun : public Spectator {
 public:
  explicit FilmOfRun(const World& world)
      : world_(world),
        options_(world.options().pictures),
        studio_(size_of(options_)),
        view_(studio_.renderer()),
        film_(options_.frames, options_.video, size_of(options_), options_.fps) {
    const view::Frame start = frame_of(world_, {});
    camera_ = overview(start);
    if (!options_.camera.empty()) {
      const auto camera = view::parse_camera(options_.camera, camera_);
      if (!camera) {
        throw UsageError("--camera wants x,y,z:x,y,z or azimuth,elevation[,distance], not '" +
                         options_.camera + "'");
      }
      camera_ = *camera;
    }
    draw({});
  }

  void after_step(const StepRecord& record) override {
    if (record.deepest_penetration >= 0) deepest_ = record.deepest_penetration;
    // As many as should be there by the end of this step.
    const double due = (record.step + 1) * options_.fps / world_.options().hz;
    while (film_.count() <= static_cast<int>(std::floor(due + 1e-9))) draw(record);
  }

  void finish(std::ostream& out) override {
    film_.finish();
    out << "\npictures: " << film_.made() << " (" << film_.count() << " pictures, drawn by "
        << view::renderer_name() << ")\n";
  }

 private:
  view::Frame frame_of(const World& world, const StepRecord& record) {
    const Overlays overlays{options_.shows("contacts"), options_.shows("touched"),
                            options_.shows("boxes")};
    view::Frame frame =
        view_.frame(world.scene().space(), world.sheets(), world.simulation().contacts(), overlays);
    if (options_.shows("caption")) frame.caption = caption(world.options(), record, deepest_);
    return frame;
  }

  void draw(const StepRecord& record) {
    view::Frame frame = frame_of(world_, record);
    film_.add(studio_.draw({&frame, 1}, camera_));
  }

  const World& world_;
  const PictureOptions& options_;
  view::Studio studio_;
  SpaceView view_;
  view::Film film_;
  view::Camera camera_;
  double deepest_ = 0;  // [m], as last measured
};

}  // namespace

std::unique_ptr<Spectator> make_film(const World& world) {
  if (!world.options().pictures.has_film()) return nullptr;
  try {
    return std::make_unique<FilmOfRun>(world);
  } catch (const view::NoPictures& e) {
    throw UsageError(e.what());
  }
}

}  // namespace falling_objects
