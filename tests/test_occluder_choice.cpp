// What shadow frusta choose from: convex parts, regions and their promises, lists kept in order, box hierarchies.
#include <algorithm>
#include <cmath>
#include <random>

#include <doctest/doctest.h>

#include "gridcull/core/predicates.h"
#include "gridcull/methods/convex_partition.h"
#include "gridcull/methods/occluder_choice.h"
#include "gridcull/methods/occluder_regions.h"
#include "gridcull/methods/turn_sign.h"
#include "random_solids.h"

using namespace gridcull;
using namespace gridcull::test;

namespace {

double unit(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

double area_of(const std::vector<Vec2>& p) {
  double twice = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) twice += cross2(p[i], p[(i + 1) % p.size()]);
  return 0.5 * twice;
}

/// Even-odd, and not on the outline: in long doubles, away from edges.
bool inside(const std::vector<Vec2>& p, const Vec2& at) {
  bool in = false;
  for (std::size_t i = 0, j = p.size() - 1; i < p.size(); j = i++) {
    if ((p[i].y > at.y) == (p[j].y > at.y)) continue;
    const long double x = p[j].x + (static_cast<long double>(at.y) - p[j].y) *
                                       (p[i].x - static_cast<long double>(p[j].x)) /
                                       (static_cast<long double>(p[i].y) - p[j].y);
    if (at.x < x) in = !in;
  }
  return in;
}

Object standing(ObjectId id, Shape shape, const Vec3& at) {
  Object out;
  out.id = id;
  out.shape = std::move(shape);
  out.pose.position = at;
  out.is_static = true;
  return out;
}

}  // namespace

TEST_CASE("turn signs: those of the exact reference, near and on the line too") {
  std::mt19937_64 random(6);
  int zero = 0;
  for (int k = 0; k < 200000; ++k) {
    CAPTURE(k);
    const double size = k % 3 == 0 ? 1.0 : k % 3 == 1 ? 1e7 : 1e-9;
    const Vec2 a = size * Vec2(unit(random), unit(random)), b = size * Vec2(unit(random), unit(random));
    Vec2 c = a + 3.0 * unit(random) * (b - a);
    if (k % 4 == 1) c = a + 2.0 * (b - a);
    if (k % 4 == 2) c = {std::nextafter(c.x, 1e9), c.y};
    if (k % 4 == 3) c = size * Vec2(unit(random), unit(random));
    const int expected = orientation(a, b, c);
    REQUIRE(turn_sign(a, b, c) == expected);
    REQUIRE(turn_sign(b, a, c) == -expected);
    REQUIRE(turn_sign(b, c, a) == expected);
    zero += expected == 0 ? 1 : 0;
  }
  CHECK(zero > 100);
}

TEST_CASE("convex partition: parts are convex, inside, and together the outline") {
  std::mt19937_64 random(3);
  int concave = 0, refused = 0, whole = 0;
  for (int k = 0; k < 3000; ++k) {
    CAPTURE(k);
    std::vector<Vec2> outline = random_outline(random);
    const auto parts = convex_partition(outline);
    if (parts.empty()) {
      ++refused;
      continue;
    }
    ++(parts.size() > 1 ? concave : whole);
    double sum = 0.0;
    for (const auto& part : parts) {
      REQUIRE(part.size() >= 3);
      Vec2 middle(0.0);
      for (std::size_t i = 0; i < part.size(); ++i) {
        REQUIRE(orientation(part[i], part[(i + 1) % part.size()], part[(i + 2) % part.size()]) > 0);
        REQUIRE(std::find(outline.begin(), outline.end(), part[i]) != outline.end());
        middle += part[i] / static_cast<double>(part.size());
      }
      for (const Vec2& corner : part) REQUIRE(inside(outline, middle + 0.999 * (corner - middle)));
      sum += area_of(part);
    }
    CHECK(sum == doctest::Approx(std::fabs(area_of(outline))));
  }
  CHECK(concave > 300);
  CHECK(whole > 200);
  CHECK(refused > 300);
}

TEST_CASE("ranked lists: the order of a full sort, in few steps when little changes") {
  std::mt19937_64 random(4);
  RankedList list;
  std::vector<std::uint32_t> places(500, RankedList::no_place);
  std::vector<double> worth(500);
  for (double& w : worth) w = unit(random);
  for (int frame = 0; frame < 60; ++frame) {
    std::vector<RankedPart> candidates;
    for (std::uint32_t i = 0; i < 500; ++i) {
      worth[i] += 1e-4 * (unit(random) - 0.5);
      if ((i + static_cast<std::uint32_t>(frame)) % 97 != 0) candidates.push_back({i, i, std::round(300.0 * worth[i])});
    }
    list.update(candidates, places);
    std::sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) { return a.before(b); });
    REQUIRE(list.parts().size() == candidates.size());
    for (std::size_t i = 0; i < candidates.size(); ++i) REQUIRE(list.parts()[i].key == candidates[i].key);
    CHECK(std::all_of(places.begin(), places.end(), [](std::uint32_t p) { return p == RankedList::no_place; }));
    if (frame > 0) CHECK(list.moves() < 5 * candidates.size());
  }
}

