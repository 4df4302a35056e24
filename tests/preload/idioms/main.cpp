// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <cstring>
#include <iterator>

#include "preload/idioms/idioms.h"
#include "preload/idioms/program.h"

namespace {

struct Idiom {
  const char* name;
  std::string (*run)();
};
constexpr Idiom kIdioms[] = {
    {"in_the_callback", &idioms::in_the_callback},
    {"recursion", &idioms::recursion},
    {"recorded", &idioms::recorded},
    {"twice_and_swapped", &idioms::twice_and_swapped},
    {"early_exit", &idioms::early_exit},
    {"prefilled", &idioms::prefilled},
    {"disabled", &idioms::disabled},
    {"space_and_geom", &idioms::space_and_geom},
    {"transform", &idioms::transform},
    {"offset", &idioms::offset},
    {"many_geoms", &idioms::many_geoms},
    {"kinds_of_spaces", &idioms::kinds_of_spaces},
    {"without_a_pass", &idioms::without_a_pass},
    {"destroyed", &idioms::destroyed},
    {"updated", &idioms::updated},
    {"reinitialized", &idioms::reinitialized},
    {"forked", &idioms::forked},
    {"worlds", &idioms::worlds},
    {"threads", &idioms::threads},
};

int usage(std::FILE* to) {
  std::fprintf(to,
               "usage: idioms IDIOM [--sound]\n"
               "       idioms --list\n"
               "Prints what dCollide answers to a program that uses ODE in the way named.\n"
               "  --sound  fail at a contact that makes no sense; collide in several threads\n");
  return to == stdout ? 0 : 2;
}

}  // namespace

#ifdef IDIOMS_AS_PLUGIN
extern "C" __attribute__((visibility("default"))) int idioms_main(int argc, char** argv) {
#else
int main(int argc, char** argv) {
#endif
  if (argc < 2) return usage(stderr);
  if (std::strcmp(argv[1], "--help") == 0) return usage(stdout);
  if (std::strcmp(argv[1], "--list") == 0) {
    for (const Idiom& idiom : kIdioms) std::puts(idiom.name);
    return 0;
  }
  idioms::must_be_sound = argc > 2 && std::strcmp(argv[2], "--sound") == 0;
  for (const Idiom& idiom : kIdioms) {
    if (std::strcmp(idiom.name, argv[1]) != 0) continue;
    dInitODE2(0);
    idioms::begin();
    std::fputs(idiom.run().c_str(), stdout);
    idioms::end();
    dCloseODE();
    return 0;
  }
  return usage(stderr);
}
