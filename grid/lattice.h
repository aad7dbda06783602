// The lattice: the world's box cut into cubic cells, and the only place that converts between metres and
// cells (Batagelo and Wu 2002, section 3).
//
// Cells are kept in bricks of 64, one machine word of bits each: 8 x 8 in 2D, 4 x 4 x 4 in 3D, x fastest.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "gridcull/core/bounds.h"
#include "gridcull/core/vec.h"

namespace gridcull {

/// Cell coordinates; cells of the lattice have 0 <= x < cells().x and so on. z = 0 in 2D. A viewer outside
/// the lattice has coordinates beyond it: the cells go on to infinity.
struct Cell {
  std::int64_t x = 0, y = 0, z = 0;
  bool operator==(const Cell&) const = default;
};

/// What a lattice's matrices may take.
enum class Room {
  whole,        ///< every brick may hold something: bytes_for() must fit
  where_needed  ///< room is taken where something is, and whoever takes it sees to the limit
};

class Lattice {
 public:
  /// Cells of side `cell` (metres, > 0) from bounds.min on, as many as cover the bounds, at least one.
  /// Throws Error(bad_scene) for empty or non-finite bounds or cell, Error(limit) when bytes_for() exceeds
  /// `max_memory` (Room::whole) or there would be 2^32 bricks or more (the message says what cell size would fit).
  Lattice(int dimension, const Bounds& bounds, double cell, std::uint64_t max_memory, Room room = Room::whole);

  int dimension() const { return dimension_; }
  double cell() const { return cell_; }
  const Vec3& origin() const { return origin_; }
  Cell cells() const { return cells_; }
  std::uint64_t cell_count() const {
    return static_cast<std::uint64_t>(cells_.x) * static_cast<std::uint64_t>(cells_.y) *
           static_cast<std::uint64_t>(cells_.z);
  }
  /// The box of all cells.
  Bounds box() const;

  /// Lower boundary of cell i along an axis, metres: origin + i * cell, rounded once per operation.
  double boundary(int axis, std::int64_t i) const { return origin_[axis] + static_cast<double>(i) * cell_; }
  /// The i with boundary(i) <= metres < boundary(i + 1), also beyond the lattice; clamped to +-2^40.
  std::int64_t index(int axis, double metres) const;
  Cell cell_of(const Vec3& point) const;
  /// As index() but cheaper and only nearly so: right for every point farther than margin() from a cell
  /// boundary, a neighbour otherwise; clamped to the lattice. The same input gives the same answer.
  std::int64_t near_index(int axis, double metres) const {
    const double t = (metres - origin_[axis]) / cell_;
    const std::int64_t last = (axis == 0 ? cells_.x : axis == 1 ? cells_.y : cells_.z) - 1;
    if (!(t > 0.0)) return 0;
    return t < static_cast<double>(last) ? static_cast<std::int64_t>(t) : last;
  }
  bool holds(const Cell& c) const {
    return c.x >= 0 && c.y >= 0 && c.z >= 0 && c.x < cells_.x && c.y < cells_.y && c.z < cells_.z;
  }

  /// Metres that cover every rounding of boundary(), of poses and of shape arithmetic for coordinates up to
  /// `magnitude`: 2^-44 of the greatest coordinate, about 500 ulp of it. A cell counts as inside an
  /// occluder only if it is so when grown by this, and as touched when it is so when grown by this; hence
  /// the ideal lattice that the occlusion proofs speak of may differ from the rounded one.
  double margin(double magnitude = 0.0) const { return 0x1p-44 * std::fmax(magnitude, box_magnitude_); }

  // Bricks.
  static constexpr int brick_shift_2d = 3;
  static constexpr int brick_shift_3d = 2;
  int brick_shift() const { return dimension_ == 2 ? brick_shift_2d : brick_shift_3d; }
  /// Cells along a brick's edge: 8 or 4 (z: 1 in 2D).
  int brick_edge() const { return 1 << brick_shift(); }
  Cell bricks() const { return bricks_; }
  std::size_t brick_count() const { return brick_count_; }
  /// Index of the brick with brick coordinates b; x fastest.
  std::size_t brick_index(const Cell& b) const {
    return static_cast<std::size_t>((b.z * bricks_.y + b.y) * bricks_.x + b.x);
  }
  std::size_t brick_of(const Cell& c) const {
    const int s = brick_shift();
    return brick_index({c.x >> s, c.y >> s, dimension_ == 2 ? 0 : c.z >> s});
  }
  /// Bit of a cell inside its brick: x + 8 y in 2D, x + 4 y + 16 z in 3D (low bits of the coordinates).
  int bit_of(const Cell& c) const {
    return dimension_ == 2 ? static_cast<int>((c.x & 7) | (c.y & 7) << 3)
                           : static_cast<int>((c.x & 3) | (c.y & 3) << 2 | (c.z & 3) << 4);
  }
  /// Lowest cell of a brick.
  Cell brick_corner(std::size_t brick) const;
  /// The cell of a brick's bit: the other way round.
  Cell cell_at(std::size_t brick, int bit) const {
    const Cell corner = brick_corner(brick);
    if (dimension_ == 2) return {corner.x + (bit & 7), corner.y + (bit >> 3), 0};
    return {corner.x + (bit & 3), corner.y + (bit >> 2 & 3), corner.z + (bit >> 4)};
  }
  /// The bits of a brick that are cells of the lattice (bricks at the upper edges may stick out).
  std::uint64_t brick_cells(std::size_t brick) const;

  /// Bytes that the matrices of a lattice of this many cells take, without entries for objects.
  static std::uint64_t bytes_for(int dimension, const Cell& cells);
  /// Of these one viewer's copies, for a window of this many cells.
  static std::uint64_t window_bytes_for(int dimension, const Cell& cells);

 private:
  int dimension_;
  double cell_;
  Vec3 origin_;
  Cell cells_;
  Cell bricks_;
  std::size_t brick_count_;
  double box_magnitude_;  // greatest |coordinate| of box()
};

}  // namespace gridcull
