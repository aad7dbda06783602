// Occluders that no cell catches.
#include <array>
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/service/cell_less.h"

using namespace gridcull;

namespace {

Object box(ObjectId id, const Vec2& size, const Vec2& at) {
  return {.id = id, .shape = Rectangle{size}, .pose = {{at.x, at.y, 0.0}}};
}

Lattice cells_of(double cell) { return {2, {{0.0, 0.0, 0.0}, {40.0, 40.0, 0.0}}, cell, std::uint64_t{1} << 30}; }

}  // namespace

TEST_CASE("walls thinner than a cell, walls between cells, and what has no interior") {
  std::vector<Object> objects{
      box(9, {6.0, 0.4}, {10.0, 20.25}),   // 20.05 .. 20.45: within a row of cells of 1 m
      box(3, {6.0, 1.5}, {10.0, 10.0}),    // 9.25 .. 10.75: half a row on either side, whole rows of 0.5 m
      box(4, {8.0, 8.0}, {30.25, 30.25}),  //
      box(5, {8.0, 8.0}, {100.0, 100.0}),  // outside
      {.id = 6, .shape = Polyline{{{0.0, 0.0}, {9.0, 0.0}}}, .pose = {{5.0, 5.0, 0.0}}},
      {.id = 2, .shape = Polyline{{{0.0, 0.0}, {0.0, 9.0}}}, .pose = {{5.0, 5.0, 0.0}}},
  };
  objects.push_back(box(7, {0.1, 0.1}, {3.0, 3.0}));
  objects.back().occluder = false;
  const std::array lattices{cells_of(8.0), cells_of(1.0), cells_of(0.5)};
  const CellLess found = find_cell_less(lattices, objects);
  CHECK(found.occluders == 4);
  CHECK(found.thin == std::vector<ObjectId>{2, 6});
  REQUIRE(found.without.size() == 3);
  CHECK(found.without[0] == std::vector<ObjectId>{3, 4, 5, 9});
  CHECK(found.without[1] == std::vector<ObjectId>{3, 5, 9});
  CHECK(found.without[2] == std::vector<ObjectId>{5, 9});
}

TEST_CASE("cells of solids in 3D, and no occluder at all") {
  const std::array lattices{Lattice(3, {{0.0, 0.0, 0.0}, {8.0, 8.0, 8.0}}, 1.0, std::uint64_t{1} << 30)};
  CHECK(find_cell_less(lattices, {}).without == std::vector<std::vector<ObjectId>>{{}});
  const std::vector<Object> objects{
      {.id = 1, .shape = Sphere{0.8}, .pose = {{4.5, 4.5, 4.5}}},  // a cell's corners are 0.87 m from its centre
      {.id = 2, .shape = Sphere{0.9}, .pose = {{4.5, 4.5, 4.5}}},
      {.id = 3, .shape = Cuboid{{4.0, 0.5, 4.0}}, .pose = {{4.0, 4.0, 4.0}}},
  };
  CHECK(find_cell_less(lattices, objects).without[0] == std::vector<ObjectId>{1, 3});
}

TEST_CASE("ids with their names, the first few of them") {
  Scene scene;
  scene.objects.push_back({.object = {.id = 4, .shape = Disc{1.0}}, .name = "wall"});
  const std::vector<ObjectId> ids{2, 4, 6};
  CHECK(ids_text(ids, scene, 3) == "2, 4 (wall), 6");
  CHECK(ids_text(ids, scene, 2) == "2, 4 (wall), ...");
  CHECK(ids_text({}, scene, 2) == "");
}
