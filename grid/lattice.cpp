#include "gridcull/grid/lattice.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include <glm/common.hpp>

#include "gridcull/core/error.h"

namespace gridcull {
namespace {

constexpr double greatest_along = 1e12;           // cells along an axis, far below 2^40, the clamp of index()
constexpr double greatest_bricks = 0x1p32 - 1.0;  // brick indices are 32 bits in covers

double cells_along(double extent, double cell) { return std::fmax(1.0, std::ceil(extent / cell)); }

std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.6g", value);
  return buffer;
}

/// Cells along each axis, as doubles.
Vec3 count(int dimension, const Vec3& extent, double cell) {
  return {cells_along(extent.x, cell), cells_along(extent.y, cell), dimension == 3 ? cells_along(extent.z, cell) : 1.0};
}

/// Whether the numbers of cells and bricks stay inside their types.
bool countable(int dimension, const Vec3& along) {
  if (!(along.x < greatest_along && along.y < greatest_along && along.z < greatest_along)) return false;
  const double edge = dimension == 2 ? 1 << Lattice::brick_shift_2d : 1 << Lattice::brick_shift_3d;
  const auto bricks = [&](double n) { return std::ceil(n / edge); };
  return bricks(along.x) * bricks(along.y) * (dimension == 3 ? bricks(along.z) : 1.0) <= greatest_bricks;
}

Cell rounded(const Vec3& along) {
  return {static_cast<std::int64_t>(along.x), static_cast<std::int64_t>(along.y), static_cast<std::int64_t>(along.z)};
}

bool fits(int dimension, const Vec3& along, std::uint64_t max_memory) {
  return countable(dimension, along) && Lattice::bytes_for(dimension, rounded(along)) <= max_memory;
}

/// Smallest of the cell sizes 1, 2, 5, 10, ... times a power of ten above `cell` that fits; the greatest
/// tried where not even one brick does.
double cell_that_fits(int dimension, const Vec3& extent, double cell, std::uint64_t max_memory) {
  double size = std::pow(10.0, std::floor(std::log10(cell)));
  for (int i = 0; i < 400 && std::isfinite(size); ++i) {
    for (const double step : {1.0, 2.0, 5.0}) {
      const double c = size * step;
      if (c > cell && fits(dimension, count(dimension, extent, c), max_memory)) return c;
    }
    size *= 10.0;
  }
  return size;
}

[[noreturn]] void refuse(int dimension, const Vec3& extent, double cell, std::uint64_t max_memory) {
  const Vec3 along = count(dimension, extent, cell);
  const std::string need = countable(dimension, along)
                               ? text(static_cast<double>(Lattice::bytes_for(dimension, rounded(along)))) +
                                     " bytes, more than the " + text(static_cast<double>(max_memory)) + " allowed"
                               : "more than 2^32 bricks of 64 cells";
  std::string message = "grid.cell: cells of " + text(cell) + " m need " + need;
  const double fit = cell_that_fits(dimension, extent, cell, max_memory);
  if (std::isfinite(fit)) message += "; a cell of " + text(fit) + " m would fit";
  throw Error(ErrorCode::limit, message);
}

}  // namespace

