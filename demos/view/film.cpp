// SPDX-License-Identifier: BSD-3-Clause
#include "view/film.h"

#include <cctype>
#include <filesystem>
#include <stdexcept>
#include <utility>

namespace view {
namespace {

struct Number {
  std::size_t from, to;  // of the pattern
  std::size_t digits;
};

std::optional<Number> find_number(const std::string& pattern) {
  const std::size_t from = pattern.find('%');
  if (from == std::string::npos) return {};
  std::size_t to = from + 1;
  std::size_t digits = 0;
  while (to < pattern.size() && std::isdigit(static_cast<unsigned char>(pattern[to])) != 0) {
    digits = 10 * digits + static_cast<std::size_t>(pattern[to++] - '0');
  }
  if (to == pattern.size() || pattern[to] != 'd' || digits > 12 ||
      pattern.find('%', to) != std::string::npos) {
    throw std::runtime_error("'" + pattern +
                             "' is no name for pictures: one number at most, as in %04d");
  }
  return Number{from, to + 1, digits};
}

void make_folder_of(const std::string& path) {
  const auto folder = std::filesystem::path(path).parent_path();
  std::error_code ignored;  // writing into it says what is wrong
  if (!folder.empty()) std::filesystem::create_directories(folder, ignored);
}

}  // namespace

bool has_number(const std::string& pattern) { return find_number(pattern).has_value(); }

std::string numbered(const std::string& pattern, int number) {
  const auto place = find_number(pattern);
  if (!place) return pattern;
  std::string digits = std::to_string(number);
  if (digits.size() < place->digits) digits.insert(0, place->digits - digits.size(), '0');
  return pattern.substr(0, place->from) + digits + pattern.substr(place->to);
}

Film::Film(std::string pictures, std::string video, Size size, double fps)
    : pictures_(std::move(pictures)), video_path_(std::move(video)) {
  if (!pictures_.empty()) make_folder_of(numbered(pictures_, 0));
  if (video_path_.empty()) return;
  make_folder_of(video_path_);
  video_.emplace(video_path_, size, fps);
}

void Film::add(const Image& image) {
  if (video_) video_->add(image);
  if (has_number(pictures_)) write_png(numbered(pictures_, count_), image);
  ++count_;
}

void Film::add_end(const Image& image) { write_png(pictures_, image); }

void Film::finish() {
  if (video_) video_->finish();
}

std::string Film::made() const {
  std::string text = pictures_;
  if (has_number(pictures_)) {
    text = numbered(pictures_, 0) + " to " + numbered(pictures_, count_ - 1);
  }
  if (!video_path_.empty()) text += (text.empty() ? "" : " and ") + video_path_;
  return text;
}

}  // namespace view
