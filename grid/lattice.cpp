#include "gridcull/grid/lattice.h"

#include <cmath>
#include <cstdio>
#include <string>

#include "gridcull/core/error.h"

namespace gridcull {
namespace {

constexpr double greatest_cells = 4e18;  // keeps every product of extents inside 64 bits

double cells_along(double extent, double cell) { return std::fmax(1.0, std::ceil(extent / cell)); }

std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.6g", value);
  return buffer;
}

double bytes_at(int dimension, const Vec3& extent, double cell) {
  double cells = cells_along(extent.x, cell) * cells_along(extent.y, cell);
  if (dimension == 3) cells *= cells_along(extent.z, cell);
  return cells;
}

/// Smallest of the cell sizes 1, 2, 5, 10, ... times a power of ten that fits.
double cell_that_fits(int dimension, const Vec3& extent, double cell, std::uint64_t max_memory) {
  double size = std::pow(10.0, std::floor(std::log10(cell)));
  for (int i = 0; i < 400; ++i) {
    for (const double step : {1.0, 2.0, 5.0}) {
      const double c = size * step;
      if (c > cell && bytes_at(dimension, extent, c) < static_cast<double>(max_memory) / 2) return c;
    }
    size *= 10.0;
  }
  return size;
}

}  // namespace

Lattice::Lattice(int dimension, const Bounds& bounds, double cell, std::uint64_t max_memory)
    : dimension_(dimension), cell_(cell), origin_(bounds.min) {
  const Vec3 extent = bounds.size();
  if (bounds.empty() || !std::isfinite(extent.x) || !std::isfinite(extent.y) || !std::isfinite(extent.z) ||
      extent.y < 0.0 || extent.z < 0.0) {
    throw Error(ErrorCode::bad_scene, "bounds: expected finite min and max with min at most max");
  }
  if (!(cell > 0.0) || !std::isfinite(cell)) {
    throw Error(ErrorCode::bad_scene, "grid.cell: expected a size above 0, found " + text(cell));
  }
  const double cells = bytes_at(dimension, extent, cell);
  const Vec3 along(cells_along(extent.x, cell), cells_along(extent.y, cell),
                   dimension == 3 ? cells_along(extent.z, cell) : 1.0);
  const bool countable = cells < greatest_cells && along.x < 1e12 && along.y < 1e12 && along.z < 1e12;
  if (countable) {
    cells_ = {static_cast<std::int64_t>(along.x), static_cast<std::int64_t>(along.y),
              static_cast<std::int64_t>(along.z)};
  }
  if (!countable || bytes_for(dimension, cells_) > max_memory) {
    throw Error(ErrorCode::limit, "grid.cell: cells of " + text(cell) + " m need " +
                                      (countable ? text(static_cast<double>(bytes_for(dimension, cells_))) : "over 1e18") +
                                      " bytes, more than the " + text(static_cast<double>(max_memory)) +
                                      " allowed; a cell of " +
                                      text(cell_that_fits(dimension, extent, cell, max_memory)) + " m would fit");
  }
  const auto bricks_along = [&](std::int64_t n) { return (n + brick_edge() - 1) >> brick_shift(); };
  bricks_ = {bricks_along(cells_.x), bricks_along(cells_.y), dimension == 3 ? bricks_along(cells_.z) : 1};
  brick_count_ = static_cast<std::size_t>(bricks_.x * bricks_.y * bricks_.z);
}

Bounds Lattice::box() const {
  return {origin_, {boundary(0, cells_.x), boundary(1, cells_.y), dimension_ == 3 ? boundary(2, cells_.z) : origin_.z}};
}

std::int64_t Lattice::index(int axis, double metres) const {
  constexpr double limit = 0x1p40;
  const double guess = std::floor((metres - origin_[axis]) / cell_);
  if (!(guess > -limit)) return -(std::int64_t{1} << 40);
  if (!(guess < limit)) return std::int64_t{1} << 40;
  auto i = static_cast<std::int64_t>(guess);
  while (boundary(axis, i) > metres) --i;
  while (boundary(axis, i + 1) <= metres) ++i;
  return i;
}

Cell Lattice::cell_of(const Vec3& point) const {
  return {index(0, point.x), index(1, point.y), dimension_ == 3 ? index(2, point.z) : 0};
}

double Lattice::margin(double magnitude) const {
  const Bounds b = box();
  for (int k = 0; k < 3; ++k) magnitude = std::fmax(magnitude, std::fmax(std::fabs(b.min[k]), std::fabs(b.max[k])));
  return 0x1p-44 * magnitude;
}

Cell Lattice::brick_corner(std::size_t brick) const {
  const auto b = static_cast<std::int64_t>(brick);
  const int s = brick_shift();
  const std::int64_t z = b / (bricks_.x * bricks_.y);
  const std::int64_t rest = b - z * bricks_.x * bricks_.y;
  return {(rest % bricks_.x) << s, (rest / bricks_.x) << s, z << s};
}

std::uint64_t Lattice::brick_cells(std::size_t brick) const {
  const Cell low = brick_corner(brick);
  const int edge = brick_edge();
  std::uint64_t bits = 0;
  for (int z = 0; z < (dimension_ == 3 ? edge : 1); ++z) {
    for (int y = 0; y < edge; ++y) {
      for (int x = 0; x < edge; ++x) {
        const Cell c{low.x + x, low.y + y, low.z + z};
        if (holds(c)) bits |= std::uint64_t{1} << bit_of(c);
      }
    }
  }
  return bits;
}

std::uint64_t Lattice::bytes_for(int dimension, const Cell& cells) {
  const int s = dimension == 2 ? brick_shift_2d : brick_shift_3d;
  const auto along = [&](std::int64_t n) { return static_cast<std::uint64_t>((n + (1 << s) - 1) >> s); };
  const std::uint64_t bricks = along(cells.x) * along(cells.y) * (dimension == 3 ? along(cells.z) : 1);
  // Per brick: O and O_s (8 bytes each), heads of I and T (4 each), and one viewer's copy of O, its H and
  // its visible cells (8 each).
  return bricks * 48;
}

}  // namespace gridcull
