// The sampled methods keep every rule of the contract but one: they may miss.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/core/error.h"
#include "gridcull/core/exact.h"
#include "gridcull/core/view_volume.h"
#include "gridcull/methods/bucket_grid.h"
#include "gridcull/methods/catalog.h"
#include "gridcull/methods/depth_pyramid.h"
#include "gridcull/methods/depth_scene.h"
#include "gridcull/methods/local_shape.h"
#include "property_run.h"
#include "random_world.h"

namespace gridcull::test {
namespace {

bool can_run(const MethodEntry& method) { return method.info.name != "depth-rays" || DepthScene::available(); }

MethodOptions options_for(int dimension) {
  MethodOptions options;
  options.dimension = dimension;
  options.bounds = {Vec3(-50, -50, dimension == 2 ? 0 : -50), Vec3(50, 50, dimension == 2 ? 0 : 50)};
  return options;
}

/// What the one viewer is told in a world that stands still.
std::vector<ObjectId> told(const char* method, int dimension, const std::vector<Object>& world, const View& view) {
  const auto culler = make_method(method, options_for(dimension));
  for (const Object& object : world) culler->add(object);
  Answers answers;
  culler->query(0.0, std::span(&view, 1), answers);
  return answers.views.at(0).visible;
}

using Ids = std::vector<ObjectId>;

}  // namespace

TEST_CASE("sampled methods keep all rules in random worlds, misses apart") {
  for (const int dimension : {2, 3}) {
    for (const MethodEntry& method : method_catalog()) {
      const bool takes = dimension == 2 ? method.info.takes_2d : method.info.takes_3d;
      if (method.info.guarantee != Guarantee::sampled || !takes || !can_run(method)) continue;
      CAPTURE(method.info.name);
      for (std::uint64_t seed = 1; seed <= 150; ++seed) {
        const auto fault = check_world(random_world(dimension, seed), method, 0);
        if (fault) FAIL_CHECK(dimension << "D, seed " << seed << ": " << fault->text);
      }
    }
  }
}

TEST_CASE("pairwise rays: one ray to the middle decides") {
  // The wall hides the middle of 2 and not its rim, which a ray to the middle cannot know.
  const Object wall{.id = 1, .shape = Rectangle{{1, 4}}, .pose = {{5, 0, 0}}};
  const Object wide{.id = 2, .shape = Rectangle{{1, 30}}, .pose = {{10, 0, 0}}};
  const Object beside{.id = 3, .shape = Disc{1}, .pose = {{10, 20, 0}}};
  const View view{.viewer = 7};
  CHECK(told("pairwise-rays", 2, {wall, wide, beside}, view) == Ids{1, 3});
}

TEST_CASE("sampled methods: what hides nothing, who is not told, who always is") {
  for (const int dimension : {2, 3}) {
    const Shape big = dimension == 2 ? Shape(Disc{3}) : Shape(Sphere{3});
    const Shape small = dimension == 2 ? Shape(Disc{1}) : Shape(Sphere{1});
    const Shape wall = dimension == 2 ? Shape(Polyline{{{0, -3}, {0, 3}}})
                                      : Shape(Faces{{{0, -9, -9}, {0, 9, -9}, {0, 0, 9}}, {{{0, 1, 2}}}});
    for (const char* method : {"pairwise-rays", "depth-rays"}) {
      if (dimension == 2 && method == std::string("depth-rays")) continue;
      if (method == std::string("depth-rays") && !DepthScene::available()) continue;
      CAPTURE(method);
      CAPTURE(dimension);
      const View view{.viewer = 7};
      Object front{.id = 1, .shape = big, .pose = {{10, 0, 0}}};
      const Object back{.id = 2, .shape = small, .pose = {{20, 0, 0}}};
      const Object around{.id = 3, .shape = big, .pose = {{-1, 0, 0}}};
      CHECK(told(method, dimension, {front, back}, view) == Ids{1});
      front.occluder = false;
      CHECK(told(method, dimension, {front, back}, view) == Ids{1, 2});
      front.occluder = true;
      CHECK(told(method, dimension, {around, back}, view) == Ids{2, 3});
      View rider = view;
      rider.rides = 3;
      CHECK(told(method, dimension, {around, back}, rider) == Ids{2});
      front.shape = wall;
      CHECK(told(method, dimension, {front, back}, view) == Ids{1});
      View near = view;
      near.range = 15.0;
      CHECK(told(method, dimension, {around, back}, near) == Ids{3});
    }
  }
}

TEST_CASE("pairwise rays report only what is seen, where the middle is in view") {
  std::mt19937_64 random(5);
  const auto uniform = [&](double low, double high) { return low + (high - low) * 0x1p-64 * random(); };
  int reported = 0;
  for (int round = 0; round < 60; ++round) {
    std::vector<Object> world;
    for (ObjectId id = 0; id < 60; ++id) {
      Object o{.id = id, .pose = {{uniform(-40, 40), uniform(-40, 40), 0}, turn_about_z(uniform(-3, 3))}};
      const double r = uniform(0.5, 4.0);
      switch (id % 4) {
        case 0: o.shape = Disc{r}; break;
        case 1: o.shape = Rectangle{{r, 2.0 * r}}; break;
        case 2: o.shape = Polygon{{{-r, -r}, {r, -r}, {r, r}, {0, -0.5 * r}, {-r, r}}}; break;
        default: o.shape = Polyline{{{-r, 0}, {0, r}, {r, 0}}};
      }
      o.occluder = id % 7 != 0;
      o.is_static = id % 3 == 0;
      world.push_back(o);
    }
    const View view{.viewer = 1, .pose = {{uniform(-40, 40), uniform(-40, 40), 0}}};
    const ExactAnswer exact = exact_visible_2d(world, view);
    for (const ObjectId id : told("pairwise-rays", 2, world, view)) {
      ++reported;
      CAPTURE(round);
      CAPTURE(id);
      // The middle of a chain or of a concave outline's box may lie outside the object: then the ray sees nothing of
      // it.
      if (id % 4 < 2) CHECK(std::binary_search(exact.visible.begin(), exact.visible.end(), id));
    }
  }
  CHECK(reported > 500);
}

TEST_CASE("depth rays see most of what is visible, and hide") {
  if (!DepthScene::available()) {
    MESSAGE("skipped: built without Embree");
    return;
  }
  std::mt19937_64 random(7);
  const auto uniform = [&](double low, double high) { return low + (high - low) * 0x1p-64 * random(); };
  std::size_t seen = 0, missed = 0, told_of = 0;
  for (int round = 0; round < 6; ++round) {
    std::vector<Object> world;
    for (ObjectId id = 0; id < 400; ++id) {
      Object o{.id = id, .pose = {{uniform(5, 45), uniform(-25, 25), uniform(-25, 25)}, turn_about_z(uniform(-3, 3))}};
      const double r = uniform(0.5, 3.0);
      switch (id % 4) {
        case 0: o.shape = Sphere{r}; break;
        case 1: o.shape = Cuboid{{r, 2.0 * r, r}}; break;
        case 2: o.shape = Prism{{{-r, -r}, {r, -r}, {r, r}, {0, -0.5 * r}, {-r, r}}, r}; break;
        default: o.shape = Convex{{{-r, 0, 0}, {r, 0, 0}, {0, r, 0}, {0, 0, r}}};
      }
      o.is_static = id % 3 == 0;
      world.push_back(o);
    }
    View view{.viewer = 1};
    if (round % 2 == 0) view.frustum = Frustum{1.0, 16.0 / 9.0};
    const Ids ids = told("depth-rays", 3, world, view);
    const ExactAnswer exact = ExactRays(world, 400).visible(view);
    for (const ObjectId id : exact.visible) missed += std::binary_search(ids.begin(), ids.end(), id) ? 0 : 1;
    seen += exact.visible.size();
    told_of += ids.size();
  }
  MESSAGE("visible " << seen << ", told of " << told_of << ", missed " << missed);
  CHECK(20 * missed < seen);
  CHECK(told_of < 6 * 300);
}

TEST_CASE("the depth pyramid answers as its pixels do") {
  std::mt19937_64 random(11);
  for (const auto& [width, height] : {std::pair{1, 1}, {5, 3}, {16, 16}, {33, 20}, {128, 72}}) {
    DepthPyramid pyramid;
    pyramid.resize(width, height);
    for (float& depth : pyramid.pixels()) depth = static_cast<float>(random() % 100);
    pyramid.build();
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    for (int i = 0; i < 500; ++i) {
      const int a = below(width), b = below(width), c = below(height), d = below(height);
      const PixelBox box{std::min(a, b), std::min(c, d), std::max(a, b), std::max(c, d)};
      const auto depth = static_cast<float>(below(110));
      bool expected = false;
      for (int y = box.top; y <= box.bottom; ++y) {
        for (int x = box.left; x <= box.right; ++x) {
          expected = expected || pyramid.pixels()[static_cast<std::size_t>(y * width + x)] >= depth;
        }
      }
      std::uint64_t looked_at = 0;
      CHECK(pyramid.may_show(box, depth, looked_at) == expected);
    }
  }
}

TEST_CASE("a bucket grid hands out every item along a segment and in a box") {
  std::mt19937_64 random(13);
  const auto uniform = [&](double low, double high) { return low + (high - low) * 0x1p-64 * random(); };
  for (const int dimension : {2, 3}) {
    const double flat = dimension == 2 ? 0.0 : 1.0;
    const Bounds world{Vec3(-50, -50, -50 * flat), Vec3(50, 50, 50 * flat)};
    std::vector<BucketGrid::Item> items;
    for (std::uint32_t i = 0; i < 300; ++i) {
      const Vec3 middle(uniform(-60, 60), uniform(-60, 60), flat * uniform(-60, 60)),
          half(uniform(0.1, i % 50 == 0 ? 30 : 3));
      items.push_back({{middle - half, middle + half}, i});
      if (dimension == 2) items.back().box.min.z = items.back().box.max.z = 0.0;
    }
    BucketGrid grid;
    grid.build(items, world, dimension);
    CHECK(grid.bucket_count() > 100);
    std::uint64_t walked = 0;
    for (int round = 0; round < 400; ++round) {
      Vec3 from(uniform(-70, 70), uniform(-70, 70), flat * uniform(-70, 70));
      Vec3 to(uniform(-70, 70), uniform(-70, 70), flat * uniform(-70, 70));
      if (round % 5 == 0) to.x = from.x;
      std::vector<char> met(items.size(), 0), close(items.size(), 0);
      CHECK_FALSE(grid.walk(from, to - from, walked, [&](std::uint32_t name) {
        met[name] = 1;
        return false;
      }));
      Bounds box;
      box.add(from);
      box.add(to);
      grid.near(box, [&](std::uint32_t name) { close[name] = 1; });
      for (const auto& item : items) {
        LocalShape shape = make_local_shape(Cuboid{item.box.size() + Vec3(0, 0, dimension == 2 ? 1 : 0)});
        std::vector<double> scratch;
        if (blocks_segment(shape, from - item.box.centre(), to - from, scratch)) CHECK(met[item.name] == 1);
        bool overlaps = true;
        for (int k = 0; k < dimension; ++k) {
          overlaps = overlaps && item.box.min[k] <= box.max[k] && item.box.max[k] >= box.min[k];
        }
        if (overlaps) CHECK(close[item.name] == 1);
      }
    }
    CHECK(walked > 0);
  }
}

TEST_CASE("depth rays refuse sizes out of range") {
  for (const int size : {-1, 8193}) {
    MethodOptions options = options_for(3);
    options.rays_width = size < 0 ? 4 : size;
    options.rays_height = size;
    CHECK_THROWS_AS(make_method("depth-rays", options), Error);
  }
}

}  // namespace gridcull::test
