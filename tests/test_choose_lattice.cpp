// The grid that is chosen where a scene names none.
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/grid/choose_lattice.h"
#include "gridcull/grid/lattice.h"

using namespace gridcull;

namespace {

std::vector<Object> houses(int n, double pitch) {
  std::vector<Object> objects;
  for (int i = 0; i < n * n; ++i) {
    objects.push_back({.id = static_cast<ObjectId>(i),
                       .shape = Rectangle{{10.0, 8.0}},
                       .pose = {{pitch * (i % n), pitch * (i / n), 0.0}}});
  }
  return objects;
}

}  // namespace

TEST_CASE("what is asked for is what is used") {
  const Bounds bounds{{-3.0, 1.0, 0.0}, {50.5, 20.0, 0.0}};
  const LatticeChoice choice = choose_lattice(2, houses(3, 20.0), bounds, 0.7);
  CHECK(choice.cell == 0.7);
  CHECK(choice.bounds.min == bounds.min);
  CHECK(choice.bounds.max == bounds.max);
  CHECK(choice.cell_reason == "as asked");
  CHECK(choice.bounds_reason == "as asked");
}

TEST_CASE("the cell is a quarter of the typical occluder's smaller side") {
  const auto objects = houses(5, 20.0);
  const LatticeChoice choice = choose_lattice(2, objects, std::nullopt, std::nullopt);
  CHECK(choice.cell == 2.0);
  // The house at the origin reaches to -5, -4; then a 1024th of a cell less than one cell more.
  CHECK(choice.bounds.min == Vec3(-8.0 + 2.0 / 1024.0, -6.0 + 2.0 / 1024.0, 0.0));
  CHECK(choice.bounds.max == Vec3(86.0, 84.0, 0.0));
  CHECK(choice.cell_reason.find("8 m") != std::string::npos);
}

TEST_CASE("ways that are known widen the bounds") {
  const Bounds ways{{-1.5, 0.0, 0.0}, {200.0, 40.0, 0.0}};
  const LatticeChoice choice = choose_lattice(2, houses(2, 20.0), std::nullopt, std::nullopt, ways);
  CHECK(choice.bounds.min == Vec3(-8.0 + 2.0 / 1024.0, -6.0 + 2.0 / 1024.0, 0.0));
  CHECK(choice.bounds.max == Vec3(200.0, 40.0, 0.0));
}

TEST_CASE("what does not occlude and what is thin does not count") {
  auto objects = houses(2, 20.0);
  for (ObjectId i = 100; i < 120; ++i) {
    objects.push_back({.id = i, .shape = Disc{0.1}, .pose = {{5.0, 5.0, 0.0}}, .occluder = false});
    objects.push_back({.id = 100 + i, .shape = Polyline{{{0.0, 0.0}, {1.0, 0.0}}}, .pose = {{5.0, 5.0, 0.0}}});
  }
  CHECK(choose_lattice(2, objects, std::nullopt, std::nullopt).cell == 2.0);
}

TEST_CASE("a large world of small things keeps to a moderate number of cells") {
  const std::vector<Object> objects{
      {.id = 0, .shape = Disc{0.25}},
      {.id = 1, .shape = Disc{0.25}, .pose = {{1e6, 2e6, 0.0}}},
      {.id = 2, .shape = Disc{0.25}, .pose = {{-1e9, 0.0, 0.0}}},
  };
  const LatticeChoice choice = choose_lattice(2, objects, std::nullopt, std::nullopt);
  const Lattice lattice(2, choice.bounds, choice.cell, std::uint64_t{4} << 30);
  CHECK(lattice.cell_count() <= 4'100'000);
  CHECK(choice.cell_reason.find("enlarged") != std::string::npos);
}

TEST_CASE("three dimensions count the height") {
  std::vector<Object> objects;
  for (ObjectId i = 0; i < 9; ++i) {
    objects.push_back({.id = i,
                       .shape = Prism{{{0.0, 0.0}, {12.0, 0.0}, {12.0, 12.0}, {0.0, 12.0}}, 6.0},
                       .pose = {{20.0 * i, 0.0, 0.0}}});
  }
  const LatticeChoice choice = choose_lattice(3, objects, std::nullopt, std::nullopt);
  CHECK(choice.cell == 1.5);
  CHECK(choice.bounds.min == Vec3(-1.5 + 1.5 / 1024.0));  // the ground lies inside a layer of cells, not on one
  CHECK(choice.bounds.max == Vec3(172.5, 12.0, 6.0));
}

TEST_CASE("worlds without size still get a lattice") {
  for (const int dimension : {2, 3}) {
    const LatticeChoice empty = choose_lattice(dimension, {}, std::nullopt, std::nullopt);
    CHECK(Lattice(dimension, empty.bounds, empty.cell, 1 << 20).cell_count() == 1);
    CHECK(empty.bounds_reason.find("nothing") != std::string::npos);
  }
  const std::vector<Object> walls{{.id = 0, .shape = Polyline{{{0.0, 0.0}, {64.0, 0.0}}}}};
  const LatticeChoice choice = choose_lattice(2, walls, std::nullopt, std::nullopt);
  CHECK(choice.cell == 1.0);
  CHECK(Lattice(2, choice.bounds, choice.cell, 1 << 20).cell_count() == 65);
}

TEST_CASE("the box is tight for outlines and vertices") {
  Bounds box;
  add_extent({.id = 0, .shape = Rectangle{{4.0, 2.0}}, .pose = {{10.0, 10.0, 0.0}}}, box);
  CHECK(box.min == Vec3(8.0, 9.0, 0.0));
  CHECK(box.max == Vec3(12.0, 11.0, 0.0));
  add_extent({.id = 1, .shape = Disc{3.0}, .pose = {{0.0, 0.0, 0.0}}}, box);
  CHECK(box.min == Vec3(-3.0, -3.0, 0.0));
  Bounds solid;
  add_extent({.id = 2, .shape = Cuboid{{2.0, 4.0, 6.0}}}, solid);
  CHECK(solid.min == Vec3(-1.0, -2.0, -3.0));
}
