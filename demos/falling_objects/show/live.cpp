// SPDX-License-Identifier: BSD-3-Clause
// The window.
#include <GLFW/glfw3.h>
#include <imgui/imgui.h>

#include <chrono>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <optional>
#include <set>

#include "falling_objects/measured_world.h"
#include "falling_objects/show.h"
#include "falling_objects/show/hand.h"
#include "falling_objects/show/panel.h"
#include "falling_objects/usage_error.h"
#include "view/canvas.h"
#include "view/gui.h"
#include "view/headless_context.h"
#include "view/processor_time.h"
#include "view/studio.h"
#include "view/window.h"

namespace falling_objects {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// A world in the window.
struct Pane {
  Pane(const Options& options, bool both_colliders, view::Renderer& renderer)
      : measured(options, both_colliders), view(measured.world(), renderer) {}

  MeasuredWorld measured;
  WorldView view;
  History history;
};

// All that a picture hangs on: it is drawn anew when one of these is another.
struct Shown {
  view::Camera camera;
  std::set<std::string> overlays;
  view::Size size;
  int moment = 0;

  bool operator==(const Shown&) const = default;
};

class Live {
 public:
  explicit Live(const Options& options)
      : options_(options),
        pictures_(options.pictures),
        window_({pictures_.width, pictures_.height}, "falling_objects"),
        gui_({pictures_.width, pictures_.height}, window_.handle()) {
    say({"One moment", "The first time on a machine, the collider's kernels are compiled,",
         "which takes 10 to 30 s."});
    restart();
    home();
  }

  void run() {
    auto last = opened_ = Clock::now();
    while (window_.open()) {
      window_.poll(patience());
      gui_.begin();
      const double passed = seconds_since(last);
      last = Clock::now();
      draw_panel(pane().measured.world(), pane().view, pane().history, rate_, pictures_, wishes_);
      take_keys();
      take_mouse();
      grant();
      advance(passed);
      show();
    }
  }

  void say_what_was(std::ostream& out) {
    World& world = pane().measured.world();
    const bool batch = world.options().collider == Collider::kBatch;
    out << std::fixed << std::setprecision(3) << "closed after " << pane().view.record().step + 1
        << " steps with " << world.scene().objects().size() << " objects, driven by "
        << (batch ? "the batch" : "ODE's own collider") << ", " << thrown_ << " thrown; " << drawn_
        << " pictures, " << std::lround(drawn_ / seconds_since(opened_)) << " a second, of "
        << drawing_ / std::max(drawn_, 1) << " s of processor time each, drawn by "
        << view::renderer_name() << '\n';
  }

 private:
  // The batch's, to the right.
  Pane& pane() { return *panes_.back(); }

  void restart() {
    hand_.release();
    panes_.clear();
    renderer_ = std::make_unique<view::Renderer>(quality_);
    if (pictures_.beside_ode) {
      panes_.push_back(std::make_unique<Pane>(options_beside(options_), false, *renderer_));
    }
    // One may drive and then the other, but for sheets, which ODE's own collider does not know.
    const bool both = !options_.has_sheets() && ode_exports_its_collider();
    panes_.push_back(std::make_unique<Pane>(options_, both, *renderer_));
    light();
    ++moment_;
  }

  // All but the panel.
  view::Size picture_points() const {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    return {std::max(static_cast<int>(screen.x - kPanelWidth), 16),
            std::max(static_cast<int>(screen.y), 16)};
  }
  view::Size picture_pixels() const {
    const view::Size points = picture_points(), pixels = window_.pixels();
    const float density = static_cast<float>(pixels.height) / static_cast<float>(points.height);
    return {static_cast<int>(static_cast<float>(points.width) * density), pixels.height};
  }

  void home() {
    camera_ = home_ = camera_of(options_, pane().view,
                                view::side_by_side(picture_points(), panes_.size())[0].aspect());
    light();
  }

  void light() {
    for (const auto& each : panes_) each->view.light_from(home_);
  }

