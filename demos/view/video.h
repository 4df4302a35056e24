// SPDX-License-Identifier: BSD-3-Clause
// A film that the program ffmpeg encodes while it is drawn.
#pragma once

#include <sys/types.h>

#include <string>

#include "view/image.h"

namespace view {

class Video {
 public:
  // What the file's name ends with says what it is: .mp4, .webm, .gif, .webp. Throws
  // std::runtime_error, as do the others: ffmpeg is missing, or does not like something.
  Video(const std::string& path, Size size, double fps);
  ~Video();
  Video(const Video&) = delete;
  Video& operator=(const Video&) = delete;

  void add(const Image& image);
  void finish();  // waits until the file is there

 private:
  bool ends_well();
  void fail();

  std::string path_;
  pid_t encoder_ = -1;
  int pipe_ = -1;
  int said_ = -1;  // a file in memory: what the encoder says
};

}  // namespace view
