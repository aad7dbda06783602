#include <cmath>
#include <numbers>
#include <random>

#include <doctest/doctest.h>

#include "gridcull/core/error.h"
#include "gridcull/core/view_volume.h"
#include "naive_rays_2d.h"

using namespace gridcull;

namespace {

struct Dice {
  std::mt19937_64 random;
  double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  bool chance(double p) { return real(0, 1) < p; }
  Vec3 direction() {
    std::normal_distribution<double> normal;
    return glm::normalize(Vec3(normal(random), normal(random), normal(random)));
  }
};

/// The definition, written out: is the point in the view volume?
bool in_view(const View& view, int dimension, const Vec3& p) {
  const Vec3 d = rotation_of(view.pose.orientation).inverse(p - view.pose.position);
  if (glm::length(d) > view.range) return false;
  if (dimension == 2) return view.fov >= 2 * std::numbers::pi || std::fabs(std::atan2(d.y, d.x)) <= 0.5 * view.fov;
  if (!view.frustum) return true;
  const double t = std::tan(0.5 * view.frustum->fov_y);
  return d.x >= view.frustum->near && d.x <= view.frustum->far && std::fabs(d.z) <= t * d.x &&
         std::fabs(d.y) <= t * view.frustum->aspect * d.x;
}

View random_view(Dice& dice, int dimension) {
  View view;
  const bool flat = dimension == 2;
  view.pose.position = {dice.real(-5, 5), dice.real(-5, 5), flat ? 0.0 : dice.real(-5, 5)};
  const Vec3 axis = dice.direction();
  view.pose.orientation =
      flat ? turn_about_z(dice.real(-4, 4)) : normalised({dice.real(-1, 1), axis.x, axis.y, axis.z});
  if (dice.chance(0.5)) view.range = dice.real(1, 15);
  if (flat && dice.chance(0.8)) view.fov = dice.real(0.05, 2 * std::numbers::pi);
  if (!flat && dice.chance(0.8)) {
    view.frustum = Frustum{dice.real(0.2, 2.6), dice.real(0.3, 3)};
    if (dice.chance(0.5)) view.frustum->near = dice.real(0.1, 4);
    if (dice.chance(0.5)) view.frustum->far = view.frustum->near + dice.real(1, 10);
  }
  return view;
}

/// A random point of the closed shape (its corners and middle weighted up).
Vec3 point_of(const Shape& shape, const Pose& pose, Dice& dice) {
  if (const auto* disc = std::get_if<Disc>(&shape)) {
    const double a = dice.real(-4, 4);
    return pose.position + dice.real(0, 1) * disc->radius * Vec3(std::cos(a), std::sin(a), 0);
  }
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    return pose.position + dice.real(0, 1) * sphere->radius * dice.direction();
  }
  std::vector<Vec3> points = world_vertices(shape, pose);
  for (const Vec2& p : world_outline(shape, pose)) points.emplace_back(p, 0.0);
  const auto pick = [&] { return points[dice.random() % points.size()]; };
  if (is_thin(shape)) {
    const std::size_t i = 1 + dice.random() % (points.size() - 1);
    return glm::mix(points[i - 1], points[i], dice.real(0, 1));
  }
  // Boxes and hulls are convex; polygons are only asked for their corners.
  if (std::holds_alternative<Polygon>(shape) || dice.chance(0.3)) return pick();
  return glm::mix(glm::mix(pick(), pick(), dice.real(0, 1)), pick(), dice.real(0, 1));
}

Shape random_shape(Dice& dice, int dimension) {
  const auto size = [&] { return dice.real(0.1, 4); };
  std::vector<Vec3> points;
  std::vector<Vec2> flat;
  for (int i = 0; i < 7; ++i) points.emplace_back(dice.real(-3, 3), dice.real(-3, 3), dice.real(-3, 3));
  for (const Vec3& p : points) flat.emplace_back(p);
  switch (dice.random() % 4 + (dimension == 2 ? 0 : 4)) {
    case 0: return Disc{size()};
    case 1: return Rectangle{{size(), size()}};
    case 2: return Polygon{flat};
    case 3: return Polyline{flat};
    case 4: return Sphere{size()};
    case 5: return Cuboid{{size(), size(), size()}};
    case 6: return Convex{points};
    default: return Convex{{points[0], points[1], points[2], points[3]}};
  }
}

}  // namespace

TEST_CASE("view volume: never says no to something that touches it") {
  std::size_t touching = 0, rejected = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    CAPTURE(seed);
    Dice dice{std::mt19937_64(seed)};
    const int dimension = 2 + static_cast<int>(seed % 2);
    const View view = random_view(dice, dimension);
    const ViewVolume volume(view, dimension);
    const Shape shape = random_shape(dice, dimension);
    const Pose pose{{dice.real(-15, 15), dice.real(-15, 15), dimension == 2 ? 0.0 : dice.real(-15, 15)},
                    turn_about_z(dice.real(-4, 4))};
    const bool may = volume.may_touch(shape, pose);
    if (!may) ++rejected;
    if (may) CHECK(volume.may_touch_ball(pose.position, reach_of(shape)));
    for (int k = 0; k < 40; ++k) {
      const Vec3 p = point_of(shape, pose, dice);
      if (!in_view(view, dimension, p)) continue;
      ++touching;
      CHECK(may);
      CHECK(volume.may_touch_ball(p, 1e-6));
    }
  }
  CHECK(touching > 5000);
  CHECK(rejected > 500);
}

