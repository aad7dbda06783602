#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include "gridcull/core/error.h"
#include "gridcull/core/exact.h"
#include "gridcull/core/exact_3d_solids.h"
#include "gridcull/core/hull.h"
#include "gridcull/core/view_volume.h"
#include "hand_made_scenes.h"
#include "naive_rays_2d.h"

using namespace gridcull;
using namespace gridcull::test;

namespace {

bool has(const std::vector<ObjectId>& ids, ObjectId id) { return std::binary_search(ids.begin(), ids.end(), id); }

bool skip_without_embree() {
  if (ExactRays::available()) return false;
  MESSAGE("SKIPPED: built without Embree, no 3D reference");
  CHECK_THROWS_AS(ExactRays({}, 1), Error);
  return true;
}

Shape random_solid(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Vec2> outline;
  std::vector<Vec3> points;
  for (int i = 0; i < 7; ++i) outline.emplace_back(4 * unit(random) - 2, 4 * unit(random) - 2);
  for (int i = 0; i < 9; ++i) points.emplace_back(4 * unit(random) - 2, 4 * unit(random) - 2, 4 * unit(random) - 2);
  switch (random() % 4) {
    case 0: return Sphere{0.2 + unit(random)};
    case 1: return Cuboid{{0.2 + 3 * unit(random), 0.2 + 3 * unit(random), 0.2 + 3 * unit(random)}};
    case 2: return Prism{outline, 0.2 + 3 * unit(random)};
    default: return Convex{points};
  }
}

Quat random_turn(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return normalised({normal(random), normal(random), normal(random), normal(random)});
}

Vec3 random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(Vec3(normal(random), normal(random), normal(random)));
}

/// The 2D world as tall prisms and boxes of one height, the eye at half of it: the same objects are seen.
std::vector<Object> extruded(const std::vector<Object>& flat, double height) {
  std::vector<Object> out;
  for (Object o : flat) {
    if (const auto* box = std::get_if<Rectangle>(&o.shape)) {
      o.shape = Cuboid{{box->size.x, box->size.y, height}};
      o.pose.position.z = 0.5 * height;
    } else if (const auto* polygon = std::get_if<Polygon>(&o.shape)) {
      o.shape = Prism{polygon->vertices, height};
    } else {
      continue;
    }
    out.push_back(o);
  }
  return out;
}

}  // namespace

TEST_CASE("exact 3d: hand-made scenes") {
  if (skip_without_embree()) return;
  for (const HandMadeScene& scene : hand_made_scenes()) {
    if (scene.dimension != 3) continue;
    CAPTURE(scene.name);
    const ExactRays rays(scene.objects, 96);
    const ExactAnswer answer = rays.visible(scene.view);
    CHECK(answer.lower_bound);
    CHECK(answer.witness.size() == answer.visible.size());
    CHECK(std::is_sorted(answer.visible.begin(), answer.visible.end()));
    for (const ObjectId id : scene.sees) CHECK_MESSAGE(has(answer.visible, id), "should see " << id);
    for (std::size_t i = 0; i < answer.visible.size(); ++i) {
      const ObjectId id = answer.visible[i];
      const bool hidden = std::find(scene.hides.begin(), scene.hides.end(), id) != scene.hides.end();
      CHECK_MESSAGE(!hidden, "should not see " << id);
      CHECK_MESSAGE(rays.confirm(scene.view, id, answer.witness[i]) == !hidden, "confirming " << id);
    }
  }
}

TEST_CASE("exact 3d: hidden things are not confirmed in any direction") {
  if (skip_without_embree()) return;
  for (const HandMadeScene& scene : hand_made_scenes()) {
    if (scene.dimension != 3) continue;
    CAPTURE(scene.name);
    const ExactRays rays(scene.objects, 1);
    std::mt19937_64 random(5);
    for (const ObjectId id : scene.hides) {
      CAPTURE(id);
      const auto object = std::find_if(scene.objects.begin(), scene.objects.end(), [&](auto& o) { return o.id == id; });
      for (int k = 0; k < 300; ++k) {
        // Its very middle too: there, seams between abutting boxes let single rays through.
        const double off = k == 0 ? 0.0 : 0.6 * reach_of(object->shape);
        const Vec3 target = object->pose.position + off * random_direction(random);
        CHECK_FALSE(rays.confirm(scene.view, id, target - scene.view.pose.position));
      }
    }
  }
}

TEST_CASE("exact 3d: an extruded 2D world looks as in 2D") {
  if (skip_without_embree()) return;
  std::size_t expected = 0, found = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    std::vector<Object> flat = random_world_2d(seed, 14);
    std::erase_if(flat, [](const Object& o) {
      return !std::holds_alternative<Rectangle>(o.shape) && !std::holds_alternative<Polygon>(o.shape);
    });
    if (flat.empty()) continue;
    View view = random_view_2d(seed, flat);
    view.fov = 2 * std::numbers::pi;
    const std::vector<Object> tall = extruded(flat, 10);
    View view_3d = view;
    view_3d.pose.position.z = 5;
    const ExactAnswer in_2d = exact_visible_2d(flat, view);
    const ExactRays rays(tall, 64);
    const ExactAnswer in_3d = rays.visible(view_3d);
    // Embree's floats may err at edges, so what 2D calls hidden must merely not be confirmed.
    for (std::size_t i = 0; i < in_3d.visible.size(); ++i) {
      CAPTURE(in_3d.visible[i]);
      if (!has(in_2d.visible, in_3d.visible[i])) CHECK_FALSE(rays.confirm(view_3d, in_3d.visible[i], in_3d.witness[i]));
    }
    for (std::size_t i = 0; i < in_2d.visible.size(); ++i) {
      ++expected;
      if (has(in_3d.visible, in_2d.visible[i])) ++found;
    }
  }
  CHECK(found >= expected * 98 / 100);
  CHECK(expected > 200);
}

