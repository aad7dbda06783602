#include "gridcull/methods/bucket_grid.h"

#include <algorithm>

namespace gridcull {
namespace {

constexpr double buckets_an_item = 2.0;
constexpr double most_buckets_of_one = 4096.0;
constexpr std::int64_t most_along_an_axis = 2048;

bool holds(const Bounds& outer, const Bounds& inner) {
  for (int k = 0; k < 3; ++k) {
    if (inner.min[k] < outer.min[k] || inner.max[k] > outer.max[k]) return false;
  }
  return true;
}

}  // namespace

BucketGrid::Range BucketGrid::range_of(const Bounds& box) const {
  Range r{};
  for (int k = 0; k < 3; ++k) r.low[at(k)] = cell_of(box.min[k], k), r.high[at(k)] = cell_of(box.max[k], k);
  return r;
}

double BucketGrid::buckets_in(const Bounds& box) const {
  const Range r = range_of(box);
  double count = 1.0;
  for (int k = 0; k < 3; ++k) count *= static_cast<double>(r.high[at(k)] - r.low[at(k)] + 1);
  return count;
}

bool BucketGrid::is_apart(const Bounds& box) const {
  return !holds(world_, box) || buckets_in(box) > most_buckets_of_one;
}

bool BucketGrid::choose(std::span<const Item> items, const Bounds& world, int dimension) {
  world_ = world;
  if (dimension == 2) world_.min.z = world_.max.z = 0.0;
  lattice_ = Bounds{};
  double count = 0.0, edges = 0.0;
  for (const Item& item : items) {
    if (!holds(world_, item.box)) continue;
    lattice_.add(item.box.min);
    lattice_.add(item.box.max);
    count += 1.0;
    const Vec3 size = item.box.size();
    edges += std::max({size.x, size.y, size.z});
  }
  if (lattice_.empty()) return false;
  const Vec3 size = lattice_.size();
  const double room = dimension == 2 ? size.x * size.y : size.x * size.y * size.z;
  const double wanted = room / (buckets_an_item * count);
  // Not below the items' mean size: 100,000 spheres that overlap would lie in 50 buckets each.
  const double edge = std::max(dimension == 2 ? std::sqrt(wanted) : std::cbrt(wanted), edges / count);
  for (int k = 0; k < 3; ++k) {
    const double along = edge > 0.0 ? std::floor(size[k] / edge) : 1.0;
    cells_[at(k)] = std::clamp(static_cast<std::int64_t>(std::fmin(along, 1e6)), std::int64_t{1}, most_along_an_axis);
    cell_[k] = size[k] / static_cast<double>(cells_[at(k)]);
    per_metre_[k] = cell_[k] > 0.0 ? 1.0 / cell_[k] : 0.0;
  }
  return true;
}

// A counting sort: how many in each bucket, where each bucket ends, then the names from the back.
void BucketGrid::build(std::span<const Item> items, const Bounds& world, int dimension) {
  starts_.clear();
  names_.clear();
  apart_.clear();
  if (!choose(items, world, dimension)) {
    for (const Item& item : items) apart_.push_back(item.name);
    return;
  }
  starts_.assign(static_cast<std::size_t>(cells_[0] * cells_[1] * cells_[2]) + 1, 0);
  for (const Item& item : items) {
    if (is_apart(item.box)) {
      apart_.push_back(item.name);
    } else {
      for_buckets(range_of(item.box), [this](std::size_t bucket) { ++starts_[bucket]; });
    }
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& start : starts_) start = sum += start;
  names_.resize(sum);
  for (const Item& item : items) {
    if (is_apart(item.box)) continue;
    for_buckets(range_of(item.box), [&](std::size_t bucket) { names_[--starts_[bucket]] = item.name; });
  }
}

}  // namespace gridcull