TEST_CASE("view volume: says no to what is plainly outside") {
  View view;
  view.fov = std::numbers::pi / 3;
  view.range = 10;
  const ViewVolume volume(view, 2);
  CHECK_FALSE(volume.may_touch(Disc{1}, {{-5, 0, 0}, {}}));
  CHECK_FALSE(volume.may_touch(Disc{1}, {{0, 5, 0}, {}}));
  CHECK_FALSE(volume.may_touch(Disc{1}, {{12, 0, 0}, {}}));
  CHECK_FALSE(volume.may_touch(Rectangle{{1, 1}}, {{10.6, 0, 0}, {}}));
  CHECK(volume.may_touch(Rectangle{{1, 1}}, {{10.5, 0, 0}, {}}));
  // The box's ball reaches into the range, the box does not.
  CHECK_FALSE(volume.may_touch(Rectangle{{1, 20}}, {{10.6, 0, 0}, {}}));
  View wide;
  wide.fov = 1.9 * std::numbers::pi;
  CHECK_FALSE(ViewVolume(wide, 2).convex());
  CHECK_FALSE(ViewVolume(wide, 2).may_touch(Disc{0.1}, {{-10, 0, 0}, {}}));
  CHECK(ViewVolume(wide, 2).may_touch(Disc{0.1}, {{-10, 3, 0}, {}}));
  CHECK(ViewVolume(View{}, 2).all_round());
}

TEST_CASE("view volume: impossible views are refused") {
  const auto refuses = [](const View& view, int dimension) { CHECK_THROWS_AS(ViewVolume(view, dimension), Error); };
  View view;
  view.range = 0;
  refuses(view, 2);
  view.range = std::nan("");
  refuses(view, 3);
  view = {};
  view.fov = 0;
  refuses(view, 2);
  view.fov = 6.3;
  refuses(view, 2);
  view = {};
  view.pose.position.x = 1e300;
  refuses(view, 2);
  for (const Frustum& f : {Frustum{0, 1, 0, 1}, Frustum{3.2, 1, 0, 1}, Frustum{1, 0, 0, 1}, Frustum{1, 1, -1, 1},
                           Frustum{1, 1, 2, 2}, Frustum{1, 1, std::nan(""), 2}}) {
    view = {};
    view.frustum = f;
    refuses(view, 3);
  }
}

TEST_CASE("view volume: open interiors on corners, walls and in holes") {
  const Shape box = Rectangle{{4, 2}};
  const Pose pose{{10, 10, 0}, {}};
  CHECK(interior_holds(box, pose, {10, 10, 0}));
  CHECK(interior_holds(box, pose, {11.9, 10.9, 0}));
  CHECK_FALSE(interior_holds(box, pose, {12, 10, 0}));
  CHECK_FALSE(interior_holds(box, pose, {12, 11, 0}));
  CHECK_FALSE(interior_holds(box, pose, {13, 10, 0}));
  CHECK_FALSE(interior_holds(Disc{2}, pose, {12, 10, 0}));
  CHECK(interior_holds(Disc{2}, pose, {11.99, 10, 0}));
  CHECK_FALSE(interior_holds(Polyline{{{-5, 0}, {5, 0}}}, pose, {10, 10, 0}));
  CHECK_FALSE(interior_holds(Polygon{{{0, 0}, {4, 0}, {2, 0}}}, Pose{}, {1, 0, 0}));
  const Shape star = Polygon{{{0, 10}, {5.88, -8.09}, {-9.51, 3.09}, {9.51, 3.09}, {-5.88, -8.09}}};
  CHECK_FALSE(interior_holds(star, Pose{}, {0, 0, 0}));
  CHECK(interior_holds(star, Pose{}, {0, 6, 0}));
  const Shape prism = Prism{{{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}}, 3};
  CHECK(interior_holds(prism, Pose{}, {0.5, 1, 1}));
  CHECK_FALSE(interior_holds(prism, Pose{}, {2, 3, 1}));
  CHECK_FALSE(interior_holds(prism, Pose{}, {0.5, 1, 3}));
  CHECK_FALSE(interior_holds(prism, Pose{}, {0.5, 1, 0}));
  CHECK(interior_holds(Cuboid{{2, 2, 2}}, Pose{{0, 0, 1}, {}}, {0.5, 0.5, 1.9}));
  CHECK_FALSE(interior_holds(Cuboid{{2, 2, 2}}, Pose{{0, 0, 1}, {}}, {0.5, 0.5, 2}));
  CHECK(interior_holds(Sphere{1}, Pose{}, {0.5, 0.5, 0.5}));
  CHECK_FALSE(interior_holds(Sphere{1}, Pose{}, {1, 0, 0}));
}

TEST_CASE("view volume: distances in 2D") {
  const Pose pose{{10, 0, 0}, {}};
  CHECK(distance_2d({0, 0}, Disc{3}, pose) == 7.0);
  CHECK(distance_2d({9, 0}, Disc{3}, pose) == 0.0);
  CHECK(distance_2d({0, 0}, Rectangle{{2, 2}}, pose) == 9.0);
  CHECK(distance_2d({10, 0.5}, Rectangle{{2, 2}}, pose) == 0.0);
  CHECK(distance_2d({12, 4}, Rectangle{{2, 6}}, pose) == doctest::Approx(std::sqrt(2.0)));
  CHECK(distance_2d({10, 1}, Polyline{{{-5, 0}, {5, 0}}}, pose) == 1.0);
  CHECK(distance_2d({17, 0}, Polyline{{{-5, 0}, {5, 0}}}, pose) == 2.0);
}
