// SPDX-License-Identifier: BSD-3-Clause
// The append lists of a batch (GRAPP 3.1): records in device memory behind counters that run
// on past the capacity. Lists of one kind of record share a buffer.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "abi/types.h"
#include "opencl/buffer.h"
#include "search/list.h"

namespace ode_ext {

class AppendLists {
 public:
  explicit AppendLists(Device& device);

  // Room for at least so many records; a quarter more where a list has to grow, so that it rarely
  // does. Throws DeviceError where the device has no room for them: then there is none at all, and
  // what the lists held before is given back for a smaller batch to take.
  void reserve(const ListCounts& counts);
  // Room for exactly so many, whatever there was.
  void limit(const ListCounts& counts);
  // What is only expected gets room as far as it is cheap, a sixteenth of the largest buffer a list
  // (or what the list has): an expectation may be off by any factor, and what then overflows is
  // known exactly and mended.
  ListCounts affordable(const ListCounts& expected) const;
  // Gives all room back.
  void release();
  // After each pass, with what it stored, and other calls: lists that were far too large for many
  // passes are given back, so that one crowded moment is not paid for ever after.
  void note_use(const ListCounts& stored, bool is_pass);
  const ListCounts& capacities() const { return capacities_; }
  std::uint64_t capacity(List list) const { return capacities_[static_cast<std::size_t>(list)]; }
  // The place of a list's first record in its buffer.
  std::uint64_t first(List list) const { return host_lists_[static_cast<std::size_t>(list)].first; }
  // Beside the lists, `count` work-items have a share of their room each, for a pair at a time
  // (kernels/whole_step.cl).
  void keep_shares(std::size_t count);
  std::size_t shares() const { return shares_; }
  bool overflowed(const ListCounts& counts) const;
  // Records of all lists of vertex chunks of this batch together; their indices are below that.
  std::uint64_t task_capacity() const;

  // Before a batch: counters at zero, lists as reserved, but none with more room than the batch can
  // `most` fill, so that the places of small batches are small numbers.
  void begin(const ListCounts& most);
  // The device lost its contents.
  void forget() { written_lists_.reset(); }
  // Reads all counters. Waits, for what else is to be read too.
  void count();
  // As of the last count(): what was appended, to the lists and in shares; to the lists alone; and
  // how much of that is there.
  std::uint64_t counted(List list) const { return counted(static_cast<std::size_t>(list)); }
  std::uint64_t counted(std::size_t counter) const {
    return appended(counter) + read_counter(OX_COUNTERS_TOTALS, counter);
  }
  std::uint64_t appended(std::size_t counter) const { return read_counter(0, counter); }
  std::uint64_t length(List list) const { return std::min(counted(list), capacity(list)); }

  const Buffer& counters() const { return counters_; }
  const Buffer& lists() const { return lists_; }
  Buffer& tasks() { return tasks_; }
  const Buffer& tasks() const { return tasks_; }
  const Buffer& rays() const { return rays_; }
  const Buffer& meshlets() const { return meshlets_; }
  const Buffer& meshlet_pairs() const { return meshlet_pairs_; }
  const Buffer& hits() const { return hits_; }
  const Buffer& crossings() const { return crossings_; }
  const Buffer& flood_words() const { return flood_words_; }
  const Buffer& contacts() const { return contacts_; }
  // For each crossing and hit, as kernels/abi/contacts.h says.
  const Buffer& features() const { return features_; }
  const Buffer& feature_parents() const { return feature_parents_; }
  const Buffer& feature_slots() const { return feature_slots_; }
  const Buffer& regions() const { return regions_; }
  const Buffer& members() const { return members_; }
  const Buffer& faces() const { return faces_; }
  const Buffer& planes() const { return planes_; }
  const Buffer& edge_planes() const { return edge_planes_; }
  Buffer& candidates() { return candidates_; }
  const Buffer& candidates() const { return candidates_; }

 private:
  std::uint64_t read_counter(std::size_t of, std::size_t counter) const {
    const std::size_t word = (of * OX_COUNTER_COUNT + counter) * OX_COUNTER_STRIDE;
    return read_counters_[word];
  }
  // Lists of one kind beside one another, each with this room; the ends of their buffers.
  struct Ends {
    std::uint64_t tasks, rays, meshlets, meshlet_pairs, hits, crossings, flood_words, contacts;
  };
  Ends lay_out(const ListCounts& room);
  void resize(const ListCounts& capacities);
  void reserve_features(std::uint64_t count);

  Device* device_;
  ListCounts capacities_{};
  ListCounts most_used_{};  // in the passes noted so far
  int passes_noted_ = 0;
  using Layout = std::array<ox_list, 2 * kListCount>;  // of the lists, and of a share of them
  Layout host_lists_{};
  std::optional<Layout> written_lists_;  // what the device has of them
  // Of the lists, and of all shares together; kept, since the next kernels go on counting.
  std::array<ox_u32, OX_COUNTERS_SHARES * OX_COUNTER_WORDS> read_counters_{};
  HostView counter_view_;
  std::size_t shares_ = 0;
  ListCounts share_{};  // room of one of them
  Buffer counters_, lists_, tasks_, meshlets_, rays_, meshlet_pairs_, hits_, candidates_,
      crossings_, flood_words_, contacts_, features_, feature_parents_, feature_slots_, regions_,
      members_, faces_, planes_, edge_planes_;
};

}  // namespace ode_ext
