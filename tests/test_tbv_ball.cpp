// The one test that all indexes of temporal bounding volumes share, cell by cell.
#include <bit>

#include <doctest/doctest.h>

#include "tbv_index_check.h"

namespace gridcull::test {
namespace {

/// Squared distance of a point to a cell, less the squared radius.
double gap(const Lattice& lattice, const Cell& c, const TbvBall& ball) {
  double square = 0.0;
  for (int k = 0; k < 3; ++k) {
    const std::int64_t i = k == 0 ? c.x : k == 1 ? c.y : c.z;
    const double low = lattice.boundary(k, i), high = lattice.boundary(k, i + 1), p = ball.centre[k];
    const double d = p < low ? low - p : p > high ? p - high : 0.0;
    square += d * d;
  }
  return square - ball.radius * ball.radius;
}

}  // namespace

TEST_CASE("a ball touches cells of a brick when it comes near enough to one of them") {
  const Lattice lattice = small_lattice();
  int met = 0, missed = 0;
  for (std::uint64_t seed = 1; seed <= 20000; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const TbvBall ball = random_ball(random, lattice);
    Question q = random_question(random, lattice);
    if (random.below(2) == 0) q.brick = lattice.brick_of(lattice.cell_of(ball.centre));
    q.bits &= lattice.brick_cells(q.brick);
    if (q.bits == 0) continue;
    double least = 1e300;
    const Cell corner = lattice.brick_corner(q.brick);
    for (std::uint64_t rest = q.bits; rest != 0; rest &= rest - 1) {
      const int bit = std::countr_zero(rest);
      least =
          std::min(least, gap(lattice, {corner.x + (bit & 3), corner.y + (bit >> 2 & 3), corner.z + (bit >> 4)}, ball));
    }
    const BrickCells asked(lattice, q.brick, q.bits);
    const bool touched = asked.touch(ball);
    if (least <= 0.0) CHECK(touched);
    // Balls that are just too far, by a margin, may count; no others.
    if (least > 1e-9) CHECK_FALSE(touched);
    if (touched) CHECK(asked.near(ball));
    if (touched) CHECK(asked.meet(ball.box()));
    ++(touched ? met : missed);
  }
  CHECK(met > 2000);
  CHECK(missed > 2000);
}

}  // namespace gridcull::test