TEST_CASE("exact 3d: what 2D sees along a wide interval is confirmed along its middle") {
  if (skip_without_embree()) return;
  std::size_t claims = 0, confirmed = 0;
  for (std::uint64_t seed = 100; seed < 200; ++seed) {
    std::vector<Object> flat = random_world_2d(seed, 14);
    std::erase_if(flat, [](const Object& o) { return !std::holds_alternative<Rectangle>(o.shape); });
    if (flat.empty()) continue;
    View view = random_view_2d(seed, flat);
    const ExactAnswer in_2d = exact_visible_2d(flat, view);
    const ExactRays rays(extruded(flat, 10), 1);
    view.pose.position.z = 5;
    for (std::size_t i = 0; i < in_2d.visible.size(); ++i) {
      ++claims;
      if (rays.confirm(view, in_2d.visible[i], in_2d.witness[i])) ++confirmed;
    }
  }
  CHECK(claims > 150);
  // All but what 2D sees through less than the little cone of confirm().
  CHECK(confirmed >= claims * 98 / 100);
}

TEST_CASE("exact 3d: stretches agree with membership") {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::size_t inside = 0;
  for (int round = 0; round < 400; ++round) {
    CAPTURE(round);
    Object o;
    o.id = 1;
    o.shape = random_solid(random);
    o.pose = {Vec3(3 * unit(random), 3 * unit(random), 3 * unit(random)), random_turn(random)};
    const std::vector<Object> world{o};
    const std::vector<exact::Solid> solids = exact::make_solids(world);
    const Vec3 eye = o.pose.position + 3.0 * Vec3(unit(random), unit(random), unit(random));
    const Vec3 ray = glm::normalize(o.pose.position + 0.5 * random_direction(random) - eye);
    std::vector<exact::Stretch> stretches;
    exact::add_stretches(solids[0], eye, ray, stretches);
    for (int k = 0; k < 60; ++k) {
      const double t = 6 * unit(random);
      const bool on_edge = std::any_of(stretches.begin(), stretches.end(), [&](const exact::Stretch& s) {
        return std::fabs(s.begin - t) < 1e-9 || std::fabs(s.end - t) < 1e-9;
      });
      if (on_edge) continue;
      const bool within = std::any_of(stretches.begin(), stretches.end(),
                                      [&](const exact::Stretch& s) { return s.begin < t && t < s.end; });
      CHECK(within == interior_holds(o.shape, o.pose, eye + t * ray));
      if (within) ++inside;
    }
    CHECK(exact::surely_holds(solids[0], eye) == interior_holds(o.shape, o.pose, eye));
  }
  CHECK(inside > 1000);
}

TEST_CASE("exact 3d: impossible requests are refused") {
  if (skip_without_embree()) return;
  const std::vector<Object> flat{Object{.id = 1, .shape = Disc{1.0}}};
  CHECK_THROWS_AS(ExactRays(flat, 8), Error);
  CHECK_THROWS_AS(ExactRays({}, 0), Error);
  const ExactRays rays({}, 4);
  CHECK(rays.visible(View{}).visible.empty());
  View view;
  view.frustum = Frustum{.fov_y = 4.0};
  CHECK_THROWS_AS(rays.visible(view), Error);
  CHECK_FALSE(rays.confirm(View{}, 7, {1, 0, 0}));
}

TEST_CASE("exact 3d: while its trees are there, TBB has all its threads") {
  if (skip_without_embree()) return;
  using Control = tbb::global_control;
  const auto allowed = static_cast<std::size_t>(tbb::info::default_concurrency());
  const std::vector<Object> world{Object{.id = 1, .shape = Sphere{1.0}}};
  const ExactRays rays(world, 4), others(world, 4);
  CHECK(Control::active_value(Control::max_allowed_parallelism) == allowed);
  { const ExactRays gone(world, 4); }
  CHECK(Control::active_value(Control::max_allowed_parallelism) == allowed);
}

TEST_CASE("a closed mesh hides what is in it from a viewer on its face, as a box does") {
  Faces cube{{}, {}, true};
  for (int i = 0; i < 8; ++i) cube.vertices.emplace_back((i & 1) ? 6 : -6, (i & 2) ? 6 : -6, (i & 4) ? 6 : -6);
  for (const auto& [a, b, c, d] : std::vector<std::array<std::uint32_t, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    cube.triangles.push_back({a, b, c});
    cube.triangles.push_back({a, c, d});
  }
  for (const double away : {0.0, 1e3, 1e6}) {
    const Vec3 middle(away, 0.5 * away, 0.0);
    for (const Shape& shape : {Shape(cube), Shape(Cuboid{{12, 12, 12}})}) {
      const std::vector<Object> world{{.id = 1, .shape = shape, .pose = {middle}},
                                      {.id = 2, .shape = Sphere{1.0}, .pose = {middle + Vec3(0.3, 0.2, 0.1)}}};
      const View view{.viewer = 1, .pose = {middle + Vec3(-6.0, 0.7, 1.3)}};
      const ExactRays rays(world, 64);
      for (const ObjectId id : rays.visible(view).visible) {
        const ExactAnswer seen = rays.visible(view);
        const auto at = std::find(seen.visible.begin(), seen.visible.end(), id) - seen.visible.begin();
        if (id == 2) CHECK_FALSE(rays.confirm(view, 2, seen.witness[static_cast<std::size_t>(at)]));
      }
    }
  }
}
