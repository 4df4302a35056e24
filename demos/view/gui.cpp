// SPDX-License-Identifier: BSD-3-Clause
#include "view/gui.h"

#include <imgui/backends/imgui_impl_glfw.h>
#include <imgui/backends/imgui_impl_opengl3.h>
#include <imgui/imgui.h>

#include <algorithm>
#include <filesystem>

namespace view {
namespace {

// Debian's fonts-dejavu-core. Without it there is the font that comes with Dear ImGui.
constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

constexpr float kTitle = 1.25F;  // how much larger the first line is

// Readable in small pictures, not huge in large ones [pixels].
float font_size(int height) { return std::clamp(static_cast<float>(height) / 36, 12.0F, 30.0F); }

}  // namespace

Gui::Gui(Size size, GLFWwindow* window) : window_(window) {
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // leaves no file behind
  io.DisplaySize = {static_cast<float>(size.width), static_cast<float>(size.height)};
  const float pixels = window == nullptr ? font_size(size.height) : 15;
  if (std::filesystem::exists(kFont)) {
    io.Fonts->AddFontFromFileTTF(kFont, kTitle * pixels);
    io.FontGlobalScale = 1 / kTitle;
  } else {
    ImFontConfig config;
    config.SizePixels = pixels;
    io.Fonts->AddFontDefault(&config);
  }
  ImGui::StyleColorsDark();
  ImGui::GetStyle().WindowRounding = 4;
  if (window != nullptr) ImGui_ImplGlfw_InitForOpenGL(window, true);
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

Gui::~Gui() {
  ImGui_ImplOpenGL3_Shutdown();
  if (window_ != nullptr) ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void Gui::begin() {
  ImGui_ImplOpenGL3_NewFrame();
  if (window_ != nullptr) {
    ImGui_ImplGlfw_NewFrame();
  } else {
    ImGui::GetIO().DeltaTime = 1.0F / 60;
  }
  ImGui::NewFrame();
}

void Gui::caption(const std::vector<std::string>& lines, const Viewport& viewport, int height) {
  if (lines.empty()) return;
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  ImFont* font = ImGui::GetFont();
  const float size = window_ == nullptr ? font_size(height) : 15;
  const auto size_of = [&](std::size_t line) { return line == 0 ? kTitle * size : size; };
  ImVec2 box{0, 0};
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const ImVec2 extent = font->CalcTextSizeA(size_of(i), 1e9F, 0, lines[i].c_str());
    box.x = std::max(box.x, extent.x);
    box.y += 1.25F * size_of(i);
  }
  const float margin = 0.6F * size;
  const ImVec2 corner{static_cast<float>(viewport.x) + margin,
                      static_cast<float>(height - viewport.y - viewport.size.height) + margin};
  list->AddRectFilled(corner, {corner.x + box.x + 2 * margin, corner.y + box.y + 1.2F * margin},
                      IM_COL32(20, 24, 32, 185), 0.4F * size);
  float y = corner.y + 0.7F * margin;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    list->AddText(font, size_of(i), {corner.x + margin, y}, IM_COL32(245, 246, 248, 255),
                  lines[i].c_str());
    y += 1.25F * size_of(i);
  }
}

void Gui::end() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace view
