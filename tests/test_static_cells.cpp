// Static cells worked out in advance: what a volume file stores is all there is, and the engine answers as if it had
// discretised itself.
#include <algorithm>
#include <map>
#include <string>

#include <doctest/doctest.h>

#include "engine_probe.h"
#include "gridcull/core/error.h"
#include "gridcull/grid/cover.h"
#include "gridcull/grid/engine.h"
#include "gridcull/grid/identifier_matrix.h"
#include "gridcull/grid/shared_cells.h"
#include "gridcull/grid/static_cells.h"
#include "random_world.h"
#include "same_cells.h"

namespace gridcull::test {
namespace {

constexpr std::uint64_t plenty = std::uint64_t{1} << 30;

bool go_on(double) { return true; }

StaticCells cells_of(const WorldScript& script) {
  const Lattice lattice(script.dimension, script.bounds, script.cell, plenty);
  return *discretise_static(lattice, script.objects, plenty, go_on);
}

TEST_CASE("what is stored by place comes back by object, whole") {
  std::uint64_t shared_lists = 0;
  for (const int dimension : {2, 3}) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
      const WorldScript script = random_world(dimension, 7'000 + seed);
      const StaticCells cells = cells_of(script);
      const SharedCells shared = share_cells(cells, plenty);
      StaticCells back = cells;
      back.members = parse_members(members_text(cells));
      SharedCells read{parse_lists(lists_text(shared, cells), back), shared.parts};
      std::reverse(read.parts.begin(), read.parts.end());  // a file has an order of its own
      unshare_cells(read, plenty, back);
      CAPTURE(dimension);
      CAPTURE(seed);
      REQUIRE(same(cells, back));
      for (const auto& list : shared.lists) shared_lists += list.size() > 1;
    }
  }
  CHECK(shared_lists > 100);
}

TEST_CASE("texts that are none are refused") {
  StaticCells cells;
  cells.members = parse_members("3 ff\n5 0*\n");
  CHECK(cells.members[1].outside);
  CHECK(parse_lists("3* 5\n", cells)[0][0].fills);
  for (const char* text : {"5", "5 0", "x 0\n", "5 0*", "5 0\n3 0\n", "5 0\n5 0\n", "4294967296 0\n", "\n"}) {
    CAPTURE(text);
    CHECK_THROWS_AS((void)parse_members(text), Error);
  }
  for (const char* text : {"3", "4\n", "3 3\n", "5 3\n", "3**\n", "3  5\n", "\n"}) {
    CAPTURE(text);
    CHECK_THROWS_AS((void)parse_lists(text, cells), Error);
  }
  SharedCells shared{{{{0, true}}}, {{0, 1, 1}}};
  CHECK_THROWS_AS(unshare_cells(shared, plenty, cells), Error);  // there is no list 1
  shared.parts[0].list = 0;
  CHECK_THROWS_AS(unshare_cells(shared, 23, cells), Error);  // no room for a brick
}

TEST_CASE("only the very object is known") {
  const Object house = make_static(4, Rectangle{{10, 6}}, {20, 20, 0});
  const Lattice lattice(2, {{0, 0, 0}, {64, 64, 0}}, 1.0, plenty);
  const StaticCells cells = *discretise_static(lattice, std::vector{house}, plenty, go_on);
  CHECK(cells.find(house) != nullptr);
  Object other = house;
  other.pose.position.x += 1e-9;
  CHECK(cells.find(other) == nullptr);
  other = house;
  other.occluder = false;
  CHECK(cells.find(other) == nullptr);
  other = house;
  other.id = 5;
  CHECK(cells.find(other) == nullptr);
  CHECK(cells.fit(lattice));
  CHECK(!cells.fit(Lattice(2, {{0, 0, 0}, {64, 65, 0}}, 1.0, plenty)));
  CHECK(!cells.fit(Lattice(2, {{0.5, 0, 0}, {64, 64, 0}}, 1.0, plenty)));
  CHECK(lattice_of(cells, plenty, Room::whole).cells() == lattice.cells());
  CHECK_THROWS_AS((void)discretise_static(lattice, std::vector{house}, 24, go_on), Error);
  CHECK(!discretise_static(lattice, std::vector{house}, plenty, [](double) { return false; }));
  GridOptions options;
  options.bounds = {{0, 0, 0}, {65, 65, 0}};
  options.static_cells = std::make_shared<const StaticCells>(cells);
  CHECK_THROWS_AS(GridEngine{options}, Error);
}

// Stored cells that are wrong on purpose show who uses them: the object that they are of, until it moves.
TEST_CASE("stored cells are taken for the object they are of, and no longer than it stays") {
  const std::vector<Object> objects{make_static(1, Rectangle{{4, 30}}, {20, 32, 0}),
                                    make_static(2, Disc{0.5}, {40, 32, 0})};
  GridOptions options;
  options.hiding = Hiding::voxel;
  options.bounds = {{0, 0, 0}, {64, 64, 0}};
  const Lattice lattice(2, options.bounds, 1.0, plenty);
  StaticCells cells = *discretise_static(lattice, objects, plenty, go_on);
  for (BrickCover& brick : cells.bricks) brick.opaque = 0;
  const auto seen = [&](GridEngine& engine, double time) {
    Answers answers;
    engine.query(time, std::vector{make_view(7, {5.5, 32.5, 0})}, answers);
    return sees(answers.views[0], 2);
  };
  GridEngine plain(options);
  for (const Object& object : objects) plain.add(object);
  CHECK(!seen(plain, 0));
  options.static_cells = std::make_shared<const StaticCells>(cells);
  GridEngine given(options);
  for (const Object& object : objects) given.add(object);
  CHECK(seen(given, 0));
  given.move(1, {{20.25, 32, 0}});
  CHECK(!seen(given, 1));
  given.remove(1);
  CHECK(seen(given, 2));
  given.add(objects[0]);
  CHECK(!seen(given, 3));
}

// Issue: edits cost in proportion to the object.
TEST_CASE("an edit writes the bricks of its object and no others") {
  const Lattice lattice(3, {{0, 0, 0}, {400, 400, 40}}, 1.0, plenty);
  for (const StoreKind kind : {StoreKind::dense, StoreKind::openvdb}) {
    if (!has_store(kind)) continue;
    IdentifierMatrix matrix(lattice, make_static_store(kind, lattice));
    CoverScratch scratch;
    Cover cover;
    std::vector<std::uint32_t> chains(101, none);
    const auto enter = [&](Slot slot, const Vec3& at) {
      PreparedShape(Cuboid{{10, 8, 20}}).cover(lattice, {at}, scratch, cover);
      matrix.update(slot, cover, true, true, chains[slot]);
    };
    for (Slot slot = 0; slot < 100; ++slot) enter(slot, {20.0 + 38 * (slot % 10), 20.0 + 38 * (slot / 10), 10});
    const std::uint64_t before = matrix.static_bricks_written(), bytes = matrix.matrix_bytes();
    enter(100, {39, 39, 10});
    const std::uint64_t added = matrix.static_bricks_written() - before;
    CHECK(added == cover.bricks.size());
    CHECK(added <= 4 * 3 * 7);  // 10 x 8 x 20 m in bricks of 4 m
    enter(100, {40, 39, 10});   // a step: its bricks, and those it left
    CHECK(matrix.static_bricks_written() - before - added <= 2 * added);
    const std::uint64_t moved = matrix.static_bricks_written();
    matrix.remove(true, chains[100]);
    CHECK(matrix.static_bricks_written() - moved <= added + 4 * 7);
    CHECK(matrix.matrix_bytes() <= bytes + 65536);
    std::uint64_t left = 0;
    for (std::size_t brick = 0; brick < lattice.brick_count(); ++brick) {
      matrix.each_in_brick(brick, [&](const IdentifierMatrix::Entry& entry) { left += entry.slot == 100; });
    }
    CHECK(left == 0);
  }
}

}  // namespace
}  // namespace gridcull::test
