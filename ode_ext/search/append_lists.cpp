// SPDX-License-Identifier: BSD-3-Clause
#include "search/append_lists.h"

#include <algorithm>
#include <cstring>

#include "abi/contacts.h"

namespace ode_ext {
namespace {

static_assert(static_cast<std::size_t>(List::kChunksSmall) == OX_LIST_CHUNKS_SMALL &&
              static_cast<std::size_t>(List::kRaysIterative) == OX_LIST_RAYS_ITERATIVE &&
              static_cast<std::size_t>(List::kMeshletPairs) == OX_LIST_MESHLET_PAIRS &&
              static_cast<std::size_t>(List::kHits) == OX_LIST_HITS && kListCount == OX_LIST_COUNT);

constexpr std::size_t kCounterBytes = OX_COUNTER_WORDS * sizeof(ox_u32);
constexpr std::size_t kReadBytes = OX_COUNTERS_SHARES * kCounterBytes;

// Records of each list that one of so many shares has room for. What is of no use costs no memory
// but addresses, mostly; a pair with more is begun again, kernel by kernel, which costs twice as
// much. From 4 to 128 shares have room for 2^17 crossings together and as many hits, and for the
// floods of many more vertices, most of which bound nothing and make no hits: 210 MB.
ListCounts room_of_a_share(std::size_t shares) {
  const std::size_t features =
      std::clamp<std::size_t>(131072 / std::max<std::size_t>(shares, 1), 1024, 32768);
  ListCounts counts{};
  counts[OX_LIST_CHUNKS] = features / 4;
  counts[OX_LIST_RAYS] = features;
  counts[OX_LIST_MESHLETS] = 4 * features;
  counts[OX_LIST_MESHLET_PAIRS] = 4 * features;
  counts[OX_LIST_HITS] = features;
  counts[OX_LIST_CROSSINGS] = features;
  counts[OX_LIST_FLOOD_WORDS] = 128 * features;
  return counts;
}

// Counters and indices have 32 bits. Tiles are cut so that vertices need no more; what else there
// is too much of is seen, since counters stop at 2^31 (lib/append.h), and does not fit the
// device.
constexpr std::uint64_t kMostRecords = std::uint64_t{1} << 30;

// What becomes of a feature, a crossing or a hit [bytes].
constexpr std::size_t kFeatureBytes =
    sizeof(ox_feature) + sizeof(ox_region) + OX_MEMBER_WORDS * sizeof(ox_f32) +
    OX_CANDIDATES_PER_FEATURE * OX_CANDIDATE_WORDS * sizeof(ox_f32) +
    OX_SLOTS_PER_FEATURE * sizeof(ox_u32) + OX_FACES_PER_FEATURE * sizeof(ox_face) +
    OX_PLANES_PER_FEATURE * OX_PLANE_WORDS * sizeof(ox_f32) + 3 * sizeof(ox_u32);

// What a record of each list takes in all buffers together [bytes].
constexpr ListCounts kRecordBytes = [] {
  ListCounts bytes{};
  for (std::size_t i = 0; i < kListCount; ++i)
    bytes[i] = i <= OX_LIST_CHUNKS_DEFORMABLE ? sizeof(ox_chunk_task) : sizeof(ox_ray);
  bytes[OX_LIST_MESHLETS] = sizeof(ox_meshlet_task);
  bytes[OX_LIST_MESHLET_PAIRS] = sizeof(ox_meshlet_pair);
  bytes[OX_LIST_HITS] = sizeof(ox_hit) + kFeatureBytes;
  bytes[OX_LIST_CROSSINGS] = sizeof(ox_edge_crossing) + kFeatureBytes;
  bytes[OX_LIST_FLOOD_WORDS] = sizeof(ox_u32);
  bytes[OX_LIST_CONTACTS] = sizeof(ox_contact);
  return bytes;
}();

std::uint64_t bytes_of(const ListCounts& counts) {
  std::uint64_t bytes = 0;
  for (std::size_t i = 0; i < kListCount; ++i) bytes += counts[i] * kRecordBytes[i];
  return bytes;
}

// Memory goes back where for this many passes, a few seconds of simulation, less than a quarter of
// it was of use; what is less than the floor is not worth the growing again.
constexpr int kPassesNoted = 256;
constexpr std::uint64_t kNotWorthReleasing = std::uint64_t{32} << 20;  // [bytes]

}  // namespace

AppendLists::AppendLists(Device& device)
    : device_(&device),
      counter_view_(device),
      counters_(device, Memory::kShared),
      lists_(device, Memory::kShared),
      tasks_(device),
      meshlets_(device),
      rays_(device),
      meshlet_pairs_(device),
      hits_(device),
      candidates_(device),
      crossings_(device),
      flood_words_(device),
      contacts_(device, Memory::kShared),
      features_(device),
      feature_parents_(device),
      feature_slots_(device),
      regions_(device),
      members_(device),
      faces_(device),
      planes_(device),
      edge_planes_(device) {
  counters_.reserve(kReadBytes);
  counter_view_.reserve(counters_, kReadBytes);
  lists_.reserve(sizeof(host_lists_));
}

void AppendLists::keep_shares(std::size_t count) {
  shares_ = count;
  share_ = room_of_a_share(count);
  counters_.reserve((OX_COUNTERS_SHARES + count) * kCounterBytes);
}

void AppendLists::reserve(const ListCounts& counts) {
  ListCounts grown = capacities_;
  for (std::size_t i = 0; i < kListCount; ++i)
    if (counts[i] > grown[i])
      grown[i] = std::min(counts[i] + counts[i] / 4, std::max(kMostRecords, counts[i]));
  resize(grown);
}

void AppendLists::limit(const ListCounts& counts) { resize(counts); }

ListCounts AppendLists::affordable(const ListCounts& expected) const {
  const std::uint64_t cheap = device_->info().largest_buffer / 16;  // [bytes]
  ListCounts counts{};
  for (std::size_t i = 0; i < kListCount; ++i)
    counts[i] = std::min(expected[i], std::max(capacities_[i], cheap / kRecordBytes[i]));
  return counts;
}

void AppendLists::release() {
  capacities_ = {};
  for (Buffer* buffer : {&tasks_, &rays_, &meshlets_, &meshlet_pairs_, &hits_, &candidates_,
                         &crossings_, &flood_words_, &contacts_, &features_, &feature_parents_,
                         &feature_slots_, &regions_, &members_, &faces_, &planes_, &edge_planes_})
    buffer->release();
}

void AppendLists::note_use(const ListCounts& stored, bool is_pass) {
  for (std::size_t i = 0; i < kListCount; ++i) most_used_[i] = std::max(most_used_[i], stored[i]);
  if (!is_pass || ++passes_noted_ < kPassesNoted) return;
  const std::uint64_t held = bytes_of(capacities_);
  if (held > kNotWorthReleasing && held / 4 > bytes_of(most_used_)) release();
  most_used_ = {};
  passes_noted_ = 0;
}

AppendLists::Ends AppendLists::lay_out(const ListCounts& room) {
  const auto after = [&](List first, List last) {
    std::uint64_t end = 0;
    for (auto i = static_cast<std::size_t>(first); i <= static_cast<std::size_t>(last); ++i) {
      host_lists_[i] = {static_cast<ox_u32>(end), static_cast<ox_u32>(room[i])};
      end += room[i];
    }
    return end;
  };
  return {after(List::kChunksSmall, List::kChunksDeformable),
          after(List::kRaysIterative, List::kRaysBasic),
          after(List::kMeshlets, List::kMeshlets),
          after(List::kMeshletPairs, List::kMeshletPairs),
          after(List::kHits, List::kHits),
          after(List::kCrossings, List::kCrossings),
          after(List::kFloodWords, List::kFloodWords),
          after(List::kContacts, List::kContacts)};
}

void AppendLists::resize(const ListCounts& capacities) {
  Ends ends = lay_out(capacities);
  const auto at_least = [&](std::uint64_t& end, std::size_t list) {
    end = std::max(end, shares_ * share_[list]);
  };
  at_least(ends.tasks, OX_LIST_CHUNKS);
  at_least(ends.rays, OX_LIST_RAYS);
  at_least(ends.meshlets, OX_LIST_MESHLETS);
  at_least(ends.meshlet_pairs, OX_LIST_MESHLET_PAIRS);
  at_least(ends.hits, OX_LIST_HITS);
  at_least(ends.crossings, OX_LIST_CROSSINGS);
  at_least(ends.flood_words, OX_LIST_FLOOD_WORDS);
  try {
    tasks_.reserve(ends.tasks * sizeof(ox_chunk_task));
    rays_.reserve(ends.rays * sizeof(ox_ray));
    meshlets_.reserve(ends.meshlets * sizeof(ox_meshlet_task));
    meshlet_pairs_.reserve(ends.meshlet_pairs * sizeof(ox_meshlet_pair));
    hits_.reserve(ends.hits * sizeof(ox_hit));
    crossings_.reserve(ends.crossings * sizeof(ox_edge_crossing));
    flood_words_.reserve(ends.flood_words * sizeof(ox_u32));
    contacts_.reserve(ends.contacts * sizeof(ox_contact));
    reserve_features(ends.crossings + ends.hits);
  } catch (...) {
    release();
    throw;
  }
  capacities_ = capacities;
}

void AppendLists::reserve_features(std::uint64_t count) {
  features_.reserve(count * sizeof(ox_feature));
  regions_.reserve(count * sizeof(ox_region));
  feature_parents_.reserve(count * sizeof(ox_u32));
  feature_slots_.reserve(OX_SLOTS_PER_FEATURE * count * sizeof(ox_u32));
  faces_.reserve(OX_FACES_PER_FEATURE * count * sizeof(ox_face));
  edge_planes_.reserve(2 * count * sizeof(ox_u32));
  // Lanes are loaded beyond the last record (kernels/contacts/fields.h).
  const auto words_of = [](std::uint64_t records, std::uint64_t words) {
    return (records * words + OX_LANES) * sizeof(ox_f32);
  };
  members_.reserve(words_of(count, OX_MEMBER_WORDS));
  planes_.reserve(words_of(OX_PLANES_PER_FEATURE * count, OX_PLANE_WORDS));
  candidates_.reserve(words_of(OX_CANDIDATES_PER_FEATURE * count, OX_CANDIDATE_WORDS));
}

// What a batch was given of a list may be less than there is room for.
bool AppendLists::overflowed(const ListCounts& counts) const {
  for (std::size_t i = 0; i < kListCount; ++i)
    if (counts[i] > host_lists_[i].capacity) return true;
  return false;
}

std::uint64_t AppendLists::task_capacity() const {
  return std::uint64_t{host_lists_[OX_LIST_CHUNKS_DEFORMABLE].first} +
         host_lists_[OX_LIST_CHUNKS_DEFORMABLE].capacity;
}

void AppendLists::begin(const ListCounts& most) {
  ListCounts room{};
  for (std::size_t i = 0; i < kListCount; ++i) room[i] = std::min(capacities_[i], most[i]);
  lay_out(room);
  for (std::size_t i = 0; i < kListCount; ++i)
    host_lists_[kListCount + i] = {0, static_cast<ox_u32>(share_[i])};
  host_lists_[kListCount + OX_LIST_CONTACTS] = host_lists_[OX_LIST_CONTACTS];  // of all in common
  counters_.fill_zero(kReadBytes);
  if (written_lists_ && std::memcmp(&*written_lists_, &host_lists_, sizeof(Layout)) == 0) return;
  written_lists_.reset();
  lists_.write(host_lists_.data(), sizeof(Layout));
  written_lists_ = host_lists_;
}

void AppendLists::count() {
  counter_view_.read(counters_, kReadBytes);
  device_->finish();
  std::memcpy(read_counters_.data(), counter_view_.data(), kReadBytes);
}

}  // namespace ode_ext
