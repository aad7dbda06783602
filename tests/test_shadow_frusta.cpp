// The method `shadow-frusta` as a whole, on worlds small enough to know the answer. That it misses nobody is tested
// with all methods (test_catalog, test_property_2d and _3d).
#include <algorithm>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/core/error.h"
#include "gridcull/methods/shadow_frusta.h"

using namespace gridcull;

namespace {

Object standing(ObjectId id, Shape shape, const Vec3& at) {
  Object out;
  out.id = id;
  out.shape = std::move(shape);
  out.pose.position = at;
  out.is_static = true;
  return out;
}

View look(const Vec3& from) {
  View view;
  view.viewer = 1;
  view.pose.position = from;
  return view;
}

Answer ask(const ShadowFrustaOptions& options, const std::vector<Object>& world, const View& view, int frames = 1) {
  const auto culler = make_shadow_frusta(options);
  for (const Object& object : world) culler->add(object);
  Answers answers;
  for (int i = 0; i < frames; ++i) culler->query(i, std::span(&view, 1), answers);
  return answers.views.at(0);
}

using Ids = std::vector<ObjectId>;

}  // namespace

TEST_CASE("shadow-frusta: a number of occluders out of range is refused") {
  for (const int bad : {-1, 0, 65, 1000000}) {
    CAPTURE(bad);
    CHECK_THROWS_AS(make_shadow_frusta({.occluders = bad}), Error);
  }
  for (const int good : {1, 64}) CHECK(make_shadow_frusta({.occluders = good})->info().name == "shadow-frusta");
}

TEST_CASE("shadow-frusta: as tight far from the origin as near it") {
  for (const double far : {0.0, 1e3, 1e5, 1e7}) {
    CAPTURE(far);
    const Vec3 at(far, -far, 0.5 * far);
    std::vector<Object> world{standing(0, Cuboid{{1, 10, 10}}, at + Vec3(10, 0, 0))};
    // A metre behind the wall, one within 1 cm of its shadow's border, one 1 cm past it.
    world.push_back(standing(1, Sphere{0.4}, at + Vec3(11.0, 0, 0)));
    const double edge = 20.0 * 5.0 / 9.5;
    world.push_back(standing(2, Cuboid{{0.02, 0.02, 0.02}}, at + Vec3(20.0, edge - 0.035, 0)));
    world.push_back(standing(3, Cuboid{{0.02, 0.02, 0.02}}, at + Vec3(20.0, edge + 0.035, 0)));
    CHECK(ask({}, world, look(at)).visible == Ids{0, 3});
  }
}

TEST_CASE("shadow-frusta: two occluders together hide what neither hides alone") {
  // Two houses one behind the other, seen to overlap; a car behind both.
  const std::vector<Object> world{standing(0, Cuboid{{4, 4, 8}}, {10, -1.8, 0}),
                                  standing(1, Cuboid{{4, 6, 8}}, {16, 3.0, 0}),
                                  standing(2, Cuboid{{4, 2, 1}}, {30, 0.5, 0})};
  CHECK(ask({.unions = true}, world, look({0, 0, 0})).visible == Ids{0, 1});
  CHECK(ask({.unions = false}, world, look({0, 0, 0})).visible == Ids{0, 1, 2});
  CHECK(ask({.occluders = 1}, world, look({0, 0, 0})).visible == Ids{0, 1, 2});
  // The same in the plane, and in space with spheres, for a ball.
  const std::vector<Object> flat{standing(0, Rectangle{{4, 4}}, {10, -1.8, 0}), standing(1, Disc{3.0}, {16, 3.0, 0}),
                                 standing(2, Disc{1.0}, {30, 0.5, 0})};
  CHECK(ask({.dimension = 2, .unions = true}, flat, look({0, 0, 0})).visible == Ids{0, 1});
  CHECK(ask({.dimension = 2, .unions = false}, flat, look({0, 0, 0})).visible == Ids{0, 1, 2});
  const std::vector<Object> balls{standing(0, Sphere{2.0}, {10, -1.5, 0}), standing(1, Sphere{3.0}, {16, 2.5, 0}),
                                  standing(2, Sphere{1.5}, {30, 0.5, 0})};
  CHECK(ask({.unions = true}, balls, look({0, 0, 0})).visible == Ids{0, 1});
  CHECK(ask({.unions = false}, balls, look({0, 0, 0})).visible == Ids{0, 1, 2});
}

