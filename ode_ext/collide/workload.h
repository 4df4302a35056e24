// SPDX-License-Identifier: BSD-3-Clause
// How much a batch takes before that is known (GRAPP section 4): the tiles it is cut into, room in
// the append lists, the size of launches; and what to do where an expectation was wrong.
#pragma once

#include <cstdint>
#include <vector>

#include "collide/batch_report.h"
#include "collide/options.h"
#include "collide/pass_memory.h"
#include "collide/tiles.h"
#include "opencl/device.h"
#include "opencl/launch.h"
#include "search/append_lists.h"
#include "search/scene.h"

namespace ode_ext {

// Whether pairs are taken through all steps one by one (kernels/whole_step.cl): on a processor,
// where the lists are what the product's are.
bool may_run_whole(const ColliderOptions& options, const DeviceInfo& device);

// Of one batch. What it finds out is noted in `memory`, if there is one, and in `report`.
class Workload {
 public:
  Workload(const ColliderOptions& options, const Device& device, AppendLists& lists,
           const Scene& scene, PassMemory* memory, BatchReport& report);

  // Whether all pairs of the batch fit into one tile, as far as is known now.
  bool is_whole() const { return tiles_.size() == 1; }
  // Goes on to the next tile; false: there is none.
  bool next();
  const Tile& tile() const { return tile_.tile; }
  // Before an attempt at it: room in the lists for what is expected of it, or was found in the last
  // attempt.
  void begin_attempt();
  // After it, its records counted: whether none was lost. If one was, the tile is to be tried
  // again, with more room.
  bool is_settled();
  // Once it is settled: adds the tile to the report.
  void report_tile();
  // After an attempt that failed since the device had no room: whether a smaller one is to be
  // tried, as the next tile.
  bool try_smaller(int code);

  // Of a kernel that takes so many items.
  Launch launch(std::uint64_t items) const;
  // Of one whose work-items take them one by one (lib/append.h): some for every compute unit.
  Launch launch_queue(std::uint64_t items) const;
  // One for each of so many that a work-group goes through together, where lanes are groups.
  Launch launch_each(std::uint64_t items) const;
  // Of one that takes a list, a record by so many work-items.
  Launch launch(List list, std::uint32_t items_per_record = 1) const;
  // The same after settle_launches().
  Launch settle_launch(List list, std::uint32_t items_per_record = 1) {
    settle_launches();
    return launch(list, items_per_record);
  }
  // Of the whole step: a work-item for each share of the lists.
  Launch launch_shares() const;
  // Whether some pairs will not fit into a share, as in the last batch.
  bool expects_left() const;
  // Where launches go by what there is: waits until it is known of all lists.
  void settle_launches();

  // Of the tile.
  std::uint64_t predicted(List list) const { return predicted_[static_cast<std::size_t>(list)]; }

 private:
  struct ExpectedTile {
    Tile tile;
    ListCounts expected;
  };

  // Whether each pair is taken through all steps at once, if it fits (kernels/whole_step.cl).
  bool is_whole_step() const { return lists_.shares() != 0; }
  // Records may be lost, as the paper has it.
  bool may_lose() const { return misprediction_ == Misprediction::kIgnore; }
  ListCounts stored() const;
  void reserve(const ListCounts& counts);
  bool remembers() const { return memory_ != nullptr && memory_->temporal != nullptr; }

  const ColliderOptions& options_;
  const DeviceInfo& device_;
  AppendLists& lists_;
  const Scene& scene_;
  const std::vector<ObjectSize> sizes_;
  PassMemory* memory_;
  BatchReport& report_;
  Misprediction misprediction_;
  std::vector<ExpectedTile> tiles_;  // to be collided, the last one first
  ExpectedTile tile_{};
  ListCounts most_{};       // that the tile can append
  ListCounts predicted_{};  // of the tile
  ListCounts needed_{};     // of the next attempt
  bool measured_ = false;   // `needed_` is what an attempt had, not what was expected of it
};

}  // namespace ode_ext
