// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <iomanip>
#include <optional>
#include <stdexcept>

#include "falling_objects/measured_world.h"
#include "falling_objects/show.h"
#include "falling_objects/show/world_view.h"
#include "falling_objects/usage_error.h"
#include "view/film.h"
#include "view/processor_time.h"
#include "view/studio.h"

namespace falling_objects {
namespace {

view::Size size_of(const PictureOptions& options) { return {options.width, options.height}; }

// Of what one world is drawn into.
float aspect_of(const PictureOptions& options) {
  return view::side_by_side(size_of(options), options.beside_ode ? 2 : 1)[0].aspect();
}

class FilmOfRun : public Spectator {
 public:
  explicit FilmOfRun(const World& world)
      : hz_(world.options().hz),
        options_(world.options().pictures),
        studio_(size_of(options_)),
        view_(world, studio_.renderer()),
        camera_(camera_of(world.options(), view_, aspect_of(options_))) {
    if (options_.beside_ode) {
      beside_ = std::make_unique<MeasuredWorld>(options_beside(world.options()));
      beside_view_ = std::make_unique<WorldView>(beside_->world(), studio_.renderer());
      beside_view_->light_from(camera_);
    }
    view_.light_from(camera_);
    // Last: it replaces the film of that name, which what is refused above must leave alone.
    film_.emplace(options_.frames, options_.video, size_of(options_), options_.fps);
    if (film_->wants_all()) film_->add(draw());
  }

  void after_step(const StepRecord& record) override {
    view_.note(record);
    if (beside_) beside_view_->note(beside_->step());
    if (!film_->wants_all()) return;
    // As many as should be there by the end of this step.
    const double due = (record.step + 1) * options_.fps / hz_;
    while (film_->count() <= static_cast<int>(std::floor(due + 1e-9))) film_->add(draw());
  }

  void finish(std::ostream& out) override {
    if (film_->wants_end()) film_->add_end(draw());
    film_->finish();
    const int count = film_->count() + static_cast<int>(film_->wants_end());
    out << std::setprecision(3) << "\npictures: " << film_->made() << " (" << count
        << " pictures, of " << drawing_ / count << " s of processor time each, drawn by "
        << view::renderer_name() << ")\n";
  }

 private:
  view::Image draw() {
    const double start = view::processor_time();
    std::vector<view::Frame> frames;
    if (beside_) frames.push_back(beside_view_->frame(options_));
    frames.push_back(view_.frame(options_));
    view::Image image = studio_.draw(frames, camera_);
    drawing_ += view::processor_time() - start;
    return image;
  }

  double hz_;
  PictureOptions options_;
  view::Studio studio_;
  WorldView view_;
  view::Camera camera_;
  double drawing_ = 0;  // [s] of processors
  std::unique_ptr<MeasuredWorld> beside_;
  std::unique_ptr<WorldView> beside_view_;
  std::optional<view::Film> film_;
};

}  // namespace

std::unique_ptr<Spectator> make_film(const World& world) {
  const PictureOptions& options = world.options().pictures;
  if (!options.has_film()) {
    if (options.beside_ode) throw UsageError("--beside wants --frames, --video or --window");
    return nullptr;
  }
  try {
    return std::make_unique<FilmOfRun>(world);
  } catch (const std::runtime_error& e) {  // no driver, no ffmpeg, no such name or camera
    throw UsageError(e.what());
  }
}

}  // namespace falling_objects
