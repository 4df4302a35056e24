// SPDX-License-Identifier: BSD-3-Clause
// A window on the screen (GLFW), with a context of OpenGL 3.3 in it.
#pragma once

#include <string>
#include <vector>

#include "view/image.h"

struct GLFWwindow;

namespace view {

// DISPLAY or WAYLAND_DISPLAY is set.
bool has_display();
// Why no window can be opened there, or "".
std::string why_no_window();

class Window {
 public:
  // Makes its context current. Throws NoPictures.
  Window(Size size, const std::string& title);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  GLFWwindow* handle() const { return window_; }
  bool open() const;
  void close();
  Size pixels() const;
  // Takes what the user did since, and waits so long [s] for it if there is nothing.
  void poll(double patience = 0);
  // Before the last poll, however short (a key of GLFW's).
  bool pressed(int key) const;
  void swap();  // shows what was drawn

 private:
  GLFWwindow* window_ = nullptr;
  std::vector<int> pressed_;
};

}  // namespace view