TEST_CASE("shadow-frusta: concave prisms hide with their convex parts, never themselves") {
  const std::vector<Vec2> corner{{0, 0}, {20, 0}, {20, 2}, {2, 2}, {2, 20}, {0, 20}};
  const std::vector<Object> world{standing(0, Prism{corner, 10}, {10, -30, 0}),
                                  standing(1, Sphere{0.5}, {16, -26, 1}),   // in the corner, seen
                                  standing(2, Sphere{0.5}, {20, -33, 1}),   // behind the long arm
                                  standing(3, Sphere{0.5}, {11, -25, 1})};  // within the other arm
  const Answer answer = ask({}, world, look({18, 0, 1}));
  CHECK(answer.visible == Ids{0, 1});
  // Self-crossing outlines are not taken apart: they hide nothing, and are seen.
  const std::vector<Vec2> bow{{0, 0}, {20, 10}, {20, 0}, {0, 10}};
  const std::vector<Object> crossed{standing(0, Prism{bow, 10}, {10, -30, 0}), standing(1, Sphere{0.5}, {24, -40, 1})};
  CHECK(ask({}, crossed, look({24, 0, 1})).visible == Ids{0, 1});
}

TEST_CASE("shadow-frusta: polygon soup hides triangle by triangle") {
  const Faces soup{{{0, -5, -5}, {0, 5, -5}, {0, 5, 5}, {0, -5, 5}}, {{0, 1, 2}, {0, 3, 2}}};
  const std::vector<Object> world{standing(0, soup, {10, 0, 0}), standing(1, Sphere{0.3}, {20, 4, -4}),
                                  standing(2, Sphere{0.3}, {20, -4, 4}), standing(3, Sphere{0.3}, {20, 12, 0})};
  CHECK(ask({}, world, look({0, 0, 0})).visible == Ids{0, 3});
  // The first triangle only.
  const Answer one = ask({.occluders = 1}, world, look({0, 0, 0}));
  CHECK(one.visible.size() == 3);
  CHECK(one.work.occluders == 1);
}

TEST_CASE("shadow-frusta: what is nearer than the near plane or out of sight to the side") {
  std::vector<Object> world{standing(0, Cuboid{{0.1, 4, 4}}, {2, 0, 0}), standing(1, Sphere{0.5}, {20, 0, 0}),
                            standing(2, Cuboid{{8, 8, 8}}, {-9, 0, 0})};
  View view = look({0, 0, 0});
  view.frustum = Frustum{.near = 5.0};
  const Answer answer = ask({.occluders = 1}, world, view);
  CHECK(answer.visible.empty());
  CHECK(answer.work.occluders == 1);  // the large box behind the viewer is none
  // What cannot hide: occluder no.
  world[0].occluder = false;
  CHECK(ask({.occluders = 1}, world, view).visible == Ids{1});
}

TEST_CASE("shadow-frusta: few tests when all is behind one wall, counted") {
  std::vector<Object> world{standing(0, Cuboid{{1, 100, 100}}, {10, 0, 0})};
  for (ObjectId i = 1; i <= 1000; ++i) {
    world.push_back(standing(i, Sphere{0.2}, {20.0 + i % 10, 0.3 * (i / 10 % 10), 0.3 * (i / 100)}));
  }
  const Answer answer = ask({}, world, look({0, 0, 0}), 3);
  CHECK(answer.visible == Ids{0});
  CHECK(answer.work.occluders == 1);  // the others lie in its shadow
  CHECK(answer.work.cells_visited < 30);
  CHECK(answer.work.cells_hidden < 15);
  CHECK(answer.work.object_tests < 8);
  CHECK(answer.work.rasters < 200);
}

TEST_CASE("shadow-frusta: exact tests change the work, not the answer") {
  std::vector<Object> world;
  for (ObjectId i = 0; i < 400; ++i) {
    Object object = standing(i, Cuboid{{0.5 + i % 3, 0.5 + i % 4, 0.5 + i % 5}},
                             {7.0 * (i % 20) - 70.0, 7.3 * (i / 20) - 70.0, 0.7 * (i % 7)});
    object.pose.orientation = turn_about_z(0.1 * i);
    world.push_back(object);
  }
  const Answer rough = ask({.exact = false}, world, look({1, 2, 1}), 2);
  const Answer exact = ask({.exact = true}, world, look({1, 2, 1}), 2);
  CHECK(rough.visible.size() < 390);
  CHECK(rough.visible == exact.visible);
  CHECK(exact.work.rasters > rough.work.rasters);
}
