// The static store's contract: every kind answers alike, whatever is written in whatever order.
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/core/error.h"
#include "gridcull/grid/static_store.h"
#include "gridcull/sim/random.h"

namespace gridcull::test {
namespace {

TEST_CASE("dense and OpenVDB keep the same") {
  if (!has_store(StoreKind::openvdb)) {
    MESSAGE("skipped: built without OpenVDB");
    return;
  }
  for (const int dimension : {2, 3}) {
    const Vec3 size = dimension == 2 ? Vec3(900, 500, 0) : Vec3(150, 90, 70);
    const Lattice lattice(dimension, {Vec3(0.0), size}, 1.0, std::uint64_t{1} << 30);
    const auto dense = make_static_store(StoreKind::dense, lattice),
               vdb = make_static_store(StoreKind::openvdb, lattice);
    const std::uint64_t empty = vdb->bytes();
    const auto bricks = static_cast<std::uint32_t>(lattice.brick_count());
    Random random(31);
    for (int step = 0; step < 20'000; ++step) {
      const std::size_t brick = random.below(bricks);
      const bool clears = random.below(3) == 0;
      const std::uint64_t word = clears ? 0 : std::uint64_t{random.below(0xFFFFFFFFu)} << random.below(33);
      const std::uint32_t head = clears ? StaticStore::nobody : random.below(0xFFFFFFFFu);
      for (const auto& store : {dense.get(), vdb.get()}) {
        if (step % 2 == 0) store->set_opaque(brick, word);
        if (step % 2 == 1) store->set_first(brick, head);
      }
    }
    const auto row = static_cast<std::size_t>(lattice.bricks().x);
    std::vector<std::uint64_t> a(row), b(row);
    for (std::size_t brick = 0; brick < bricks; ++brick) {
      REQUIRE(dense->opaque(brick) == vdb->opaque(brick));
      REQUIRE(dense->first(brick) == vdb->first(brick));
      if (brick % row != 0) continue;
      for (std::size_t i = 0; i < row; ++i) a[i] = b[i] = i;  // what was there stays
      dense->add_opaque_row(brick, a);
      vdb->add_opaque_row(brick, b);
      REQUIRE(a == b);
      for (std::size_t i = 0; i < row; ++i) REQUIRE(a[i] == (dense->opaque(brick + i) | i));
    }
    CHECK(vdb->bytes() > empty);
    for (std::size_t brick = 0; brick < bricks; ++brick) {
      vdb->set_opaque(brick, 0);
      vdb->set_first(brick, StaticStore::nobody);
    }
    CHECK(vdb->bytes() <= 700'000);  // leaves are given back, the two nodes above them stay
  }
}

TEST_CASE("a store that is not there is refused") {
  if (has_store(StoreKind::openvdb)) return;
  const Lattice lattice(2, {{0, 0, 0}, {8, 8, 0}}, 1.0, 1 << 20);
  CHECK_THROWS_AS((void)make_static_store(StoreKind::openvdb, lattice), Error);
}

}  // namespace
}  // namespace gridcull::test
