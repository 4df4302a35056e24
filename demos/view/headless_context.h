// SPDX-License-Identifier: BSD-3-Clause
// An OpenGL 3.3 context without a window, a screen or an X server (EGL).
#pragma once

#include <stdexcept>
#include <string>

namespace view {

// No picture can be drawn on this machine; what() says why and what to do.
struct NoPictures : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class HeadlessContext {
 public:
  // Makes it current in this thread. Throws NoPictures.
  HeadlessContext();
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

 private:
  void* display_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace view
