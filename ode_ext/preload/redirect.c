/* SPDX-License-Identifier: BSD-3-Clause */
#include "preload/redirect.h"

#include <dlfcn.h>
#include <link.h>
#include <stdint.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#if defined(__x86_64__)
/* jmp *0(%rip), and where to. */
typedef struct {
  unsigned char code[6];
  unsigned char target[8];
} Jump;
static const Jump kJump = {{0xff, 0x25, 0, 0, 0, 0}, {0}};

static bool has_room_for_a_jump(const void* function) {
  Dl_info info;
  const ElfW(Sym)* symbol = NULL;
  return dladdr1(function, &info, (void**)&symbol, RTLD_DL_SYMENT) != 0 && symbol != NULL &&
         info.dli_saddr == function && symbol->st_size >= sizeof(Jump);
}

bool ode_ext_redirect(void* function, void* target) {
  if (!has_room_for_a_jump(function)) return false;
  Jump jump = kJump;
  memcpy(jump.target, &target, sizeof(target));
  const uintptr_t page = (uintptr_t)sysconf(_SC_PAGESIZE);
  const uintptr_t begin = (uintptr_t)function / page * page;
  const size_t size = (uintptr_t)function + sizeof(jump) - begin;
  /* Executable all the time: a system may refuse to make what was written executable again. */
  if (mprotect((void*)begin, size, PROT_READ | PROT_WRITE | PROT_EXEC) != 0) return false;
  memcpy(function, &jump, sizeof(jump));
  mprotect((void*)begin, size, PROT_READ | PROT_EXEC);
  return true;
}
#else
bool ode_ext_redirect(void* function, void* target) {
  (void)function;
  (void)target;
  return false;
}
#endif