  void say(const std::vector<std::string>& lines) {
    window_.poll();
    gui_.begin();
    const view::Size size = picture_points();
    gui_.caption(lines, {0, 0, size}, size.height);
    glClearColor(0.8F, 0.82F, 0.85F, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    gui_.end();
    window_.swap();
  }

  void take_keys() {
    if (ImGui::GetIO().WantTextInput) return;
    const auto pressed = [&](int key) { return window_.pressed(key); };
    if (pressed(GLFW_KEY_P) || pressed(GLFW_KEY_SPACE)) wishes_.paused = !wishes_.paused;
    if (pressed(GLFW_KEY_O)) wishes_.step = true;
    if (pressed(GLFW_KEY_R)) wishes_.restart = true;
    if (pressed(GLFW_KEY_D)) wishes_.drop = true;
    if (pressed(GLFW_KEY_C)) wishes_.other_collider = true;
    if (pressed(GLFW_KEY_H)) wishes_.camera_home = true;
    if (pressed(GLFW_KEY_ESCAPE)) window_.close();
  }

  // Where the mouse is in the pane it is over, and that pane's number.
  struct Pointer {
    std::size_t pane;
    glm::vec3 direction;
  };
  Pointer pointer() const {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const glm::vec2 size(picture_points().width, picture_points().height);
    const float count = static_cast<float>(panes_.size());
    const float across = glm::clamp(mouse.x / size.x, 0.0F, 0.9999F) * count;
    const float pane = std::floor(across);
    const glm::vec2 place(2 * (across - pane) - 1, 1 - 2 * mouse.y / size.y);
    return {static_cast<std::size_t>(pane), camera_.ray(place, size.x / count / size.y)};
  }

  void take_mouse() {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.WantCaptureMouse && !hand_.holds()) return;
    const glm::vec2 by(io.MouseDelta.x / io.DisplaySize.y, io.MouseDelta.y / io.DisplaySize.y);
    const bool shifts = ImGui::IsMouseDown(ImGuiMouseButton_Middle) ||
                        (ImGui::IsMouseDown(ImGuiMouseButton_Left) && io.KeyShift);
    if (shifts) {
      camera_.shift({-by.x, by.y});
    } else if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
      camera_.turn(-4 * by.x, 4 * by.y);
    }
    if (io.MouseWheel != 0) camera_.zoom(std::pow(0.88F, io.MouseWheel));
    const Pointer at = pointer();
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Right)) {
      held_ = at.pane;
      hand_.take(panes_[held_]->measured.world().scene().space(), camera_.eye(), at.direction);
    }
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Right) && hand_.holds()) {
      hand_.release();
      ++thrown_;
    }
    if (hand_.holds()) hand_.move(camera_.eye(), at.direction);
  }

  void grant() {
    if (wishes_.restart) restart();
    if (wishes_.camera_home) home();
    for (const auto& each : panes_) {
      World& world = each->measured.world();
      if (wishes_.drop && world.sheets() == nullptr) world.scene().drop(10);
    }
    if (wishes_.drop || wishes_.other_collider) ++moment_;
    World& world = pane().measured.world();
    if (wishes_.other_collider && world.has_both_colliders()) {
      const bool batch = world.options().collider == Collider::kBatch;
      world.drive_by(batch ? Collider::kOde : Collider::kBatch);
    }
    if (wishes_.step) wishes_.paused = true;
    if (wishes_.step) step();
    const bool paused = wishes_.paused;
    wishes_ = {};
    wishes_.paused = paused;
  }

  // [s] that nothing is to be done for, unless the user does something.
  double patience() const { return wishes_.paused ? 0.1 : std::max(0.0, 1 / options_.hz - owed_); }

  // As many steps as time has passed, unless they take longer than that: then a picture each.
  void advance(double passed) {
    constexpr double kPatience = 0.03;  // [s] between two pictures
    if (wishes_.paused) return;
    const double dt = 1 / options_.hz;
    const auto start = Clock::now();
    owed_ = std::min(owed_ + passed, 0.1);
    while (owed_ >= dt) {
      owed_ -= dt;
      step();
      if (seconds_since(start) > kPatience) owed_ = 0;
    }
  }

  void step() {
    hand_.pull();
    for (const auto& each : panes_) {
      const StepRecord record = each->measured.step();
      each->view.note(record);
      each->history.add(each->measured.world(), record);
    }
    ++moment_;
  }

  void show() {
    const double start = view::processor_time();
    const Shown now{camera_, pictures_.overlays, picture_pixels(), moment_};
    const bool anew = now != shown_;
    if (anew) draw(now.size);
    shown_ = now;
    const view::Size points = picture_points();
    const auto parts = view::side_by_side(points, panes_.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      gui_.caption(captions_[i], parts[i], points.height);
    }
    canvas_->show();
    gui_.end();
    window_.swap();
    if (!anew) return;
    ++drawn_;
    drawing_ += view::processor_time() - start;
    const double took = seconds_since(last_drawn_);
    last_drawn_ = Clock::now();
    rate_ += 0.2F * (static_cast<float>(1 / took) - rate_);
  }

  void draw(view::Size size) {
    if (!canvas_ || canvas_->size() != size) canvas_.emplace(size, quality_.samples);
    const auto parts = view::side_by_side(size, panes_.size());
    canvas_->begin();
    glClearColor(1, 1, 1, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    captions_.clear();
    for (std::size_t i = 0; i < panes_.size(); ++i) {
      const view::Frame frame = panes_[i]->view.frame(pictures_);
      renderer_->draw(frame, camera_, parts[i]);
      captions_.push_back(frame.caption);
    }
    canvas_->resolve();
  }

  Options options_;
  PictureOptions pictures_;
  view::Window window_;
  view::Gui gui_;
  view::Quality quality_ = view::quality_of_driver(true);
  std::optional<view::Canvas> canvas_;
  std::unique_ptr<view::Renderer> renderer_;
  std::vector<std::unique_ptr<Pane>> panes_;
  view::Camera camera_, home_;
  Hand hand_;
  std::size_t held_ = 0;
  int thrown_ = 0;
  Wishes wishes_;
  double owed_ = 0;  // [s] that the worlds are behind
  int moment_ = 0;   // counts what changes the worlds
  std::optional<Shown> shown_;
  std::vector<std::vector<std::string>> captions_;
  Clock::time_point opened_ = Clock::now(), last_drawn_ = opened_;
  int drawn_ = 0;       // pictures since then
  double drawing_ = 0;  // [s] of processors that they took
  float rate_ = 0;      // of late, pictures a second
};

}  // namespace

bool can_show_window() {
  if (!view::has_display()) return false;
  const std::string why_not = view::why_no_window();
  if (!why_not.empty()) std::cerr << "warning: " << why_not << '\n';
  return why_not.empty();
}

int show_window(const Options& options) {
  try {
    Live live(options);
    live.run();
    live.say_what_was(std::cout);
  } catch (const view::NoPictures& e) {
    throw UsageError(std::string(e.what()) + "; --no-window does without");
  }
  return kExitOk;
}

}  // namespace falling_objects
