// T, solid volumes: who touches these cells, against a plain list.
#include <doctest/doctest.h>

#include "gridcull/grid/tbv_matrix.h"
#include "tbv_index_check.h"

namespace gridcull::test {

TEST_CASE("T finds every volume that touches, and no other") {
  const Lattice lattice = small_lattice();
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    TbvMatrix matrix(lattice);
    live_at_random(matrix, lattice, seed, [&](const TbvMatrix& m, const Balls& balls) {
      for (std::size_t brick = 0; brick < lattice.brick_count(); ++brick) {
        const Question all{brick, lattice.brick_cells(brick)};
        if (!m.may_touch(brick)) REQUIRE(touching_truth(lattice, balls, all).empty());
      }
    });
  }
}

TEST_CASE("T writes one place for a volume that is renewed inside its cell's box") {
  const Lattice lattice = small_lattice();
  TbvMatrix matrix(lattice);
  matrix.reserve(1);
  matrix.insert(0, {{10.9, 14.6, 9.8}, 0.4});  // amid a brick
  const std::uint64_t before = matrix.places_written();
  matrix.renew(0, {{11.0, 14.5, 9.9}, 0.4});
  CHECK(matrix.places_written() == before + 1);
}

}  // namespace gridcull::test
