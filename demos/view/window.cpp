// SPDX-License-Identifier: BSD-3-Clause
#include "view/window.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cstdlib>

#include "view/headless_context.h"

namespace view {
namespace {

std::string problem() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text == nullptr ? "no reason is known" : text;
}

}  // namespace

bool has_display() {
  const auto is_set = [](const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0';
  };
  return is_set("DISPLAY") || is_set("WAYLAND_DISPLAY");
}

std::string why_no_window() {
  return glfwInit() == GLFW_FALSE ? "no window can be opened: " + problem() : "";
}

Window::Window(Size size, const std::string& title) {
  const std::string why_not = why_no_window();
  if (!why_not.empty()) throw NoPictures(why_not);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  window_ = glfwCreateWindow(size.width, size.height, title.c_str(), nullptr, nullptr);
  if (window_ == nullptr) {
    const std::string why = problem();
    glfwTerminate();
    throw NoPictures("no window can be opened: " + why);
  }
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  glfwSetWindowUserPointer(window_, &pressed_);
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int) {
    auto& pressed = *static_cast<std::vector<int>*>(glfwGetWindowUserPointer(window));
    if (action != GLFW_RELEASE) pressed.push_back(key);
  });
}

Window::~Window() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

bool Window::open() const { return glfwWindowShouldClose(window_) == GLFW_FALSE; }

void Window::close() { glfwSetWindowShouldClose(window_, GLFW_TRUE); }

Size Window::pixels() const {
  Size size;
  glfwGetFramebufferSize(window_, &size.width, &size.height);
  return {std::max(size.width, 16), std::max(size.height, 16)};
}

void Window::poll(double patience) {
  pressed_.clear();
  if (patience > 0) {
    glfwWaitEventsTimeout(patience);
  } else {
    glfwPollEvents();
  }
}

bool Window::pressed(int key) const {
  return std::find(pressed_.begin(), pressed_.end(), key) != pressed_.end();
}

void Window::swap() { glfwSwapBuffers(window_); }

}  // namespace view
