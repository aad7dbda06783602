// The octree of temporal bounding volumes against a plain list, and its shape.
#include <cmath>

#include <doctest/doctest.h>

#include "gridcull/grid/tbv_octree.h"
#include "tbv_index_check.h"

namespace gridcull::test {
namespace {

TbvOctree::Limits random_limits(std::uint64_t seed) {
  Random random(seed + 1000);
  const std::uint32_t split = 2 + random.below(12);
  return {split, random.below(split), 1 + random.below(8)};
}

double distance(const TbvBall& ball, const Bounds& box) {
  double square = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double gap = std::max({box.min[k] - ball.centre[k], ball.centre[k] - box.max[k], 0.0});
    square += gap * gap;
  }
  return std::sqrt(square);
}

/// Each leaf lists the volumes that touch it, up to a nanometre, and each of them once.
void expect_exact_leaves(const TbvOctree& octree, const Balls& balls) {
  octree.for_each_leaf([&](const Bounds& box, int, std::vector<Slot> slots) {
    std::sort(slots.begin(), slots.end());
    REQUIRE(std::adjacent_find(slots.begin(), slots.end()) == slots.end());
    for (const auto& [slot, ball] : balls) {
      const double d = distance(ball, box) - ball.radius;
      const bool listed = std::binary_search(slots.begin(), slots.end(), slot);
      if (d <= 0.0) REQUIRE(listed);
      if (d > 1e-9) REQUIRE_FALSE(listed);
    }
  });
}

std::size_t leaves_of(const TbvOctree& octree) {
  std::size_t leaves = 0;
  octree.for_each_leaf([&](const Bounds&, int, const std::vector<Slot>&) { ++leaves; });
  return leaves;
}

}  // namespace

TEST_CASE("the octree finds every volume that touches, and no other") {
  const Lattice lattice = small_lattice();
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    TbvOctree octree(lattice, random_limits(seed));
    live_at_random(octree, lattice, seed, [](const TbvOctree& o, const Balls& balls) {
      REQUIRE(o.fault() == "");
      expect_exact_leaves(o, balls);
    });
    CHECK(leaves_of(octree) > 8);
  }
}

TEST_CASE("a move below the least common ancestor leaves what taking out and putting in leaves") {
  const Lattice lattice = small_lattice();
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    TbvOctree moved(lattice, {6, 3, 2}), anew(lattice, {6, 3, 2});
    constexpr Slot slots = 120;
    moved.reserve(slots);
    anew.reserve(slots);
    Balls balls;
    for (Slot slot = 0; slot < slots; ++slot) {
      balls[slot] = random_ball(random, lattice);
      moved.insert(slot, balls[slot]);
      anew.insert(slot, balls[slot]);
    }
    for (int step = 0; step < 300; ++step) {
      TbvBall& ball = balls[random.below(slots)];
      const Slot slot = std::find_if(balls.begin(), balls.end(), [&](auto& b) { return &b.second == &ball; })->first;
      ball = nearby_ball(random, lattice, ball);
      moved.renew(slot, ball);
      anew.erase(slot);
      anew.insert(slot, ball);
    }
    REQUIRE(moved.fault() == "");
    REQUIRE(anew.fault() == "");
    // Splitting and merging at different numbers, the trees may differ in what is split; in no leaf's list.
    expect_exact_leaves(moved, balls);
    expect_exact_leaves(anew, balls);
    for (int i = 0; i < 300; ++i) {
      const Question q = random_question(random, lattice);
      REQUIRE(touching_in(moved, q) == touching_in(anew, q));
    }
    CHECK(moved.places_written() < anew.places_written());
  }
}

TEST_CASE("the octree shrinks back to its root, and a move inside a leaf writes one place") {
  const Lattice lattice = small_lattice();
  TbvOctree octree(lattice, {4, 2, 1});
  octree.reserve(40);
  Random random(5);
  for (Slot slot = 0; slot < 40; ++slot) octree.insert(slot, random_ball(random, lattice));
  CHECK(leaves_of(octree) > 8);
  for (Slot slot = 0; slot < 39; ++slot) octree.erase(slot);
  CHECK(leaves_of(octree) == 1);
  CHECK(octree.fault() == "");
  const std::uint64_t before = octree.places_written();
  octree.renew(39, {{10.0, 15.0, 10.0}, 1.0});
  CHECK(octree.places_written() == before + 1);
}

TEST_CASE("an empty octree answers nobody") {
  const Lattice lattice = small_lattice();
  TbvOctree octree(lattice);
  CHECK(touching_in(octree, {0, ~std::uint64_t{0}}).empty());
  CHECK_FALSE(octree.holds(0));
}

}  // namespace gridcull::test
