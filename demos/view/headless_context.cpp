// SPDX-License-Identifier: BSD-3-Clause
#include "view/headless_context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>
#include <vector>

namespace view {
namespace {

// libepoxy ends the process where it finds no libEGL: it is looked for before.
void require_library() {
  if (dlopen("libEGL.so.1", RTLD_LAZY) == nullptr) {
    throw NoPictures(
        "there is no libEGL.so.1 to draw pictures with: install libegl1 and libgl1-mesa-dri");
  }
}

// Graphics cards first, then Mesa without any device, which draws on the processor. A card's driver
// may be installed where there is no card: each is tried.
std::vector<EGLDisplay> displays() {
  std::vector<EGLDisplay> found;
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration") &&
      epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device")) {
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count);
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      const char* has = eglQueryDeviceStringEXT(devices[i], EGL_EXTENSIONS);
      if (has != nullptr &&
          std::string(has).find("EGL_MESA_device_software") != std::string::npos) {
        continue;
      }
      found.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
    }
  }
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    found.push_back(
        eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  }
  return found;
}

EGLContext make_context(EGLDisplay display) {
  if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE) {
    return EGL_NO_CONTEXT;
  }
  eglBindAPI(EGL_OPENGL_API);
  constexpr std::array<EGLint, 3> kConfig{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  constexpr std::array<EGLint, 7> kContext{EGL_CONTEXT_MAJOR_VERSION,
                                           3,
                                           EGL_CONTEXT_MINOR_VERSION,
                                           3,
                                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                           EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  eglChooseConfig(display, kConfig.data(), &config, 1, &count);
  const EGLContext context =
      eglCreateContext(display, count > 0 ? config : nullptr, EGL_NO_CONTEXT, kContext.data());
  if (context != EGL_NO_CONTEXT &&
      eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) != EGL_FALSE) {
    return context;
  }
  if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
  eglTerminate(display);
  return EGL_NO_CONTEXT;
}

}  // namespace

HeadlessContext::HeadlessContext() {
  require_library();
  for (const EGLDisplay display : displays()) {
    context_ = make_context(display);
    display_ = display;
    if (context_ != EGL_NO_CONTEXT) return;
  }
  throw NoPictures(
      "no driver draws OpenGL 3.3 without a screen: install libgl1-mesa-dri, which does so on the "
      "processor");
}

HeadlessContext::~HeadlessContext() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  eglTerminate(display_);
}

}  // namespace view
