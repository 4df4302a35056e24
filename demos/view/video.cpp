// SPDX-License-Identifier: BSD-3-Clause
#include "view/video.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <vector>

namespace view {
namespace {

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::vector<std::string> command(const std::string& path, Size size, double fps) {
  std::vector<std::string> words{"ffmpeg",
                                 "-hide_banner",
                                 "-loglevel",
                                 "level+error",
                                 "-y",
                                 "-f",
                                 "rawvideo",
                                 "-pix_fmt",
                                 "rgb24",
                                 "-video_size",
                                 std::to_string(size.width) + "x" + std::to_string(size.height),
                                 "-framerate",
                                 std::to_string(fps),
                                 "-i",
                                 "pipe:0",
                                 "-an"};
  const auto add = [&](std::initializer_list<const char*> more) {
    words.insert(words.end(), more.begin(), more.end());
  };
  if (ends_with(path, ".mp4")) {
    add({"-codec:v", "libx264", "-preset", "fast", "-crf", "21", "-pix_fmt", "yuv420p", "-movflags",
         "+faststart"});
  } else if (ends_with(path, ".webp")) {
    add({"-codec:v", "libwebp_anim", "-loop", "0", "-quality", "60", "-compression_level", "5"});
  }
  // A name that begins with a dash, or has a colon in it, is a file's name nevertheless.
  words.push_back("file:" + path);
  return words;
}

}  // namespace

Video::Video(const std::string& path, Size size, double fps) : path_(path) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe to ffmpeg");
  std::vector<std::string> words = command(path, size, fps);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  said_ = memfd_create("ffmpeg", MFD_CLOEXEC);
  if (said_ >= 0) posix_spawn_file_actions_adddup2(&actions, said_, STDERR_FILENO);
  // In a group of its own: Ctrl-C ends the run, and then the film.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  const int error =
      posix_spawnp(&encoder_, "ffmpeg", &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[0]);
  if (error != 0) {
    close(ends[1]);
    if (said_ >= 0) close(said_);
    encoder_ = -1;
    throw std::runtime_error("there is no ffmpeg to make '" + path +
                             "' with: install ffmpeg, or write pictures with --frames");
  }
  pipe_ = ends[1];
  // An encoder that ended is told by write, not by a signal.
  std::signal(SIGPIPE, SIG_IGN);
}

Video::~Video() {
  if (pipe_ >= 0) close(pipe_);
  if (encoder_ > 0) waitpid(encoder_, nullptr, 0);
  if (said_ >= 0) close(said_);
}

void Video::add(const Image& image) {
  std::size_t written = 0;
  while (written < image.rgb.size()) {
    const ssize_t count = write(pipe_, &image.rgb[written], image.rgb.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      ends_well();
      fail();
    }
    written += static_cast<std::size_t>(count);
  }
}

void Video::finish() {
  if (!ends_well()) fail();
}

// Waits for the encoder. Where the end of a film does not fit on the disk ffmpeg 5.1 reports an
// error, and exits with 0. What else is on its stderr may be of the dynamic linker.
bool Video::ends_well() {
  close(pipe_);
  pipe_ = -1;
  int status = 0;
  while (waitpid(encoder_, &status, 0) < 0 && errno == EINTR) {
  }
  encoder_ = -1;
  std::string said;
  std::array<char, 4096> part{};
  if (said_ >= 0) lseek(said_, 0, SEEK_SET);
  for (ssize_t count = 0; said_ >= 0 && (count = read(said_, part.data(), part.size())) > 0;)
    said.append(part.data(), static_cast<std::size_t>(count));
  std::fwrite(said.data(), 1, said.size(), stderr);
  const auto has = [&](const char* level) { return said.find(level) != std::string::npos; };
  return status == 0 && !has("[error]") && !has("[fatal]") && !has("[panic]");
}

void Video::fail() {
  throw std::runtime_error("ffmpeg could not make '" + path_ + "'; what it said is above");
}

}  // namespace view
