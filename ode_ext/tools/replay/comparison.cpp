// SPDX-License-Identifier: BSD-3-Clause
#include "tools/replay/comparison.h"

#include <bit>
#include <cstdio>
#include <cstring>
#include <span>

namespace ode_ext::replay {
namespace {

std::string to_text(const capture::Contact& c) {
  char text[320];
  std::snprintf(text, sizeof(text),
                "pos (%.17g, %.17g, %.17g) normal (%.17g, %.17g, %.17g) depth %.17g sides %d %d",
                c.position[0], c.position[1], c.position[2], c.normal[0], c.normal[1], c.normal[2],
                c.depth, c.side1, c.side2);
  return text;
}

// A sentence's end about the first contact that differs; "" if none does.
std::string difference(std::span<const capture::Contact> captured,
                       std::span<const capture::Contact> played) {
  for (std::size_t i = 0; i < captured.size() && i < played.size(); ++i)
    if (std::memcmp(&captured[i], &played[i], sizeof(capture::Contact)) != 0)
      return "contact " + std::to_string(i) + "\n  captured  " + to_text(captured[i]) +
             "\n  replayed  " + to_text(played[i]);
  if (captured.size() == played.size()) return "";
  return std::to_string(captured.size()) + " contacts captured, " + std::to_string(played.size()) +
         " replayed";
}

}  // namespace

// FNV-1a over words, as the hash of falling_objects.
std::uint64_t mix(std::uint64_t hash, const std::vector<std::uint32_t>& counts,
                  const std::vector<capture::Contact>& contacts) {
  const auto mix_word = [&](std::uint64_t word) {
    hash = (hash ^ word) * 0x100000001b3;
    hash ^= hash >> 32;  // a multiplication alone carries no high bit down
  };
  for (const std::uint32_t count : counts) mix_word(count);
  for (const capture::Contact& c : contacts) {
    for (const double x : c.position) mix_word(std::bit_cast<std::uint64_t>(x));
    for (const double x : c.normal) mix_word(std::bit_cast<std::uint64_t>(x));
    mix_word(std::bit_cast<std::uint64_t>(c.depth));
    mix_word(static_cast<std::uint64_t>(c.side1));
    mix_word(static_cast<std::uint64_t>(c.side2));
  }
  return hash;
}

Difference compare(const PassRecord& pass, const ContactsRecord& captured, const Played& played) {
  Difference result;
  std::span<const capture::Contact> left_captured = captured.contact_list;
  std::span<const capture::Contact> left_played = played.contacts;
  for (std::uint32_t i = 0; i < pass.pairs; ++i) {
    const std::string found =
        difference(left_captured.first(captured.counts[i]), left_played.first(played.counts[i]));
    left_captured = left_captured.subspan(captured.counts[i]);
    left_played = left_played.subspan(played.counts[i]);
    if (found.empty() || result.pairs++ != 0) continue;
    const capture::Pair& pair = pass.pair_list[i];
    result.first = "pass " + std::to_string(pass.number) + ", pair " + std::to_string(i) + " of " +
                   std::to_string(pass.pairs) + ", meshes " +
                   std::to_string(pass.object_list[pair.first].mesh) + " and " +
                   std::to_string(pass.object_list[pair.second].mesh) + ": " + found;
  }
  return result;
}

}  // namespace ode_ext::replay
