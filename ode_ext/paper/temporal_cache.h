// SPDX-License-Identifier: BSD-3-Clause
// What a pass leaves for the next one of the same space (GRAPP section 3): per pair the relative
// pose, per vertex that was looked at the triangle of the target that its line met.
//
// Three stages, so that memory goes by what was looked at and nothing ever needs clearing: a pair
// is kept here, on the host; it has a relative pose and, for each chunk of either mesh, a
// directory entry; an entry names the block of temporal data that the chunk had in a pass. Poses
// and entries carry the number of the pass that wrote them and are void in any pass but the next.
// All are kept twice, for even and odd passes, so that a pass can be run again.
//
// What is found here is only ever a place to start from: that a triangle index is within the target
// it was stored for is all that must be true, and the meshes of a pair see to that.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "abi/paper.h"
#include "opencl/buffer.h"
#include "search/scene.h"

namespace ode_ext {

class TemporalCache {
 public:
  explicit TemporalCache(Device& device);

  // Begins a pass: finds the pairs of the scene again, makes room for new ones and forgets those
  // that have not been seen for a while. Pairs of objects without identity are not kept.
  void begin(const Scene& scene);
  // The pass that began keeps nothing at all. Uploads nothing where none has before.
  void begin_without(std::size_t pairs);
  // The device lost its contents.
  void forget_links() { unlinked_ = 0; }
  // Room for the temporal data of so many tasks.
  void reserve_blocks(std::uint64_t tasks);
  void clear();

  const Buffer& links() const { return links_; }
  const Buffer& poses() const { return poses_; }
  const Buffer& directory() const { return directory_; }
  const Buffer& before() const { return blocks_[1 - (pass_ & 1)]; }
  const Buffer& now() const { return blocks_[pass_ & 1]; }
  cl_uint pass() const { return pass_; }
  std::size_t pairs() const { return kept_.size(); }
  std::size_t bytes() const;  // of device memory
  // Of the directory, those of forgotten pairs among them, which are taken again.
  std::size_t entries() const { return entry_count_; }

 private:
  using Key = std::array<std::uint64_t, 2>;
  struct KeyHash {
    std::size_t operator()(const Key& key) const;
  };
  struct Place {
    std::uint32_t pose, directory;
  };
  struct Kept {
    Place place;
    std::array<std::shared_ptr<const MeshTopology>, 2>
        meshes;  // of the lower and the higher identity
    std::uint32_t last_pass;
  };

  ox_link link(const Scene& scene, const std::array<std::uint32_t, 2>& pair);
  // A place that was given up may be taken at once: the new owner's link is not `known`, so that
  // its first pass reads nothing there, and its second only what carries the number of its first.
  // False: there is no room left; the pair then is not kept.
  bool place(std::uint32_t chunks, Place& place);
  void release(const Kept& kept);
  void evict();
  void upload();

  std::unordered_map<Key, Kept, KeyHash> kept_;
  std::unordered_map<std::uint32_t, std::vector<Place>> free_;  // by place_size
  std::uint32_t pose_count_ = 0;
  std::uint32_t entry_count_ = 0;
  std::uint32_t pass_ = 1;  // 0 is in memory that nobody has written to
  std::vector<ox_link> host_links_;
  std::size_t unlinked_ = 0;  // so many pairs have void links on the device
  Buffer links_, poses_, directory_;
  std::array<Buffer, 2> blocks_;
};

}  // namespace ode_ext
