// Indexes of temporal bounding volumes against a plain list of balls.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/core/random.h"
#include "gridcull/grid/identifier_matrix.h"
#include "gridcull/grid/tbv_ball.h"

namespace gridcull::test {

inline Lattice small_lattice() {
  return {3, Bounds{{-7.3, 2.0, 0.0}, {34.7, 35.6, 21.0}}, 0.7, std::uint64_t{1} << 30};  // 60 x 48 x 30 cells
}

/// Inside the lattice: of any size from a point on, now and then with its rim on cell boundaries.
inline TbvBall random_ball(Random& random, const Lattice& lattice) {
  const Bounds box = lattice.box();
  const double rim = 4.0 * lattice.margin();
  TbvBall ball;
  ball.radius = random.below(8) == 0 ? random.uniform(0.0, 8.0) : random.uniform(0.0, 2.0);
  const bool even = random.below(4) == 0;
  if (even) ball.radius = lattice.cell() * random.below(4);
  for (int k = 0; k < 3; ++k) {
    const double low = box.min[k] + ball.radius + rim, high = box.max[k] - ball.radius - rim;
    ball.centre[k] = random.uniform(low, high);
    if (even) ball.centre[k] = std::clamp(lattice.boundary(k, lattice.index(k, ball.centre[k])), low, high);
  }
  return ball;
}

/// A ball a little way from another.
inline TbvBall nearby_ball(Random& random, const Lattice& lattice, const TbvBall& old) {
  const Bounds box = lattice.box();
  TbvBall ball{old.centre, std::max(0.0, old.radius + random.uniform(-0.3, 0.3))};
  ball.radius = std::min(ball.radius, 8.0);
  for (int k = 0; k < 3; ++k) {
    const double rim = ball.radius + 4.0 * lattice.margin();
    ball.centre[k] = std::clamp(ball.centre[k] + random.uniform(-1.5, 1.5), box.min[k] + rim, box.max[k] - rim);
  }
  return ball;
}

struct Question {
  std::size_t brick;
  std::uint64_t bits;
};

inline Question random_question(Random& random, const Lattice& lattice) {
  Question q{static_cast<std::size_t>(random.below(static_cast<std::uint32_t>(lattice.brick_count()))), 0};
  while (q.bits == 0) {
    q.bits = random.bits();
    if (random.below(2) == 0) q.bits &= random.bits() & random.bits() & random.bits();  // few cells
    q.bits &= lattice.brick_cells(q.brick);
  }
  return q;
}

using Balls = std::map<Slot, TbvBall>;

inline std::vector<Slot> touching_truth(const Lattice& lattice, const Balls& balls, const Question& q) {
  const BrickCells asked(lattice, q.brick, q.bits);
  std::vector<Slot> out;
  for (const auto& [slot, ball] : balls) {
    if (asked.touch(ball)) out.push_back(slot);
  }
  return out;
}

template <class Index>
std::vector<Slot> touching_in(Index& index, const Question& q) {
  std::vector<Slot> out;
  index.touching(
      q.brick, q.bits, [](Slot) { return true; }, [&](Slot slot) { out.push_back(slot); });
  std::sort(out.begin(), out.end());
  return out;
}

/// Comes, goes, moves near and moves far of random volumes; `check(index, balls)` every few of them.
template <class Index, class Check>
void live_at_random(Index& index, const Lattice& lattice, std::uint64_t seed, Check&& check) {
  CAPTURE(seed);
  Random random(seed);
  const std::uint32_t slots = 20 + random.below(300);
  index.reserve(slots);
  Balls balls;
  for (int step = 0; step < 1500; ++step) {
    const Slot slot = random.below(slots);
    const auto found = balls.find(slot);
    if (found == balls.end()) {
      index.insert(slot, balls[slot] = random_ball(random, lattice));
    } else if (const std::uint32_t dice = random.below(10); dice == 0 || (dice < 5 && step > 1000)) {
      index.erase(slot);
      balls.erase(found);
    } else {
      found->second = dice < 8 ? nearby_ball(random, lattice, found->second) : random_ball(random, lattice);
      index.renew(slot, found->second);
    }
    REQUIRE(index.holds(slot) == balls.contains(slot));
    REQUIRE(index.size() == balls.size());
    if (step % 50 != 49) continue;
    CAPTURE(step);
    for (int i = 0; i < 40; ++i) {
      const Question q = random_question(random, lattice);
      REQUIRE(touching_in(index, q) == touching_truth(lattice, balls, q));
    }
    check(index, balls);
  }
}

}  // namespace gridcull::test
