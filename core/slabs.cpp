// Rounding: a projection is a sum of at most three coordinates, off by at most 2 * 2^-53 (1 + 2^-53) (|x| + |y| + |z|),
// which is below 2^-51 of `size`.
#include "gridcull/core/slabs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gridcull {
namespace {

/// dot(direction J, p), the terms in the order x, y, z, without products.
template <std::size_t J>
double project(const Vec3& p) {
  constexpr SlabDirection n = slab_directions[J];
  double sum = n.x > 0 ? p.x : n.x < 0 ? -p.x : 0.0;
  if constexpr (n.y > 0) sum += p.y;
  if constexpr (n.y < 0) sum -= p.y;
  if constexpr (n.z > 0) sum += p.z;
  if constexpr (n.z < 0) sum -= p.z;
  return sum;
}

template <std::size_t J>
void widen(Slabs& slabs, const Vec3& p) {
  const double at = project<J>(p);
  slabs.low[J] = std::min(slabs.low[J], at);
  slabs.high[J] = std::max(slabs.high[J], at);
}

template <std::size_t... J>
void add_points(Slabs& slabs, std::span<const Vec3> points) {
  for (const Vec3& p : points) (widen<J>(slabs, p), ...);
}

void add_points(Slabs& slabs, std::span<const Vec3> points) {
  if (slabs.dimension == 2) {
    return slabs.kind == BoundKind::box ? add_points<0, 1>(slabs, points) : add_points<0, 1, 7, 10>(slabs, points);
  }
  switch (slabs.kind) {
    case BoundKind::dop14: return add_points<0, 1, 2, 3, 4, 5, 6>(slabs, points);
    case BoundKind::dop18: return add_points<0, 1, 2, 7, 8, 9, 10, 11, 12>(slabs, points);
    case BoundKind::dop26: return add_points<0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12>(slabs, points);
    default: return add_points<0, 1, 2>(slabs, points);
  }
}

double dot(const SlabDirection& n, const Vec3& p) { return n.x * p.x + n.y * p.y + n.z * p.z; }

}  // namespace

bool Slabs::has(std::size_t direction) const {
  if (dimension == 2) return direction < 2 || (kind != BoundKind::box && (direction == 7 || direction == 10));
  if (direction < 3) return true;
  if (direction < 7) return kind == BoundKind::dop14 || kind == BoundKind::dop26;
  return kind == BoundKind::dop18 || kind == BoundKind::dop26;
}

Slabs slabs_of(std::span<const Vec3> points, BoundKind kind, int dimension) {
  Slabs slabs{kind, dimension};
  slabs.low.fill(std::numeric_limits<double>::infinity());
  slabs.high.fill(-std::numeric_limits<double>::infinity());
  add_points(slabs, points);
  // Of a corner of the box, which is at least as far out as any point.
  for (std::size_t j = 0; j < static_cast<std::size_t>(dimension); ++j) {
    slabs.size += std::max(std::fabs(slabs.low[j]), std::fabs(slabs.high[j]));
  }
  slabs.size *= 1.0 + 0x1p-50;
  return slabs;
}

Slabs slabs_of_ball(const Vec3& centre, double radius, BoundKind kind, int dimension) {
  Slabs slabs{kind, dimension};
  for (std::size_t j = 0; j < slab_directions.size(); ++j) {
    const double at = dot(slab_directions[j], centre), reach = radius * slab_directions[j].length;
    slabs.low[j] = at - reach;
    slabs.high[j] = at + reach;
  }
  // The sums' rounding is below 2^-51 of this as above, that of `reach` too.
  slabs.size = (std::fabs(centre.x) + std::fabs(centre.y) + std::fabs(centre.z) + 3.0 * radius) * (1.0 + 0x1p-50);
  return slabs;
}

namespace {

template <std::size_t J>
void seek(std::span<const Vec3> points, std::uint32_t i, Extremes& out, Slabs& best) {
  const double at = project<J>(points[i]);
  if (at < best.low[J]) best.low[J] = at, out.lowest[J] = i;
  if (at > best.high[J]) best.high[J] = at, out.highest[J] = i;
}

template <std::size_t... J>
Extremes seek_all(std::span<const Vec3> points, std::index_sequence<J...>) {
  Extremes out;
  Slabs best;
  best.low.fill(std::numeric_limits<double>::infinity());
  best.high.fill(-std::numeric_limits<double>::infinity());
  for (std::uint32_t i = 0; i < points.size(); ++i) (seek<J>(points, i, out, best), ...);
  return out;
}

}  // namespace

Extremes extremes_of(std::span<const Vec3> points) { return seek_all(points, std::make_index_sequence<13>()); }

}  // namespace gridcull
