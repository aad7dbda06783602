// The ring of cells at one chess distance, walked from the seed both ways (Batagelo and Wu 2002, section
// 4.2, the six direction cases; Figure 2).
//
// Changed: the paper steps cell by cell; a walk here hands out the straight stretches between the points
// where the direction changes (|x| = |y|), so that they can be treated as words of bits.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

#include "gridcull/grid/lattice.h"

namespace gridcull {

/// Straight stretch of a ring: cells from..to along `axis` (from may exceed to: the walk's direction), the
/// other coordinate fixed.
struct Stretch {
  int axis;  ///< 0: along x, 1: along y
  std::int64_t from, to;
  std::int64_t fixed;
};

struct Direction {
  int x = 0, y = 0;
};

/// The two directions from a seed (x, y) relative to the viewer's cell, not (0, 0): the paper's six cases.
inline std::array<Direction, 2> seed_directions(std::int64_t x, std::int64_t y) {
  const std::int64_t ax = std::llabs(x), ay = std::llabs(y);
  if (ax > ay) return {Direction{0, 1}, Direction{0, -1}};
  if (ay > ax) return {Direction{1, 0}, Direction{-1, 0}};
  if (x > 0 && y > 0) return {Direction{-1, 0}, Direction{0, -1}};
  if (x < 0 && y < 0) return {Direction{1, 0}, Direction{0, 1}};
  if (x < 0 && y > 0) return {Direction{1, 0}, Direction{0, -1}};
  return {Direction{-1, 0}, Direction{0, 1}};
}

/// Calls f(stretch) for the stretches of the ring through `seed`, which together hold every cell of the ring
/// once: first along one direction of the seed, then along the other, each until it meets the cell opposite.
/// A direction ends early when f returns false (the walk has left the view).
template <class F>
void walk_ring(const Cell& seed, F&& f) {
  const std::int64_t k = std::max<std::int64_t>(std::llabs(seed.x), std::llabs(seed.y));
  const std::int64_t half = 4 * k;  // cells of the ring: 8k; the first walk takes the seed and 4k more
  const auto directions = seed_directions(seed.x, seed.y);
  for (std::size_t d = 0; d < 2; ++d) {
    Direction step = directions[d];
    Cell at = seed;
    std::int64_t left = d == 0 ? half + 1 : half - 1;
    if (d == 1) at = {at.x + step.x, at.y + step.y, 0};
    while (left > 0) {
      // To the corner ahead: there |x| = |y| and the direction turns towards the side still ahead.
      const std::int64_t position = step.x != 0 ? at.x : at.y;
      const int sign = step.x + step.y;
      const std::int64_t corner = sign * k;
      const std::int64_t count = std::min<std::int64_t>(left, std::llabs(corner - position) + 1);
      const Stretch stretch{step.x != 0 ? 0 : 1, position, position + sign * (count - 1), step.x != 0 ? at.y : at.x};
      if (!f(stretch)) break;
      left -= count;
      Cell end = at;
      (step.x != 0 ? end.x : end.y) = stretch.to;
      step = step.x != 0 ? Direction{0, end.y > 0 ? -1 : 1} : Direction{end.x > 0 ? -1 : 1, 0};
      at = {end.x + step.x, end.y + step.y, 0};
    }
  }
}

}  // namespace gridcull
