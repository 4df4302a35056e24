// SPDX-License-Identifier: BSD-3-Clause
#include "ode/output_of_environment.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

#include "ode/messages.h"

namespace ode_ext {
namespace {

int open_to_write(const std::string& path, const char* variable) {
  const int descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0)
    throw std::runtime_error(std::string(variable) + " names '" + path +
                             "', which cannot be written: " + std::strerror(errno));
  return descriptor;
}

// Takes a file for this process alone; false: another one has it. What is no file, as a terminal,
// is everybody's, and so is what cannot be locked.
bool take(int descriptor) {
  struct stat is;
  if (fstat(descriptor, &is) != 0 || !S_ISREG(is.st_mode)) return true;
  return flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

bool trace_and_capture_are_one() {
  const char* trace = std::getenv("ODE_EXT_TRACE");
  const char* capture = std::getenv("ODE_EXT_CAPTURE");
  std::error_code none;
  return trace != nullptr && capture != nullptr &&
         std::filesystem::equivalent(trace, capture, none);
}

}  // namespace

std::FILE* open_output_of_environment(const char* variable) {
  const char* named = std::getenv(variable);
  if (named == nullptr || *named == '\0') return nullptr;
  std::string path = named;
  int descriptor = open_to_write(path, variable);
  if (!take(descriptor)) {
    close(descriptor);
    if (trace_and_capture_are_one())
      throw std::runtime_error("ODE_EXT_TRACE and ODE_EXT_CAPTURE both name '" + path + "'");
    path += '.' + std::to_string(getpid());
    descriptor = open_to_write(path, variable);
    take(descriptor);
    log(LogLevel::kWarning, "another process writes the file that " + std::string(variable) +
                                " names; this one writes '" + path + "'");
  }
  struct stat is;
  if (fstat(descriptor, &is) == 0 && S_ISREG(is.st_mode) && ftruncate(descriptor, 0) != 0) {
    const std::string why = std::strerror(errno);
    close(descriptor);
    throw std::runtime_error("'" + path + "' cannot be emptied: " + why);
  }
  std::FILE* opened = fdopen(descriptor, "wb");
  if (opened == nullptr) {
    close(descriptor);
    throw std::bad_alloc();
  }
  return opened;
}

}  // namespace ode_ext
