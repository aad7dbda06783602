// A uniform grid of buckets over boxes, for rays and for "what is near": the index that simulators use.
//
// Walk along a ray: J. Amanatides and A. Woo, "A fast voxel traversal algorithm for ray tracing", Eurographics 1987.
// Where a ray runs within rounding of a bucket's corner it may skip that bucket; boxes are given a little too large
// (FlatWorld), so what they hold is found all the same, to about 1e-9 of the coordinates.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "gridcull/core/bounds.h"

namespace gridcull {

class BucketGrid {
 public:
  struct Item {
    Bounds box;
    std::uint32_t name;  ///< what the walks hand out
  };

  /// About two buckets an item, none smaller than the mean item, over the items' common box clipped to `world`. Items
  /// that leave `world` or would lie in very many buckets are kept in a list that every walk hands out first. Storage
  /// is reused.
  void build(std::span<const Item> items, const Bounds& world, int dimension);

  /// Names near the segment from + t * along, 0 <= t <= 1, each once or more, in walking order, until use(name) is
  /// true; whether it was. `buckets` grows by the buckets walked through.
  template <class Use>
  bool walk(const Vec3& from, const Vec3& along, std::uint64_t& buckets, const Use& use) const;

  /// Names of items whose boxes may meet `box`, each once or more.
  template <class Use>
  void near(const Bounds& box, const Use& use) const;

  /// Buckets that a box meets: what near() costs.
  double buckets_in(const Bounds& box) const;
  std::size_t bucket_count() const { return starts_.empty() ? 0 : starts_.size() - 1; }

 private:
  struct Range {
    std::array<std::int64_t, 3> low, high;  ///< inclusive
  };
  bool choose(std::span<const Item> items, const Bounds& world, int dimension);
  bool is_apart(const Bounds& box) const;
  Range range_of(const Bounds& box) const;
  std::int64_t cell_of(double x, int axis) const {
    const double cell = std::floor((x - lattice_.min[axis]) * per_metre_[axis]);
    return static_cast<std::int64_t>(std::fmin(std::fmax(cell, 0.0), static_cast<double>(cells_[at(axis)] - 1)));
  }
  static std::size_t at(int axis) { return static_cast<std::size_t>(axis); }
  std::size_t index(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return static_cast<std::size_t>((z * cells_[1] + y) * cells_[0] + x);
  }
  template <class Count>
  void for_buckets(const Range& r, const Count& count) const {
    for (std::int64_t z = r.low[2]; z <= r.high[2]; ++z) {
      for (std::int64_t y = r.low[1]; y <= r.high[1]; ++y) {
        for (std::int64_t x = r.low[0]; x <= r.high[0]; ++x) count(index(x, y, z));
      }
    }
  }
  template <class Use>
  bool use_bucket(std::size_t bucket, const Use& use) const {
    for (std::uint32_t i = starts_[bucket]; i < starts_[bucket + 1]; ++i) {
      if (use(names_[i])) return true;
    }
    return false;
  }

  Bounds lattice_{};
  Bounds world_{};
  Vec3 cell_{1.0}, per_metre_{1.0};
  std::array<std::int64_t, 3> cells_{1, 1, 1};
  std::vector<std::uint32_t> starts_{};  ///< by bucket, into names_; empty: nothing in buckets
  std::vector<std::uint32_t> names_{};
  std::vector<std::uint32_t> apart_{};
};

template <class Use>
bool BucketGrid::walk(const Vec3& from, const Vec3& along, std::uint64_t& buckets, const Use& use) const {
  for (const std::uint32_t name : apart_) {
    if (use(name)) return true;
  }
  if (starts_.empty()) return false;
  double begin = 0.0, end = 1.0;
  for (int k = 0; k < 3; ++k) {
    if (cells_[at(k)] == 1 && lattice_.min[k] == lattice_.max[k]) continue;  // 2D
    if (along[k] == 0.0) {
      if (from[k] < lattice_.min[k] || from[k] > lattice_.max[k]) return false;
      continue;
    }
    const double a = (lattice_.min[k] - from[k]) / along[k], b = (lattice_.max[k] - from[k]) / along[k];
    begin = std::fmax(begin, std::fmin(a, b));
    end = std::fmin(end, std::fmax(a, b));
  }
  if (!(begin <= end)) return false;
  std::array<std::int64_t, 3> cell{}, step{};
  Vec3 next(std::numeric_limits<double>::infinity()), stride(std::numeric_limits<double>::infinity());
  for (int k = 0; k < 3; ++k) {
    cell[at(k)] = cell_of(from[k] + begin * along[k], k);
    if (along[k] == 0.0 || cells_[at(k)] == 1) continue;
    step[at(k)] = along[k] > 0.0 ? 1 : -1;
    const auto wall = static_cast<double>(cell[at(k)] + (along[k] > 0.0 ? 1 : 0));
    next[k] = (lattice_.min[k] + wall * cell_[k] - from[k]) / along[k];
    stride[k] = cell_[k] / std::fabs(along[k]);
  }
  for (;;) {
    ++buckets;
    if (use_bucket(index(cell[0], cell[1], cell[2]), use)) return true;
    const int k = next.x <= next.y ? (next.x <= next.z ? 0 : 2) : (next.y <= next.z ? 1 : 2);
    if (!(next[k] <= end)) return false;
    cell[at(k)] += step[at(k)];
    if (cell[at(k)] < 0 || cell[at(k)] >= cells_[at(k)]) return false;
    next[k] += stride[k];
  }
}

template <class Use>
void BucketGrid::near(const Bounds& box, const Use& use) const {
  const auto always = [&use](std::uint32_t name) {
    use(name);
    return false;
  };
  for (const std::uint32_t name : apart_) use(name);
  if (starts_.empty()) return;
  for (int k = 0; k < 3; ++k) {
    if (box.max[k] < lattice_.min[k] || box.min[k] > lattice_.max[k]) return;
  }
  for_buckets(range_of(box), [&](std::size_t bucket) { use_bucket(bucket, always); });
}

}  // namespace gridcull
