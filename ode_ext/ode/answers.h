// SPDX-License-Identifier: BSD-3-Clause
// What is known of each pair of geoms: its contacts, what they were computed from, and whether the
// program cares. Handles are keys here; nothing is dereferenced.
#pragma once

#include <ode/ode.h>

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "contacts/contact.h"
#include "ode/members.h"

namespace ode_ext {

// Rounds (rounds.h) after which an answer nobody gathered or asked for is soon forgotten.
inline constexpr std::uint64_t kRoundsRemembered = 8;
// Passes that gather a pair nobody asks for, after which it is no longer computed ahead.
inline constexpr std::uint64_t kPassesUnasked = 8;
// So many pairs that the program did not ask for the last time, new ones among them, a pass
// computes ahead, and as many more as it did ask for. Of what a program keeps in one place every
// two meet.
inline constexpr std::size_t kUnaskedAhead = 256;

// How many pairs ahead answers are fetched, which have left the caches since the last pass: about
// what memory takes to come.
inline constexpr std::size_t kAhead = 8;

struct Answer {
  std::array<dGeomID, 2> geoms{};         // contacts are those of dCollide(geoms[0], geoms[1]),
  std::array<std::uint64_t, 2> stamps{};  // as they were then
  std::vector<Contact> contacts;
  bool valid = false;
  std::uint32_t features = 0;        // that were found the last time (Scene::features)
  std::uint64_t gathering = 0;       // the last gathering that met it; nested passes count
  std::uint64_t gathered_pass = 0;   // the last outermost pass that gathered it
  std::uint64_t last_round = 0;      // the last one that gathered it or in which it was asked for
  std::uint64_t passes_unasked = 0;  // that gathered it since the program last asked
  std::uint64_t given_up = 0;        // the last one in which the device had no room for it; 0: none
  std::uint64_t noted_pass = 0;      // the last one that met it and did not compute it ahead,
  std::size_t noted_as = 0;          // and which it was of those (UnaskedPairs)
  std::array<const MeshTopology*, 2> given_up_meshes{};  // it was of these then; compared only
  // What is known of the geoms, the lower handle's first; of this generation of members.
  std::array<Members::Seen*, 2> seen{};
  std::uint64_t generation = 0;

  bool collides() const { return valid && !contacts.empty(); }
  // Whether this is the answer for these two, in either order.
  bool holds(const PairMember& a, const PairMember& b) const;
  // Into the caches: it is about to be used.
  void prefetch() const;
  // And then what is known of its geoms, of this generation of members.
  void prefetch_seen(std::uint64_t members) const;
};

// By pair of geoms, unordered. A pass asks for each pair in turn, between two of which kernels have
// filled the caches: open addressing, so that little is touched, answers mostly in the order in
// which they were first met, as they mostly are again, and with each the one that was found after
// it, as it mostly is again.
class Answers {
 public:
  // The entry of the pair; created empty. Stays where it is until it is forgotten.
  Answer& entry(dGeomID a, dGeomID b);
  Answer* find(dGeomID a, dGeomID b);
  // Into the caches: entry() of this pair is about to be called.
  void prefetch(dGeomID a, dGeomID b) const;
  // Forgets those that no round met of late, and moves the others together where few are left.
  // Looks every so many rounds.
  void prune(std::uint64_t round);
  void clear();
  std::size_t size() const { return answers_.size() - free_.size(); }

 private:
  using Key = std::array<dGeomID, 2>;
  struct Kept {
    Key key{};  // null: forgotten
    Answer answer;
    Kept* next = nullptr;  // what was found after this one the last time
  };
  struct Slot {
    Key key;
    Kept* kept = nullptr;  // null: free
  };
  static Key key(dGeomID a, dGeomID b);
  // Where the key is, or would be.
  Slot& slot_of(const Key& key);
  void grow();
  void free_slot(Slot& slot);
  void move_together();

  std::vector<Slot> slots_;  // a power of two, at most half of them taken
  std::deque<Kept> answers_;
  std::vector<Kept*> free_;
  Kept* last_ = nullptr;  // that was found
  std::uint64_t pruned_round_ = 0;
};

// An answer with what it is of, for the program's callbacks to be asked without the lock.
struct AnswerCopy {
  std::array<PairMember, 2> members;
  std::vector<Contact> contacts;
};

}  // namespace ode_ext