TEST_CASE("box trees: every item below exactly one leaf, in boxes that hold it, before and after a refit") {
  std::mt19937_64 random(5);
  std::vector<Bounds> boxes(777);
  std::vector<BoxTree::Item> items;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    const Vec3 p = glm::floor(8.0 * Vec3(unit(random), unit(random), unit(random)));
    boxes[i] = {p, p + unit(random)};
    items.push_back({boxes[i], i, i});
  }
  BoxTree tree;
  tree.build(items);
  const auto holds = [](const Bounds& a, const Bounds& b) {
    return glm::all(glm::lessThanEqual(a.min, b.min)) && glm::all(glm::greaterThanEqual(a.max, b.max));
  };
  const auto check = [&] {
    std::vector<int> seen(boxes.size(), 0);
    std::vector<std::uint32_t> todo{0};
    while (!todo.empty()) {
      const BoxTree::Node& node = tree.node(todo.back());
      const std::uint32_t at = todo.back();
      todo.pop_back();
      for (const std::uint32_t name : tree.names(node)) REQUIRE(holds(node.box, boxes[name]));
      if (node.right == 0) {
        REQUIRE(node.count <= BoxTree::most_in_leaf);
        for (const std::uint32_t name : tree.names(node)) ++seen[name];
      } else {
        todo.insert(todo.end(), {at + 1, node.right});
      }
    }
    CHECK(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }));
  };
  check();
  for (Bounds& box : boxes) box.min += 0.5, box.max += 0.5;
  CHECK_FALSE(tree.refit([&](std::uint32_t i) { return boxes[i]; }));
  check();
  for (Bounds& box : boxes) box.max += 100.0 * Vec3(unit(random), unit(random), unit(random));
  CHECK(tree.refit([&](std::uint32_t i) { return boxes[i]; }));
  check();
}

TEST_CASE("regions: what covers much is listed, and what hides much promises much") {
  ShadowWorld world(3);
  // A wall with a crowd behind it, one with nothing behind, a pebble.
  world.add(standing(0, Cuboid{{1, 30, 20}}, {40, 0, 10}));
  world.add(standing(1, Cuboid{{1, 30, 20}}, {0, 0, 10}));
  world.add(standing(2, Sphere{0.01}, {20, 0, 3}));
  for (ObjectId i = 0; i < 100; ++i) world.add(standing(10 + i, Sphere{0.2}, {60.0 + i % 10, 0.1 * i, 1}));
  FrameStats stats;
  world.begin_frame(0.0, {}, stats);
  OccluderRegions regions;
  regions.begin_frame(world);
  const auto* list = regions.at(world, {20, 0, 2});
  REQUIRE(list != nullptr);
  REQUIRE(list->size() >= 2);
  CHECK((*list)[0].entry == 0);
  CHECK((*list)[0].hidden > 0.9);
  CHECK((*list)[1].entry == 1);
  CHECK((*list)[1].hidden == 0.0);
  CHECK(std::none_of(list->begin(), list->end(), [](const auto& p) { return p.entry == 2; }));
  CHECK(regions.region_count() == 1);
  CHECK(regions.at(world, {20.01, 0, 2}) == list);
  CHECK(regions.region_count() == 1);
  CHECK(regions.at(world, {-500, 0, 2}) == nullptr);
  // Another static world, other regions.
  world.move(0, {{40, 0, -100}, {}});
  world.begin_frame(1.0, {}, stats);
  regions.begin_frame(world);
  CHECK(regions.region_count() == 0);
  list = regions.at(world, {20, 0, 2});
  REQUIRE(list != nullptr);
  for (const auto& p : *list) CHECK(p.hidden < 0.5);
}

TEST_CASE("area-angle: about the solid angle") {
  const auto angle = [](const Shape& shape, const Vec3& sight) {
    return area_angle(make_occluder_parts(shape)[0], sight);
  };
  CHECK(angle(Sphere{1.0}, {10, 0, 0}) == doctest::Approx(0.0314159).epsilon(1e-3));
  CHECK(angle(Cuboid{{1, 2, 3}}, {0, 0, -10}) == doctest::Approx(0.02));
  CHECK(angle(Cuboid{{1, 2, 3}}, {10, 0, 0}) == doctest::Approx(0.06));
  const Faces face{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {{0, 1, 2}}};
  CHECK(angle(face, {0, 0, 10}) == doctest::Approx(0.02));
  CHECK(angle(face, {0, 0, -10}) == doctest::Approx(0.02));
  CHECK(angle(face, {10, 0, 0}) == doctest::Approx(0.0));
  CHECK(angle(Disc{1.0}, {0, 20, 0}) == doctest::Approx(0.1));
  CHECK(angle(Rectangle{{4, 2}}, {0, 20, 0}) == doctest::Approx(0.2));
  CHECK(angle(Polyline{{{0, 0}, {4, 0}}}, {20, 0, 0}) == doctest::Approx(0.0));
}
