// SPDX-License-Identifier: BSD-3-Clause
// Where pictures go: numbered files, one file, a film; in any combination.
#pragma once

#include <optional>
#include <string>

#include "view/image.h"
#include "view/video.h"

namespace view {

// "out/%04d.png": the name of each picture. Throws std::runtime_error unless it has one such number
// at most and nothing else with a percent sign.
std::string numbered(const std::string& pattern, int number);
bool has_number(const std::string& pattern);

class Film {
 public:
  // Empty: none. `pictures` with a number in its name gets all of them, without one the end alone.
  Film(std::string pictures, std::string video, Size size, double fps);

  bool wants_all() const { return video_ || has_number(pictures_); }
  bool wants_end() const { return !pictures_.empty() && !has_number(pictures_); }

  void add(const Image& image);
  void add_end(const Image& image);
  void finish();

  int count() const { return count_; }  // without that of the end
  // What was made, for a user to read: "end.png and out.mp4".
  std::string made() const;

 private:
  std::string pictures_, video_path_;
  std::optional<Video> video_;
  int count_ = 0;
};

}  // namespace view
