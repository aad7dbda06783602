// The matrix T of solid temporal bounding volumes (Batagelo and Wu 2002, sections 3 and 4.1; Sudarsky and
// Gotsman 1999).
//
// The paper enters a volume's id into every cell that it spans. Here a volume is entered once, in the cell
// of the level whose side is at least its radius and that holds its centre ("loose": it reaches at most a
// side beyond). The cell keeps a box around its volumes, and every brick counts the boxes that reach it: a
// brick that nobody's box reaches costs one load in the traversal, and renewing a volume where it was costs a few
// stores, whatever its size, because boxes seldom change.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "gridcull/grid/identifier_matrix.h"
#include "gridcull/grid/lattice.h"
#include "gridcull/grid/tbv_ball.h"

namespace gridcull {

class TbvMatrix {
 public:
  using Ball = TbvBall;

  explicit TbvMatrix(const Lattice& lattice);

  void reserve(std::size_t slots) {
    if (slots > links_.capacity()) links_.reserve(slots + slots / 8), balls_.reserve(slots + slots / 8);
    if (slots > links_.size()) links_.resize(slots), balls_.resize(slots);
  }

  /// Blocks are two bricks wide: coarse enough that a ball lies in a few of them. First and last along each
  /// axis that hold every cell the ball may touch.
  struct BlockSpan {
    std::array<std::int64_t, 3> low, high;
    bool operator==(const BlockSpan&) const = default;
    std::uint64_t size() const {
      std::uint64_t n = 1;
      for (std::size_t k = 0; k < 3; ++k) n *= static_cast<std::uint64_t>(high[k] - low[k] + 1);
      return n;
    }
  };
  BlockSpan span_of(const Ball& ball) const;
  std::size_t block_index(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return static_cast<std::size_t>((z * blocks_.y + y) * blocks_.x + x);
  }
  std::size_t block_count() const { return static_cast<std::size_t>(blocks_.x * blocks_.y * blocks_.z); }
  /// The block that holds a brick.
  std::size_t block_of(std::size_t brick) const {
    const Cell corner = lattice_.brick_corner(brick);
    const int shift = lattice_.brick_shift() + 1;
    return block_index(corner.x >> shift, corner.y >> shift, corner.z >> shift);
  }

  /// Whether the ball lies wholly in the lattice, so that insert() takes it.
  bool fits(const Ball& ball) const;
  /// The slot must not be in the matrix; `ball` must fit.
  void insert(Slot slot, const Ball& ball);
  void erase(Slot slot);
  /// Erases the slot if it is there and inserts it, at little cost where its place stays the same.
  void renew(Slot slot, const Ball& ball);
  /// Hints that the slot will be renewed soon.
  void prefetch(Slot slot) const {
    if (slot >= links_.size()) return;  // never had a volume
    __builtin_prefetch(&links_[slot]);
    __builtin_prefetch(&balls_[slot]);
  }
  bool holds(Slot slot) const { return slot < links_.size() && links_[slot].level != none; }
  /// The slot's ball, also of volumes kept elsewhere (outlines, volumes beyond the lattice).
  const Ball& ball(Slot slot) const { return balls_[slot]; }
  void set_ball(Slot slot, const Ball& ball) { balls_[slot] = ball; }
  std::uint64_t size() const { return size_; }

  /// Whether some volume may touch the brick.
  bool may_touch(std::size_t brick) const { return counts_[brick] != 0; }

  /// Calls f(slot) for every volume that may touch one of the cells `bits` of the brick and for which
  /// wanted(slot). f must not change the matrix.
  template <class W, class F>
  TbvLook touching(std::size_t brick, std::uint64_t bits, W&& wanted, F&& f) const;

  std::uint64_t matrix_bytes() const;
  /// Cells of levels and counts of bricks written so far.
  std::uint64_t places_written() const { return written_; }
  std::uint64_t entry_bytes() const { return links_.capacity() * sizeof(Link) + balls_.capacity() * sizeof(Ball); }

 private:
  struct Link {
    std::uint32_t before = none, after = none, cell = none, level = none;
  };
  /// A level's cell: its volumes and a box around them, which spares looking at crowds that stay away from
  /// the cell's loose border. The box only grows until twice as many volumes have left as are there; then it
  /// is made anew.
  struct Home {
    std::uint32_t head = none;
    std::uint32_t size = 0;
    std::uint32_t left = 0;
    Bounds box{};
  };
  struct Level {
    Cell cells;             // level cells along each axis
    int shift = 0;          // level cell = cell >> shift
    double side = 0;        // metres
    LazyArray<Home> homes;  // mapped on first use
    std::uint64_t size = 0;
  };

  std::uint32_t level_for(double radius) const;
  std::uint32_t level_cell(const Level& level, const Cell& c) const;
  std::uint32_t home_cell(const Level& level, const Ball& ball) const;
  /// Takes the ball, whose link hangs in the home already, into the home's box.
  void grow_box(Home& home, const Ball& ball);
  void set_box(Home& home, const Bounds& box);
  /// Bricks that hold every cell the box may touch.
  BlockSpan bricks_of(const Bounds& box) const;
  /// Adds `step` to the count of every brick of the span.
  void count(const BlockSpan& span, std::uint32_t step);
  /// First and last index along each axis, after a shift, of the cells that [low, high] may touch.
  BlockSpan cells_of(const Vec3& low, const Vec3& high, int shift) const;
  const Lattice& lattice_;
  std::vector<Level> levels_;
  Cell blocks_;                      // along each axis
  LazyArray<std::uint32_t> counts_;  // per brick: boxes of homes that may touch it
  Bounds box_;                       // of the lattice
  std::vector<Link> links_;
  std::vector<Ball> balls_;
  std::uint64_t size_ = 0;
  std::uint64_t written_ = 0;
};

template <class W, class F>
TbvLook TbvMatrix::touching(std::size_t brick, std::uint64_t bits, W&& wanted, F&& f) const {
  TbvLook looked;
  const BrickCells asked(lattice_, brick, bits);
  const Cell& corner = asked.corner();
  const std::int64_t edge = lattice_.brick_edge();
  for (const Level& level : levels_) {
    if (level.size == 0) continue;
    // Level cells whose volumes may reach the brick: they reach a side beyond their cell.
    const std::int64_t reach = std::int64_t{1} << level.shift;
    Cell low, high;
    const auto span = [&](std::int64_t from, std::int64_t count, std::int64_t& l, std::int64_t& h) {
      l = std::max<std::int64_t>(0, (from - reach) >> level.shift);
      h = std::min(count - 1, (from + edge - 1 + reach) >> level.shift);
    };
    span(corner.x, level.cells.x, low.x, high.x);
    span(corner.y, level.cells.y, low.y, high.y);
    if (lattice_.dimension() == 3) span(corner.z, level.cells.z, low.z, high.z);
    for (std::int64_t z = low.z; z <= high.z; ++z) {
      for (std::int64_t y = low.y; y <= high.y; ++y) {
        for (std::int64_t x = low.x; x <= high.x; ++x) {
          const auto cell = static_cast<std::size_t>((z * level.cells.y + y) * level.cells.x + x);
          ++looked.places;
          const Home& home = level.homes[cell];
          if (home.size == 0 || !asked.meet(home.box)) continue;
          for (std::uint32_t slot = home.head; slot != none; slot = links_[slot].after) {
            ++looked.volumes;
            if (asked.near(balls_[slot]) && wanted(slot) && asked.touch(balls_[slot])) f(slot);
          }
        }
      }
    }
  }
  return looked;
}

}  // namespace gridcull
