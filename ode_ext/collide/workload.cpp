// SPDX-License-Identifier: BSD-3-Clause
#include "collide/workload.h"

#include <algorithm>

#include "opencl/error.h"

namespace ode_ext {
namespace {

std::uint64_t& at(ListCounts& counts, List list) { return counts[static_cast<std::size_t>(list)]; }

}  // namespace

bool may_run_whole(const ColliderOptions& options, const DeviceInfo& device) {
  return options.whole_steps && !follows_paper(options) &&
         options.launches == LaunchRule::kPredicted && (device.type & CL_DEVICE_TYPE_CPU) != 0;
}

Workload::Workload(const ColliderOptions& options, const Device& device, AppendLists& lists,
                   const Scene& scene, PassMemory* memory, BatchReport& report)
    : options_(options),
      device_(device.info()),
      lists_(lists),
      scene_(scene),
      sizes_(object_sizes(scene)),
      memory_(memory),
      report_(report) {
  const std::size_t pairs = scene.pairs.size();
  const bool has_history = memory != nullptr && memory->history.pairs != 0;
  report_.predicted = predict(has_history ? memory->history : History{}, pairs, options.prediction,
                              options.confidence);
  // Without a history nothing was predicted that could be wrong.
  misprediction_ = has_history ? options.misprediction : Misprediction::kRedo;
  // Of what whole steps do the lists have the contacts alone.
  ListCounts expected = report_.predicted;
  if (is_whole_step()) {
    const History left = {pairs, has_history ? memory->history.appended : ListCounts{}};
    expected = predict(left, pairs, PredictionRule::kPlain, options.confidence);
    at(expected, List::kContacts) = report_.predicted[static_cast<std::size_t>(List::kContacts)];
  }
  const std::size_t tile_pairs =
      memory != nullptr && memory->tile_pairs != 0 ? memory->tile_pairs : pairs;
  for (const Tile tile : cut_into_tiles(scene, sizes_, options.tile_vertices, tile_pairs))
    tiles_.push_back({tile, share(expected, tile.count, pairs)});
  std::reverse(tiles_.begin(), tiles_.end());
}

bool Workload::next() {
  if (tiles_.empty()) return false;
  tile_ = tiles_.back();
  tiles_.pop_back();
  // A prediction may be as far off as it likes: it costs no more than the worst case would.
  most_ = most_records(scene_, sizes_, tile_.tile, options_);
  for (std::size_t i = 0; i < kListCount; ++i)
    predicted_[i] = std::min(tile_.expected[i], most_[i]);
  if (!may_lose()) predicted_ = lists_.affordable(predicted_);
  needed_ = predicted_;
  measured_ = false;
  return true;
}

void Workload::begin_attempt() {
  reserve(needed_);
  lists_.begin(most_);
}

void Workload::reserve(const ListCounts& counts) {
  ListCounts wanted = counts;
  if (may_lose()) {
    lists_.limit(wanted);
    return;
  }
  // Pairs go from one category to another, and rays with them: room for all of them in either.
  const auto share_room = [&](List a, List b) {
    at(wanted, a) = at(wanted, b) = at(wanted, a) + at(wanted, b);
  };
  if (remembers()) {
    share_room(List::kChunksSmall, List::kChunks);
    share_room(List::kRaysIterative, List::kRays);
  }
  for (std::uint64_t& count : wanted) count = std::max(count, options_.initial_capacity);
  // A crossing takes as many words: 8 places of 6 (kernels/lib/flood_table.h).
  std::uint64_t& words = at(wanted, List::kFloodWords);
  words = std::max(words, 48 * options_.initial_capacity);
  lists_.reserve(wanted);
}

bool Workload::is_settled() {
  const ListCounts counts = stored();
  if (!may_lose() && *std::max_element(counts.begin(), counts.end()) >= OX_MOST_COUNTED) {
    // How much more there is is not known, whatever the lists have room for.
    throw DeviceError(CL_INVALID_BUFFER_SIZE,
                      "A list has more than 2^31 records. Make the scene smaller.");
  }
  if (!may_lose() && lists_.overflowed(counts)) {
    // What comes after a list that overflowed has not seen everything, so its count is only a lower
    // bound and may overflow in the next attempt; each mends at least one list.
    for (std::size_t i = 0; i < kListCount; ++i) {
      needed_[i] = std::max(needed_[i], counts[i]);
      most_[i] = std::max(most_[i], counts[i]);  // whatever was thought the worst case
    }
    measured_ = true;
    // To backtrack, the true counts have to be known: it is tried again, for them alone.
    if (misprediction_ == Misprediction::kBacktrack)
      report_.backtracked = true;
    else
      ++report_.redone;
    return false;
  }
  return true;
}

void Workload::report_tile() {
  const ListCounts counts = stored();
  for (std::size_t i = 0; i < kListCount; ++i) {
    report_.actual[i] += lists_.counted(i);
    report_.appended[i] += lists_.appended(i);
    if (may_lose() && counts[i] > lists_.capacities()[i])
      report_.missed += counts[i] - lists_.capacities()[i];
  }
  report_.pairs_bounded += lists_.counted(OX_COUNTER_BOUNDED);
  report_.unproven += lists_.counted(OX_COUNTER_UNPROVEN);
  report_.dropped += lists_.counted(OX_COUNTER_DROPPED);
  report_.left += lists_.counted(OX_COUNTER_LEFT);
}

bool Workload::try_smaller(int code) {
  const bool hinted =
      !measured_ && !may_lose() &&
      std::any_of(predicted_.begin(), predicted_.end(), [](auto n) { return n > 1; });
  const Tile tile = tile_.tile;
  if (!is_out_of_memory(code) || (tile.count < 2 && !remembers() && !hinted)) return false;
  // It does not fit: it might without room for what was only expected, without temporal data, or in
  // halves.
  ++report_.redone;
  lists_.release();
  if (hinted) {
    tiles_.push_back({tile, {}});
    return true;
  }
  if (remembers()) memory_->temporal.reset();
  if (tile.count < 2) {
    tiles_.push_back({tile, needed_});
    return true;
  }
  const std::size_t half = tile.count / 2;
  if (memory_ != nullptr) memory_->tile_pairs = half;
  tiles_.push_back(
      {{tile.first + half, tile.count - half}, share(needed_, tile.count - half, tile.count)});
  tiles_.push_back({{tile.first, half}, share(needed_, half, tile.count)});
  return true;
}

Launch Workload::launch(std::uint64_t items) const {
  const std::uint64_t local = options_.work_group_size;
  // A grid of 2^30 keeps every index within 32 bits; the loops in the kernels do the rest.
  const std::uint64_t most = (std::uint64_t{1} << 30) / local;
  return {static_cast<std::size_t>(std::min((items + local - 1) / local, most)),
          options_.work_group_size};
}

Launch Workload::launch_each(std::uint64_t items) const {
  if (!lanes_are_groups(options_, device_)) return launch(items);
  // Of one warp each a compute unit of NVIDIA's has no more at a time.
  constexpr std::uint64_t kResident = 32;
  const std::uint64_t most = kResident * device_.compute_units;
  return {static_cast<std::size_t>(std::min(items, most)), OX_LANES};
}

Launch Workload::launch_queue(std::uint64_t items) const {
  // Of a pair there may be many.
  if (lanes_are_groups(options_, device_))
    return launch_each(std::max<std::uint64_t>(items, 8 * std::uint64_t{device_.compute_units}));
  return launch(std::max<std::uint64_t>(
      items, std::uint64_t{device_.compute_units} * options_.work_group_size));
}

Launch Workload::launch(List list, std::uint32_t items_per_record) const {
  const bool exact = options_.launches == LaunchRule::kExact;
  std::uint64_t items = items_per_record * (exact ? lists_.counted(list) : predicted(list));
  if (list <= List::kChunksDeformable) items *= OX_CHUNK_VERTICES;
  // A few groups for every compute unit cost nothing where there is no history yet. The paper
  // launches what is predicted, and no more.
  if (!exact && !may_lose())
    items = std::max<std::uint64_t>(
        items, 8 * std::uint64_t{device_.compute_units} * options_.work_group_size);
  return launch(items);
}

bool Workload::expects_left() const { return memory_ != nullptr && memory_->history.left != 0; }

Launch Workload::launch_shares() const { return {std::min(lists_.shares(), tile_.tile.count), 1}; }

void Workload::settle_launches() {
  if (options_.launches == LaunchRule::kExact) lists_.count();
}

// Of what the last attempt counted, what was to be stored: the monolithic organization has no lists
// of chunks and of rays, and pairs of meshlets that are not stored are crossed at once
// (kernels/match.cl).
ListCounts Workload::stored() const {
  ListCounts counts;
  for (std::size_t i = 0; i < kListCount; ++i) counts[i] = lists_.appended(i);
  if (options_.organization == Organization::kMonolithic)
    std::fill(counts.begin(), counts.begin() + static_cast<std::ptrdiff_t>(List::kMeshlets), 0u);
  std::uint64_t& pairs = at(counts, List::kMeshletPairs);
  pairs = std::min(pairs, lists_.capacity(List::kMeshletPairs));
  return counts;
}

}  // namespace ode_ext
