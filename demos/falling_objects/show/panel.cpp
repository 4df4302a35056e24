// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/show/panel.h"

#include <imgui/imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "falling_objects/show/caption.h"

namespace falling_objects {
namespace {

constexpr std::array<ImU32, kParts> kPartColors{
    IM_COL32(120, 170, 220, 255), IM_COL32(150, 120, 200, 255), IM_COL32(235, 140, 60, 255),
    IM_COL32(230, 200, 80, 255),  IM_COL32(110, 190, 130, 255), IM_COL32(140, 140, 150, 255)};

// Each step a column, its parts on top of each other.
void draw_chart(const History& history) {
  constexpr float kHeight = 90;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(corner, {corner.x + width, corner.y + kHeight}, IM_COL32(12, 14, 18, 255));
  const auto top = static_cast<float>(std::max(1.0, history.longest()));
  const float column = width / static_cast<float>(History::kLength);
  float x = corner.x;
  for (const Moment& moment : history.moments()) {
    float y = corner.y + kHeight;
    for (std::size_t i = 0; i < kParts; ++i) {
      const float up = static_cast<float>(moment.ms[i]) / top * kHeight;
      list->AddRectFilled({x, y - up}, {x + std::max(column, 1.0F), y}, kPartColors[i]);
      y -= up;
    }
    x += column;
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.1f ms", static_cast<double>(top));
  list->AddText({corner.x + 4, corner.y + 2}, IM_COL32(230, 230, 235, 255), text);
  ImGui::Dummy({width, kHeight});
}

void draw_times(const History& history) {
  if (history.moments().empty()) return;
  const Moment& last = history.moments().back();
  for (std::size_t i = 0; i < kParts; ++i) {
    ImGui::TextColored(ImColor(kPartColors[i]), "%-15s", kPartNames[i]);
    ImGui::SameLine(150);
    ImGui::Text("%8.2f ms", last.ms[i]);
  }
}

void line(const char* name, long long value) {
  ImGui::TextUnformatted(name);
  ImGui::SameLine(150);
  ImGui::Text("%lld", value);
}

void draw_counts(const World& world, const WorldView& view) {
  const StepRecord& record = view.record();
  line("pairs", record.pairs);
  line("colliding pairs", record.colliding_pairs);
  if (dBatchColliderID batch = world.collision().batch();
      batch != nullptr && world.options().collider == Collider::kBatch) {
    line("crossings", dBatchColliderGetCount(batch, dBatchBufferCrossings));
    line("rays", record.rays);
    line("waits", dBatchColliderGetCount(batch, dBatchCounterSynchronizations));
  }
  line("contacts", record.contacts);
  ImGui::TextUnformatted("penetration");
  ImGui::SameLine(150);
  ImGui::TextUnformatted(view.deepest() ? length_text(*view.deepest()).c_str() : "not measured");
  ImGui::TextUnformatted("mean speed");
  ImGui::SameLine(150);
  ImGui::Text("%.2f m/s", record.mean_speed);
}

void draw_light(bool redone) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float radius = ImGui::GetTextLineHeight() * 0.36F;
  ImGui::GetWindowDrawList()->AddCircleFilled(
      {at.x + radius, at.y + ImGui::GetTextLineHeight() / 2}, radius,
      redone ? IM_COL32(240, 60, 50, 255) : IM_COL32(70, 190, 90, 255));
  ImGui::Dummy({3 * radius, radius});
  ImGui::SameLine();
  ImGui::TextUnformatted(redone ? "redone for larger buffers" : "buffers large enough");
}

void draw_overlays(PictureOptions& pictures) {
  constexpr int kColumns = 3;
  int column = 0;
  for (const char* name : kOverlays) {
    if (column != 0) ImGui::SameLine(8 + static_cast<float>(column) * kPanelWidth / kColumns);
    column = (column + 1) % kColumns;
    bool shown = pictures.shows(name);
    if (ImGui::Checkbox(name, &shown)) {
      if (shown) {
        pictures.overlays.insert(name);
      } else {
        pictures.overlays.erase(name);
      }
    }
  }
}

}  // namespace

void draw_panel(const World& world, const WorldView& view, const History& history, float fps,
                PictureOptions& pictures, Wishes& wishes) {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({screen.x - kPanelWidth, 0});
  ImGui::SetNextWindowSize({kPanelWidth, screen.y});
  ImGui::SetNextWindowBgAlpha(1);
  ImGui::Begin(
      "falling_objects", nullptr,
      ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
  // One line, cut off at the edge, so that what is below has its place whatever the device's name.
  const std::string device = world.collision().device();
  ImGui::TextUnformatted(device.empty() ? "no batch collider" : device.c_str());
  if (!device.empty() && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", device.c_str());
  const std::string rate =
      wishes.paused ? "paused" : std::to_string(std::lround(fps)) + " pictures/s";
  ImGui::Text("%zu objects, step %d, %s", world.scene().objects().size(), view.record().step + 1,
              rate.c_str());

  if (ImGui::Button(wishes.paused ? "Run [P]" : "Pause [P]")) wishes.paused = !wishes.paused;
  ImGui::SameLine();
  if (ImGui::Button("Step [O]")) wishes.step = true;
  ImGui::SameLine();
  if (ImGui::Button("Restart [R]")) wishes.restart = true;
  ImGui::BeginDisabled(world.sheets() != nullptr);
  if (ImGui::Button("Drop ten [D]")) wishes.drop = true;
  ImGui::EndDisabled();
  ImGui::SameLine();
  if (ImGui::Button("Camera [H]")) wishes.camera_home = true;
  ImGui::Separator();
  const bool batch = world.options().collider == Collider::kBatch;
  ImGui::BeginDisabled(!world.has_both_colliders());
  if (ImGui::RadioButton("ode_ext [C]", batch) && !batch) wishes.other_collider = true;
  ImGui::SameLine(150);
  if (ImGui::RadioButton("ODE's own [C]", !batch) && batch) wishes.other_collider = true;
  ImGui::EndDisabled();
  ImGui::Separator();
  draw_chart(history);
  draw_times(history);
  ImGui::Separator();
  draw_counts(world, view);
  if (batch) draw_light(history.redone_lately(world.options().hz));
  ImGui::Separator();
  draw_overlays(pictures);
  ImGui::Separator();
  ImGui::TextDisabled("left: turn  middle: shift  wheel: zoom\nright: take, pull and throw");
  ImGui::End();
}

}  // namespace falling_objects
