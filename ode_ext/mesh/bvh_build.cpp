// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "mesh/both.h"
#include "mesh/box.h"
#include "mesh/bvh.h"
#include "mesh/meshlets.h"

namespace ode_ext {
namespace {

constexpr std::size_t kBins = 16;

// A thread takes tens of microseconds to start, a triangle half of one.
constexpr std::size_t kTrianglesAThread = 16384;

// Items that still have to become a subtree.
struct Range {
  std::uint32_t first;
  std::uint32_t count;
};

// A triangle on its way into a leaf.
struct Item {
  Box box;
  std::uint32_t triangle;
};

struct Bin {
  Box box = empty_box();
  std::uint32_t count = 0;
};

using Bins = std::array<Bin, kBins>;

// A plane between bins: triangles in bins up to `last_left` go to the left child.
struct Split {
  double cost = std::numeric_limits<double>::infinity();
  std::uint32_t imbalance = 0;
  std::size_t axis = 0;
  std::size_t last_left = 0;
};

// Which bin of an axis a centroid falls into. In double, so that no finite extent over- or
// underflows.
class Binning {
 public:
  Binning(const Box& centroids, std::size_t axis)
      : axis_(axis),
        lo_(centroids.lo[axis]),
        scale_(static_cast<double>(kBins) / (double{centroids.hi[axis]} - lo_)) {}
  std::size_t bin(Vec3f centroid) const {
    return std::min(static_cast<std::size_t>((centroid[axis_] - lo_) * scale_), kBins - 1);
  }

 private:
  std::size_t axis_;
  double lo_, scale_;
};

class Builder {
 public:
  Builder(const std::vector<Vec3f>& vertices, const std::vector<Triangle>& triangles) {
    items_.reserve(triangles.size());
    for (const Triangle& triangle : triangles) {
      Box box = empty_box();
      for (const std::uint32_t corner : triangle) box = grown(box, vertices[corner]);
      items_.push_back({box, static_cast<std::uint32_t>(items_.size())});
    }
  }

  Bvh build() {
    if (!items_.empty()) {
      split_all({0, static_cast<std::uint32_t>(items_.size())},
                worthwhile_threads(items_.size(), kTrianglesAThread), bvh_.nodes);
      link_all();
    }
    bvh_.order.reserve(items_.size());
    for (const Item& item : items_) bvh_.order.push_back(item.triangle);
    return std::move(bvh_);
  }

 private:
  // The nodes of a range in depth-first order, appended.
  void split_all(Range range, std::size_t threads, std::vector<BvhNode>& nodes) {
    if (threads <= 1 || range.count <= kMaxLeafTriangles) {
      split_alone(range, nodes);
      return;
    }
    nodes.push_back({});
    const std::uint32_t left = partition(range);
    const std::size_t half = threads / 2;
    std::vector<BvhNode> others;
    do_both(
        threads,
        [&] {
          split_all({range.first + left, range.count - left}, threads - half, others);
        },
        [&] {
          split_all({range.first, left}, half, nodes);
        });
    nodes.insert(nodes.end(), others.begin(), others.end());
  }

  // A stack of its own, as no depth is guaranteed.
  void split_alone(Range whole, std::vector<BvhNode>& nodes) {
    std::vector<Range> stack{whole};
    while (!stack.empty()) {
      const Range range = stack.back();
      stack.pop_back();
      const bool leaf = range.count <= kMaxLeafTriangles;
      nodes.push_back({{}, 0, {}, leaf ? range.first << 3 | range.count : 0});
      if (leaf) continue;
      const std::uint32_t left = partition(range);
      stack.push_back({range.first + left, range.count - left});
      stack.push_back({range.first, left});
    }
  }

