// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/output_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "falling_objects/usage_error.h"

namespace falling_objects {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

std::string cannot_write(const std::string& path, int error) {
  return "cannot write '" + path + "': " + std::strerror(error);
}

}  // namespace

std::string why_not_written(const std::string& path) {
  std::error_code none;
  if (path.empty()) return "a file's name is expected";
  if (fs::is_directory(path, none)) return cannot_write(path, EISDIR);
  fs::path there = fs::exists(path, none) ? fs::path(path) : folder_of(path);
  const bool is_new = there != path;
  // What cannot be looked at is its own folder in the end: "." and "/" are.
  while (is_new && !fs::exists(there, none) && folder_of(there) != there) there = folder_of(there);
  if (is_new && !fs::is_directory(there, none)) return cannot_write(path, ENOTDIR);
  return access(there.c_str(), W_OK) == 0 ? "" : cannot_write(path, errno);
}

std::function<std::string(const std::string&)> ends_in(const std::vector<std::string>& endings) {
  return [endings](const std::string& path) -> std::string {
    std::string wanted;
    for (const std::string& ending : endings) {
      if (path.ends_with(ending)) return "";
      wanted += (wanted.empty() ? "" : ", ") + ending;
    }
    return "'" + path + "' must end in " + (endings.size() > 1 ? "one of " : "") + wanted;
  };
}

std::ofstream open_output(const std::string& path) {
  std::error_code ignored;  // opening says what is wrong
  fs::create_directories(folder_of(path), ignored);
  std::ofstream file(path, std::ios::binary);
  if (!file) throw UsageError(cannot_write(path, errno));
  return file;
}

}  // namespace falling_objects
