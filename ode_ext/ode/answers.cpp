// SPDX-License-Identifier: BSD-3-Clause
#include "ode/answers.h"

#include <algorithm>
#include <functional>

namespace ode_ext {

bool Answer::holds(const PairMember& a, const PairMember& b) const {
  const auto is_of = [&](const PairMember& first, const PairMember& second) {
    return geoms[0] == first.geom && geoms[1] == second.geom && stamps[0] == first.stamp &&
           stamps[1] == second.stamp;
  };
  return valid && (is_of(a, b) || is_of(b, a));
}

namespace {

template <class T>
void prefetch_all(const T& value) {
  constexpr std::size_t kCacheLine = 64;  // [bytes]
  const char* const first = reinterpret_cast<const char*>(&value);
  for (std::size_t at = 0; at < sizeof(T); at += kCacheLine) __builtin_prefetch(first + at);
  __builtin_prefetch(first + sizeof(T) - 1);
}

}  // namespace

void Answer::prefetch() const { prefetch_all(*this); }

void Answer::prefetch_seen(std::uint64_t members) const {
  if (generation != members) return;
  for (const Members::Seen* known : seen)
    if (known != nullptr) prefetch_all(known->now);
}

namespace {

constexpr std::size_t kLeastSlots = 64;

// Geoms come from an allocator: their low bits are equal and their differences regular, so the two
// are mixed by odd multipliers (of the golden ratio and of pi) and the high half is folded down.
std::size_t hash(const std::array<dGeomID, 2>& key) {
  const std::uint64_t a = reinterpret_cast<std::uintptr_t>(key[0]);
  const std::uint64_t b = reinterpret_cast<std::uintptr_t>(key[1]);
  const std::uint64_t mixed = a * 0x9e3779b97f4a7c15u + b * 0x3243f6a8885a308du;
  return static_cast<std::size_t>(mixed ^ mixed >> 29);
}

}  // namespace

Answers::Key Answers::key(dGeomID a, dGeomID b) {
  return std::less<>()(a, b) ? Key{a, b} : Key{b, a};
}

Answers::Slot& Answers::slot_of(const Key& key) {
  for (std::size_t place = hash(key);; ++place) {
    Slot& slot = slots_[place & (slots_.size() - 1)];
    if (slot.kept == nullptr || slot.key == key) return slot;
  }
}

void Answers::grow() {
  std::vector<Slot> before(std::max(kLeastSlots, 2 * slots_.size()));
  before.swap(slots_);
  for (const Slot& slot : before)
    if (slot.kept != nullptr) slot_of(slot.key) = slot;
}

Answer& Answers::entry(dGeomID a, dGeomID b) {
  if (2 * (size() + 1) > slots_.size()) grow();
  const Key wanted = key(a, b);
  Slot& slot = slot_of(wanted);
  if (slot.kept == nullptr) {
    slot.key = wanted;
    if (free_.empty()) {
      slot.kept = &answers_.emplace_back();
    } else {
      slot.kept = free_.back();
      free_.pop_back();
    }
    slot.kept->key = wanted;
  }
  return slot.kept->answer;
}

void Answers::prefetch(dGeomID a, dGeomID b) const {
  if (!slots_.empty()) __builtin_prefetch(&slots_[hash(key(a, b)) & (slots_.size() - 1)]);
}

Answer* Answers::find(dGeomID a, dGeomID b) {
  if (slots_.empty()) return nullptr;
  const Key wanted = key(a, b);
  if (last_ != nullptr && last_->key == wanted) return &last_->answer;
  Kept* kept = last_ != nullptr ? last_->next : nullptr;
  if (kept == nullptr || kept->key != wanted) kept = slot_of(wanted).kept;
  if (kept == nullptr) return nullptr;
  if (last_ != nullptr && last_->next != kept) last_->next = kept;
  last_ = kept;
  if (kept->next != nullptr) {
    __builtin_prefetch(kept->next);  // its key
    kept->next->answer.prefetch();
  }
  return &kept->answer;
}

void Answers::prune(std::uint64_t round) {
  if (round < pruned_round_ + kRoundsRemembered) return;
  pruned_round_ = round;
  std::vector<Kept*> old;
  for (Kept& kept : answers_)
    if (kept.key != Key{} && kept.answer.last_round + kRoundsRemembered < round)
      old.push_back(&kept);
  free_.reserve(free_.size() + old.size());
  for (Kept* kept : old) {
    free_slot(slot_of(kept->key));
    *kept = {};
    free_.push_back(kept);
  }
  if (!old.empty()) last_ = nullptr;
  if (8 * size() < answers_.size()) move_together();
}

// A key is found as long as no slot is free from the one that it wants up to its own. So of those
// behind a slot that becomes free the first that may stand there moves up, which frees another.
void Answers::free_slot(Slot& slot) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t gap = static_cast<std::size_t>(&slot - slots_.data());
  for (std::size_t place = (gap + 1) & mask; slots_[place].kept != nullptr;
       place = (place + 1) & mask) {
    const std::size_t from_wanted = (place - hash(slots_[place].key)) & mask;
    if (from_wanted < ((place - gap) & mask)) continue;

    slots_[gap] = slots_[place];
    gap = place;
  }
  slots_[gap] = {};
}

void Answers::move_together() {
  std::size_t count = kLeastSlots;
  while (count < 2 * (size() + 1)) count *= 2;
  std::vector<Slot> slots(count);
  std::deque<Kept> together;
  for (const Kept& kept : answers_)
    if (kept.key != Key{}) together.push_back({kept.key, kept.answer});
  slots_.swap(slots);
  answers_.swap(together);
  free_.clear();
  last_ = nullptr;
  for (Kept& kept : answers_) slot_of(kept.key) = {kept.key, &kept};
}

void Answers::clear() {
  slots_.clear();
  answers_.clear();
  free_.clear();
  last_ = nullptr;
}

}  // namespace ode_ext