  // Children follow their parent, so backwards all children are known. The left child is the next
  // node, the right one is where the left one's link leads.
  void link_all() {
    for (auto i = static_cast<std::uint32_t>(bvh_.nodes.size()); i-- > 0;) {
      BvhNode& node = bvh_.nodes[i];
      Box box = empty_box();
      if (node.leaf != 0) {
        node.skip = i + 1;
        const std::uint32_t first = node.leaf >> 3;
        for (std::uint32_t k = first; k < first + (node.leaf & 7); ++k) {
          box = grown(box, items_[k].box);
        }
      } else {
        const BvhNode& left = bvh_.nodes[i + 1];
        const BvhNode& right = bvh_.nodes[left.skip];
        node.skip = right.skip;
        box = grown(Box{left.lo, left.hi}, Box{right.lo, right.hi});
      }
      node.lo = box.lo;
      node.hi = box.hi;
    }
  }

  // Reorders a range and returns how many triangles go left, at least 1 and not all.
  std::uint32_t partition(Range range) {
    const auto begin = items_.begin() + range.first;
    const auto end = begin + range.count;
    Box centroids = empty_box();
    for (auto it = begin; it != end; ++it) centroids = grown(centroids, centre(it->box));

    const Split best = find_split(range, centroids);
    if (std::isinf(best.cost)) return range.count / 2;  // all in one place

    const Binning binning(centroids, best.axis);
    const auto middle = std::partition(begin, end, [&](const Item& item) {
      return binning.bin(centre(item.box)) <= best.last_left;
    });
    return static_cast<std::uint32_t>(middle - begin);
  }

  // The best of the planes of all axes. Items are gone through once, since there are more of them
  // than caches hold.
  Split find_split(Range range, const Box& centroids) const {
    std::array<Bins, 3> bins;
    const std::array<Binning, 3> binnings{Binning(centroids, 0), Binning(centroids, 1),
                                          Binning(centroids, 2)};
    for (std::uint32_t k = range.first; k < range.first + range.count; ++k) {
      const Box& box = items_[k].box;
      const Vec3f middle = centre(box);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!(centroids.lo[axis] < centroids.hi[axis])) continue;
        Bin& bin = bins[axis][binnings[axis].bin(middle)];
        bin.box = grown(bin.box, box);
        ++bin.count;
      }
    }
    Split best;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (centroids.lo[axis] < centroids.hi[axis]) improve(range, bins[axis], axis, best);
    return best;
  }

  // What triangles cost but for the area of their box. Meshlets are tested whole, however full they
  // are (Wald, Woop, Benthin, Johnson, Ernst, "Embree", 2014, count blocks of triangles likewise):
  // so they get fuller, and there are fewer of them.
  static std::uint32_t work(Range range, std::uint32_t triangles) {
    const std::uint32_t together = range.count > kMeshletTriangles ? kMeshletTriangles : 1;
    return (triangles + together - 1) / together;
  }

  // By the planes of one axis. The first and the last bin are never empty, as the outermost
  // centroids are in them.
  static void improve(Range range, const Bins& bins, std::size_t axis, Split& best) {
    std::array<double, kBins> right_cost{};  // of the bins from i on
    Bin right;
    for (std::size_t i = kBins - 1; i > 0; --i) {
      right.count += bins[i].count;
      right.box = grown(right.box, bins[i].box);
      right_cost[i] = work(range, right.count) * half_area(right.box);
    }
    Bin left;
    for (std::size_t i = 0; i + 1 < kBins; ++i) {
      if (bins[i].count == 0) continue;  // the same split as the one before
      left.count += bins[i].count;
      left.box = grown(left.box, bins[i].box);
      const double cost = work(range, left.count) * half_area(left.box) + right_cost[i + 1];
      // Triangles along a line have boxes without area: every cost is 0, and balance decides.
      const std::uint32_t others = range.count - left.count;
      const std::uint32_t imbalance = std::max(left.count, others) - std::min(left.count, others);
      if (cost < best.cost || (cost == best.cost && imbalance < best.imbalance)) {
        best = {cost, imbalance, axis, i};
      }
    }
  }

  std::vector<Item> items_;  // in the order of the leaves so far
  Bvh bvh_;
};

}  // namespace

Bvh build_bvh(const std::vector<Vec3f>& vertices, const std::vector<Triangle>& triangles) {
  return Builder(vertices, triangles).build();
}

}  // namespace ode_ext
