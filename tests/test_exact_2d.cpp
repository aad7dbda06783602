#include <algorithm>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "gridcull/core/error.h"
#include "gridcull/core/exact.h"
#include "hand_made_scenes.h"
#include "naive_rays_2d.h"

using namespace gridcull;
using namespace gridcull::test;

namespace {

bool has(const std::vector<ObjectId>& ids, ObjectId id) { return std::binary_search(ids.begin(), ids.end(), id); }

}  // namespace

TEST_CASE("exact 2d: hand-made scenes") {
  for (const HandMadeScene& scene : hand_made_scenes()) {
    if (scene.dimension != 2) continue;
    CAPTURE(scene.name);
    const ExactAnswer answer = exact_visible_2d(scene.objects, scene.view);
    CHECK_FALSE(answer.lower_bound);
    CHECK(answer.witness.size() == answer.visible.size());
    CHECK(std::is_sorted(answer.visible.begin(), answer.visible.end()));
    for (const ObjectId id : scene.sees) CHECK_MESSAGE(has(answer.visible, id), "should see " << id);
    for (const ObjectId id : scene.hides) CHECK_MESSAGE(!has(answer.visible, id), "should not see " << id);
  }
}

TEST_CASE("exact 2d: agrees with a naive ray caster on random worlds") {
  const std::uint64_t first_seed = 1000;
  for (std::uint64_t seed = first_seed; seed < first_seed + 400; ++seed) {
    CAPTURE(seed);
    const std::vector<Object> world = random_world_2d(seed, 12);
    const View view = random_view_2d(seed, world);
    const ExactAnswer answer = exact_visible_2d(world, view);
    // Everything that is claimed is seen where it is claimed.
    for (std::size_t i = 0; i < answer.visible.size(); ++i) {
      const Vec2 along(answer.witness[i]);
      const Vec2 direction = along == Vec2(0) ? Vec2(1, 0) : along;
      CAPTURE(answer.visible[i]);
      CHECK(has(seen_along(world, view, direction, true), answer.visible[i]));
    }
    // Everything that some direction sees is claimed. Odd angles, away from lattice lines.
    for (int k = 0; k < 720; ++k) {
      const double angle = (k + 0.3819660113) * std::numbers::pi / 360;
      for (const ObjectId id : seen_along(world, view, {std::cos(angle), std::sin(angle)}, false)) {
        if (has(answer.visible, id)) continue;
        CAPTURE(angle);
        CAPTURE(id);
        CHECK(has(answer.visible, id));
      }
    }
  }
}

TEST_CASE("exact 2d: moving, turning and mirroring the world changes nothing") {
  for (std::uint64_t seed = 1; seed < 60; ++seed) {
    CAPTURE(seed);
    std::vector<Object> world = random_world_2d(seed, 10);
    View view = random_view_2d(seed + 7, world);
    // Away from degenerate places, which rounding may decide either way.
    view.pose.position += Vec3(0.1234567, 0.0765432, 0);
    const std::vector<ObjectId> before = exact_visible_2d(world, view).visible;
    const Pose turn{{1000, -500, 0}, turn_about_z(1.0)};
    for (Object& o : world) o.pose = compose(turn, o.pose);
    view.pose = compose(turn, view.pose);
    CHECK(exact_visible_2d(world, view).visible == before);
    std::reverse(world.begin(), world.end());
    CHECK(exact_visible_2d(world, view).visible == before);
  }
}

TEST_CASE("exact 2d: the side of a thin wall is decided exactly, however near") {
  const std::vector<Object> world{{.id = 0, .shape = Polyline{{{0, -10}, {0, 10}}}},
                                  {.id = 1, .shape = Disc{1}, .pose = {{5, 0, 0}, {}}},
                                  {.id = 2, .shape = Disc{1}, .pose = {{-5, 0, 0}, {}}}};
  const auto seen_from = [&](double x) {
    View view;
    view.pose.position.x = x;
    return exact_visible_2d(world, view).visible;
  };
  CHECK(seen_from(1e-6) == std::vector<ObjectId>{0, 1});
  CHECK(seen_from(-1e-6) == std::vector<ObjectId>{0, 2});
  CHECK(seen_from(1e-15) == std::vector<ObjectId>{0, 1});
  CHECK(seen_from(-1e-15) == std::vector<ObjectId>{0, 2});
  CHECK(has(seen_from(0.0), 1));
  CHECK(has(seen_from(0.0), 2));
}

TEST_CASE("exact 2d: discs too small and far to have a width in doubles are left out") {
  for (const double radius : {1e-13, 1e-15, 1e-16, 1e-300}) {
    CAPTURE(radius);
    for (const Vec3& position : {Vec3(30, 7, 0), Vec3(9e8, 9e8, 0), Vec3(-20, 1e-9, 0)}) {
      const std::vector<Object> world{{.id = 0, .shape = Disc{radius}, .pose = {position, {}}}};
      CHECK(exact_visible_2d(world, View{}).visible.empty());
    }
  }
}

TEST_CASE("exact 2d: 3D shapes and impossible views are refused") {
  const std::vector<Object> world{Object{.id = 1, .shape = Sphere{1.0}}};
  CHECK_THROWS_AS(exact_visible_2d(world, View{}), Error);
  View view;
  view.range = 0;
  CHECK_THROWS_AS(exact_visible_2d({}, view), Error);
  view.range = 1;
  view.fov = 7;
  CHECK_THROWS_AS(exact_visible_2d({}, view), Error);
  view.fov = 1;
  CHECK(exact_visible_2d({}, view).visible.empty());
}

TEST_CASE("exact 2d: ten thousand discs") {
  // A ring of discs that just fails to close, and discs behind it.
  std::vector<Object> world;
  const int count = 5000;
  const double radius = 1000, step = 2 * std::numbers::pi / count;
  for (int i = 0; i < count; ++i) {
    const Vec3 direction(std::cos(i * step), std::sin(i * step), 0);
    // Neighbours overlap by a hair; number 100 is missing.
    if (i != 100)
      world.push_back({.id = static_cast<ObjectId>(i), .shape = Disc{0.6295}, .pose = {radius * direction, {}}});
    world.push_back({.id = static_cast<ObjectId>(count + i), .shape = Disc{0.5}, .pose = {1010.0 * direction, {}}});
  }
  const std::vector<ObjectId> visible = exact_visible_2d(world, View{}).visible;
  REQUIRE(visible.size() == count);
  CHECK(visible.back() == count + 100);
}
