// SPDX-License-Identifier: BSD-3-Clause
#include "view/image.h"

#include <stdexcept>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace view {

void write_png(const std::string& path, const Image& image) {
  const int row = 3 * image.size.width;
  if (stbi_write_png(path.c_str(), image.size.width, image.size.height, 3, image.rgb.data(), row) ==
      0) {
    throw std::runtime_error("cannot write the picture '" + path + "': is there such a folder?");
  }
}

}  // namespace view
