// SPDX-License-Identifier: BSD-3-Clause
#include "view/image.h"

#include <fstream>
#include <new>
#include <stdexcept>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace view {

void write_png(const std::string& path, const Image& image) {
  // Not by stbi_write_png, which does not look whether all of the file was written.
  std::string png;
  const auto keep = [](void* to, void* bytes, int count) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(bytes),
                                          static_cast<std::size_t>(count));
  };
  const int row = 3 * image.size.width;
  if (stbi_write_png_to_func(keep, &png, image.size.width, image.size.height, 3, image.rgb.data(),
                             row) == 0)
    throw std::bad_alloc();
  std::ofstream file(path, std::ios::binary);
  if (!file)
    throw std::runtime_error("cannot write the picture '" + path + "': is there such a folder?");
  file.write(png.data(), static_cast<std::streamsize>(png.size()));
  file.close();
  if (!file) throw std::runtime_error("writing the picture '" + path + "' failed");
}

}  // namespace view