Lattice::Lattice(int dimension, const Bounds& bounds, double cell, std::uint64_t max_memory, Room room)
    : dimension_(dimension), cell_(cell), origin_(bounds.min) {
  const Vec3 extent = bounds.size();
  if (bounds.empty() || !std::isfinite(extent.x) || !std::isfinite(extent.y) || !std::isfinite(extent.z) ||
      extent.y < 0.0 || extent.z < 0.0) {
    throw Error(ErrorCode::bad_scene, "bounds: expected finite min and max with min at most max");
  }
  if (!(cell > 0.0) || !(cell <= 1e9)) {
    throw Error(ErrorCode::bad_scene, "grid.cell: expected a size above 0 and at most 1e9, found " + text(cell));
  }
  const Vec3 along = count(dimension, extent, cell);
  if (room == Room::where_needed) max_memory = std::numeric_limits<std::uint64_t>::max();
  if (!fits(dimension, along, max_memory)) refuse(dimension, extent, cell, max_memory);
  const Vec3 far = glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
  if (cell < 0x1p-40 * std::fmax(far.x, std::fmax(far.y, far.z))) {
    throw Error(ErrorCode::bad_scene,
                "grid.cell: expected at least 1e-12 of the bounds' greatest coordinate, found " + text(cell));
  }
  cells_ = rounded(along);
  const auto bricks_along = [&](std::int64_t n) { return (n + brick_edge() - 1) >> brick_shift(); };
  bricks_ = {bricks_along(cells_.x), bricks_along(cells_.y), dimension == 3 ? bricks_along(cells_.z) : 1};
  brick_count_ = static_cast<std::size_t>(bricks_.x * bricks_.y * bricks_.z);
  const Bounds b = box();
  box_magnitude_ = 0.0;
  for (int k = 0; k < 3; ++k) {
    box_magnitude_ = std::fmax(box_magnitude_, std::fmax(std::fabs(b.min[k]), std::fabs(b.max[k])));
  }
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

Cell Lattice::brick_corner(std::size_t brick) const {
  // Brick indices stay below 2^32: 32-bit divisions are the cheap ones.
  const auto b = static_cast<std::uint32_t>(brick), nx = static_cast<std::uint32_t>(bricks_.x),
             ny = static_cast<std::uint32_t>(bricks_.y);
  const std::uint32_t row = b / nx, z = row / ny;
  const int s = brick_shift();
  return {std::int64_t{b - row * nx} << s, std::int64_t{row - z * ny} << s, std::int64_t{z} << s};
}

std::uint64_t Lattice::brick_cells(std::size_t brick) const {
  const Cell low = brick_corner(brick);
  const std::int64_t edge = brick_edge();
  const std::int64_t nx = std::min(edge, cells_.x - low.x), ny = std::min(edge, cells_.y - low.y);
  const std::int64_t nz = dimension_ == 3 ? std::min(edge, cells_.z - low.z) : 1;
  const std::int64_t layer_bits = edge * edge;  // 64 in 2D, 16 in 3D
  if (nx == edge && ny == edge && nz * layer_bits == 64) return ~std::uint64_t{0};
  const std::uint64_t row = (std::uint64_t{1} << nx) - 1;
  std::uint64_t bits = 0;
  for (std::int64_t z = 0; z < nz; ++z) {
    for (std::int64_t y = 0; y < ny; ++y) bits |= row << (y * edge + z * layer_bits);
  }
  return bits;
}

namespace {

std::uint64_t bricks_for(int dimension, const Cell& cells) {
  const int s = dimension == 2 ? Lattice::brick_shift_2d : Lattice::brick_shift_3d;
  const auto along = [&](std::int64_t n) { return static_cast<std::uint64_t>((n + (1 << s) - 1) >> s); };
  return along(cells.x) * along(cells.y) * (dimension == 3 ? along(cells.z) : 1);
}

}  // namespace

std::uint64_t Lattice::bytes_for(int dimension, const Cell& cells) {
  // Per brick: O and O_s (8 bytes each), the heads of I (4 each), counts, homes and record of T (76).
  return bricks_for(dimension, cells) * 100 + window_bytes_for(dimension, cells);
}

std::uint64_t Lattice::window_bytes_for(int dimension, const Cell& cells) {
  // Per brick: O, visible cells and, in 2D, H and the cells that legs hold, in 3D the newly visible ones (8 each).
  std::uint64_t bytes = bricks_for(dimension, cells) * (dimension == 2 ? 40 : 24);
  if (dimension == 2) return bytes;
  // 3D: a viewer's H, planes of rows of whole words; two opposite faces share the planes of an axis.
  const auto words = [](std::int64_t n) { return static_cast<std::uint64_t>(n / 64 + 2); };
  const auto count = [](std::int64_t n) { return static_cast<std::uint64_t>(n); };
  bytes += 8 * (count(cells.x) * count(cells.z) * words(cells.y) + count(cells.y) * count(cells.z) * words(cells.x) +
                count(cells.z) * count(cells.y) * words(cells.x));
  return bytes;
}

}  // namespace gridcull
