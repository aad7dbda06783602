// The bounding volume tree of temporal bounding volumes against a plain list, and its shape.
#include <doctest/doctest.h>

#include "gridcull/grid/tbv_volume_tree.h"
#include "tbv_index_check.h"

namespace gridcull::test {

TEST_CASE("the volume tree finds every volume that touches, and no other") {
  const Lattice lattice = small_lattice();
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    TbvVolumeTree tree(lattice);
    live_at_random(tree, lattice, seed, [](const TbvVolumeTree& t, const Balls&) { REQUIRE(t.fault() == ""); });
  }
}

TEST_CASE("the volume tree comes down to nothing and up again") {
  const Lattice lattice = small_lattice();
  TbvVolumeTree tree(lattice);
  tree.reserve(50);
  Random random(3);
  for (int round = 0; round < 3; ++round) {
    for (Slot slot = 0; slot < 50; ++slot) tree.insert(slot, random_ball(random, lattice));
    CHECK(tree.fault() == "");
    for (Slot slot = 0; slot < 50; ++slot) tree.erase((slot * 7) % 50);
    CHECK(tree.size() == 0);
    CHECK(tree.cost() == 0.0);
    CHECK(touching_in(tree, {0, ~std::uint64_t{0}}).empty());
  }
}

TEST_CASE("a volume that is renewed as it was refits nothing above its leaf") {
  const Lattice lattice = small_lattice();
  TbvVolumeTree tree(lattice);
  tree.reserve(2);
  const TbvBall a{{5.0, 10.0, 5.0}, 1.0}, b{{20.0, 20.0, 15.0}, 2.0};
  tree.insert(0, a);
  tree.insert(1, b);
  const std::uint64_t before = tree.places_written();
  tree.renew(0, a);
  CHECK(tree.places_written() == before + 1);
  tree.renew(0, {{5.0, 10.0, 5.0}, 0.5});
  CHECK(tree.places_written() == before + 3);  // its leaf and the root
}

// Refitting alone lets a tree of movers rot: neighbours part and their common box grows. Areas, not times, are
// compared.
TEST_CASE("rotations keep a tree of movers from rotting") {
  const Lattice lattice = small_lattice();
  const Bounds box = lattice.box();
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    constexpr Slot slots = 600;
    TbvVolumeTree tree(lattice), anew(lattice);
    tree.reserve(slots);
    anew.reserve(slots);
    std::vector<TbvBall> balls;
    std::vector<Vec3> steps;
    for (Slot slot = 0; slot < slots; ++slot) {
      TbvBall ball{Vec3(0.0), 0.5};
      Vec3 step(0.0);
      for (int k = 0; k < 3; ++k) ball.centre[k] = random.uniform(box.min[k] + 1.0, box.max[k] - 1.0);
      for (int k = 0; k < 3; ++k) step[k] = random.uniform(-0.3, 0.3);
      balls.push_back(ball);
      steps.push_back(step);
      tree.insert(slot, ball);
    }
    for (int frame = 0; frame < 150; ++frame) {
      for (Slot slot = 0; slot < slots; ++slot) {
        Vec3& centre = balls[slot].centre;
        for (int k = 0; k < 3; ++k) {
          if (centre[k] + steps[slot][k] < box.min[k] + 1.0 || centre[k] + steps[slot][k] > box.max[k] - 1.0) {
            steps[slot][k] = -steps[slot][k];
          }
        }
        centre += steps[slot];
        tree.renew(slot, balls[slot]);
      }
    }
    for (Slot slot = 0; slot < slots; ++slot) anew.insert(slot, balls[slot]);
    REQUIRE(tree.fault() == "");
    CHECK(tree.cost() < 1.25 * anew.cost());
  }
}

}  // namespace gridcull::test
