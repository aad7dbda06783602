// Explanations: held against the reference and against hand-made scenes that say who hides whom.
#include <algorithm>
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/core/error.h"
#include "gridcull/core/exact.h"
#include "gridcull/service/explain.h"
#include "gridcull/sim/generate.h"
#include "gridcull/sim/world.h"

namespace gridcull::test {
namespace {

using Verdict = Explanation::Verdict;

Object object(ObjectId id, Shape shape, const Vec3& at) {
  Object out;
  out.id = id;
  out.shape = std::move(shape);
  out.pose.position = at;
  return out;
}

Explanation ask(const std::vector<Object>& world, const View& view, ObjectId id, int dimension) {
  const Lattice lattice(dimension, {{-50, -50, dimension == 3 ? -50.0 : 0.0}, {50, 50, dimension == 3 ? 50.0 : 0.0}},
                        2.0, std::uint64_t{1} << 30);
  return explain(world, lattice, view, id, 128);
}

/// Alone with those named, the object is hidden; in 2D with any one of them less it is not.
void check_cover(const std::vector<Object>& world, const View& view, ObjectId id, const std::vector<ObjectId>& by) {
  const auto seen_past = [&](ObjectId spared) {
    std::vector<Object> some;
    for (const Object& o : world) {
      const bool named = std::binary_search(by.begin(), by.end(), o.id) && o.id != spared;
      if (o.id == id || named) some.push_back(o);
    }
    const ExactAnswer seen = exact_visible_2d(some, view);
    return std::binary_search(seen.visible.begin(), seen.visible.end(), id);
  };
  CHECK(!seen_past(no_id));
  for (const ObjectId spared : by) CHECK(seen_past(spared));
}

}  // namespace

TEST_CASE("explain: hidden by two together, seen past one, outside, around the viewer, ridden") {
  std::vector<Object> world{object(1, Rectangle{{2, 6}}, {10, 2.9, 0}), object(2, Rectangle{{2, 6}}, {12, -2.9, 0}),
                            object(3, Disc{1.5}, {20, 0, 0}), object(4, Disc{1}, {0, 30, 0}),
                            object(5, Disc{4}, {0, 0, 0})};
  View view;
  view.viewer = 7;
  view.range = 25.0;
  const Explanation hidden = ask(world, view, 3, 2);
  CHECK(hidden.verdict == Verdict::hidden);
  CHECK(hidden.by == std::vector<ObjectId>{1, 2});
  CHECK(!hidden.sees);
  // A disc of radius 1.5 about (20, 0) and cells of 2 m from -50 on: 34 .. 35 along x, 24 .. 25 along y.
  CHECK(hidden.cells.size() == 4);
  CHECK(std::find(hidden.cells.begin(), hidden.cells.end(), Cell{35, 24, 0}) != hidden.cells.end());
  CHECK(ask(world, view, 4, 2).verdict == Verdict::outside);
  CHECK(ask(world, view, 5, 2).verdict == Verdict::contains_viewer);
  view.rides = 5;
  CHECK(ask(world, view, 5, 2).verdict == Verdict::outside);
  world[1].occluder = false;
  const Explanation seen = ask(world, view, 3, 2);
  CHECK(seen.verdict == Verdict::visible);
  CHECK(seen.by.empty());
  REQUIRE(seen.sees);
  CHECK(glm::length(*seen.sees - Vec3(20, 0, 0)) == doctest::Approx(1.5).epsilon(1e-6));
  CHECK(seen.sees->y < 0.0);
  CHECK_THROWS_WITH_AS(ask(world, view, 99, 2), doctest::Contains("99"), Error);
}

TEST_CASE("explain: thin walls hide, in 3D too") {
  if (!ExactRays::available()) {
    MESSAGE("skipped: built without Embree");
    return;
  }
  const Faces wall{{{10, -9, -9}, {10, 9, -9}, {10, 9, 9}, {10, -9, 9}}, {{0, 1, 2}, {0, 2, 3}}};
  std::vector<Object> world{object(1, wall, {0, 0, 0}), object(2, Sphere{2}, {20, 0, 0}),
                            object(3, Cuboid{{2, 2, 2}}, {-20, 0, 0})};
  View view;
  const Explanation hidden = ask(world, view, 2, 3);
  CHECK(hidden.verdict == Verdict::hidden);
  CHECK(hidden.by == std::vector<ObjectId>{1});
  const Explanation seen = ask(world, view, 3, 3);
  CHECK(seen.verdict == Verdict::visible);
  REQUIRE(seen.sees);
  CHECK(seen.sees->x == doctest::Approx(-19.0));
}

TEST_CASE("explain agrees with the reference on every object of a town, and names a cover that none can be spared of") {
  const auto town = make_generator("town", {.count = 60, .viewers = 2, .range = 90.0, .seed = 4, .frames = 3});
  World world(town->scene());
  Frame frame;
  for (int i = 0; i < 3; ++i) {
    REQUIRE(town->next(frame));
    world.apply(frame);
  }
  const std::vector<Object> objects(world.objects().begin(), world.objects().end());
  std::size_t hidden = 0, together = 0;
  for (const View& view : world.views()) {
    const ExactAnswer exact = exact_visible_2d(objects, view);
    for (const Object& o : objects) {
      CAPTURE(view.viewer);
      CAPTURE(o.id);
      const Explanation why = ask(objects, view, o.id, 2);
      const bool seen = std::binary_search(exact.visible.begin(), exact.visible.end(), o.id);
      CHECK(seen == (why.verdict == Verdict::visible || why.verdict == Verdict::contains_viewer));
      if (why.verdict != Verdict::hidden) continue;
      ++hidden;
      together += why.by.size() > 1;
      check_cover(objects, view, o.id, why.by);
    }
  }
  CHECK(hidden > 30);
  CHECK(together > 0);
}

}  // namespace gridcull::test
