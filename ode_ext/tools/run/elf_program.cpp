// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run/elf_program.h"

#include <elf.h>
#include <link.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <cstring>
#include <fstream>

namespace ode_ext {
namespace {

// Of this very program.
#if defined(__x86_64__)
constexpr ElfW(Half) kMachine = EM_X86_64;
#elif defined(__aarch64__)
constexpr ElfW(Half) kMachine = EM_AARCH64;
#endif
constexpr unsigned char kClass = sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32;

template <class T>
bool read_at(std::ifstream& file, std::size_t offset, T& value) {
  file.seekg(static_cast<std::streamoff>(offset));
  return static_cast<bool>(file.read(reinterpret_cast<char*>(&value), sizeof(value)));
}

}  // namespace

std::string why_not_preloaded(const std::string& path) {
  struct stat status;
  if (stat(path.c_str(), &status) == 0 && (status.st_mode & (S_ISUID | S_ISGID)) != 0)
    return "runs with the rights of another user: nothing is preloaded there; start it as that "
           "user, from a copy without the set-user-ID bit";
  if (getuid() != 0 && getxattr(path.c_str(), "security.capability", nullptr, 0) > 0)
    return "has capabilities of its own: nothing is preloaded there; start a copy without them, or "
           "as root";
  std::ifstream file(path, std::ios::binary);
  ElfW(Ehdr) header;
  if (!read_at(file, 0, header) || std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) return "";
  if (header.e_ident[EI_CLASS] != kClass || header.e_machine != kMachine)
    return "is a program for another processor than ode_ext was built for";
  for (std::size_t i = 0; i < header.e_phnum; ++i) {
    ElfW(Phdr) segment;
    if (!read_at(file, header.e_phoff + i * header.e_phentsize, segment)) break;
    if (segment.p_type == PT_INTERP) return "";
  }
  return "is linked statically: nothing is preloaded there; link it with ode_ext instead";
}

}  // namespace ode_ext
