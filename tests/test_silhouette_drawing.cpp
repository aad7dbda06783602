// What method `silhouette` draws: in 2D exactly the points that the viewer sees, the nodes of the index, the volumes.
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/core/view_volume.h"
#include "gridcull/grid/engine.h"
#include "gridcull/sim/random.h"

using namespace gridcull;

namespace {

struct Recorder final : DrawSink {
  std::map<CellLayer, std::vector<Bounds>> boxes;
  std::vector<Vec2> outline;
  std::size_t volumes = 0, revealed = 0;
  void cells(CellLayer layer, const Vec3& low, const Vec3& high) override { boxes[layer].push_back({low, high}); }
  void tbv(ObjectId, const Vec3&, double, bool open) override { ++(open ? revealed : volumes); }
  void region(std::span<const Vec2> points) override { outline.assign(points.begin(), points.end()); }
};

bool inside(const std::vector<Vec2>& ring, const Vec2& p) {
  bool in = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) * (b.x - a.x) / (b.y - a.y)) in = !in;
  }
  return in;
}

bool crosses(const Vec2& p, const Vec2& q, const Vec2& a, const Vec2& b) {
  return (cross2(q - p, a - p) > 0.0) != (cross2(q - p, b - p) > 0.0) &&
         (cross2(b - a, p - a) > 0.0) != (cross2(b - a, q - a) > 0.0);
}

double from_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const double t = glm::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
  return glm::length(p - (a + t * (b - a)));
}

/// Forty houses around the middle, which stays free.
std::vector<Object> houses(Random& random) {
  std::vector<Object> world;
  while (world.size() < 40) {
    const Vec3 place(random.uniform(0.0, 100.0), random.uniform(0.0, 100.0), 0.0);
    if (glm::length(place - Vec3(50, 50, 0)) < 9.0) continue;
    world.push_back({.id = static_cast<ObjectId>(world.size()),
                     .shape = Rectangle{{random.uniform(2.0, 8.0), random.uniform(2.0, 8.0)}},
                     .pose = {place, turn_about_z(random.uniform(0.0, 6.0))},
                     .is_static = true});
  }
  return world;
}

}  // namespace

TEST_CASE("the region that is drawn holds the points that the viewer sees and no others") {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const std::vector<Object> world = houses(random);
    const double range = seed % 3 == 0 ? std::numeric_limits<double>::infinity() : 40.0;
    const View view{.viewer = 1,
                    .pose = {{50, 50, 0}, turn_about_z(random.uniform(0.0, 6.0))},
                    .range = range,
                    .fov = seed % 2 == 0 ? 2.0 * std::numbers::pi : 2.0};
    GridEngine engine(
        {.dimension = 2, .bounds = {{0, 0, 0}, {100, 100, 0}}, .cell = 1.0, .hiding = Hiding::silhouette});
    for (const Object& house : world) engine.add(house);
    Recorder drawn;
    Answers with, without;
    engine.draw_next(1, &drawn);
    engine.query(0.0, {&view, 1}, with);
    engine.query(1.0, {&view, 1}, without);
    CHECK(with.views[0].visible == without.views[0].visible);
    const ViewVolume volume(view, 2);
    int sights = 0, points = 0;
    for (int i = 0; i < 4000; ++i) {
      const Vec2 eye(50, 50), p(random.uniform(0.0, 100.0), random.uniform(0.0, 100.0));
      const double distance = glm::length(p - eye);
      bool open = distance < range && volume.may_touch_ball(Vec3(p, 0.0), 0.0),
           near = std::fabs(distance - range) < 0.05;
      for (const Object& house : world) {
        const std::vector<Vec2> ring = world_outline(house.shape, house.pose);
        for (std::size_t k = 0; k < ring.size(); ++k) {
          const Vec2 &a = ring[k], &b = ring[(k + 1) % ring.size()];
          if (crosses(eye, p, a, b)) open = false;
          near = near || from_segment(p, a, b) < 1e-6;
        }
      }
      if (near) continue;
      CAPTURE(p.x);
      CAPTURE(p.y);
      CHECK(inside(drawn.outline, p) == open);
      sights += open ? 1 : 0;
      ++points;
      for (const Bounds& box : drawn.boxes[CellLayer::hidden]) {
        if (p.x > box.min.x && p.x < box.max.x && p.y > box.min.y && p.y < box.max.y) CHECK(!open);
      }
    }
    CHECK(sights > 40);
    CHECK(points > 3000);
    CHECK(!drawn.boxes[CellLayer::visited].empty());
  }
}

TEST_CASE("nodes and volumes are drawn in both dimensions, once, when asked for") {
  for (const int dimension : {2, 3}) {
    CAPTURE(dimension);
    const bool solid = dimension == 3;
    GridEngine engine({.dimension = dimension,
                       .bounds = {{0, 0, 0}, {100, 100, solid ? 40.0 : 0.0}},
                       .cell = 1.0,
                       .hiding = Hiding::silhouette});
    const double z = solid ? 20.0 : 0.0;
    engine.add({.id = 0,
                .shape = solid ? Shape{Cuboid{{2, 60, 40}}} : Shape{Rectangle{{2, 60}}},
                .pose = {{40, 50, z}},
                .is_static = true});
    for (ObjectId id = 1; id <= 40; ++id) {
      engine.add({.id = id,
                  .shape = solid ? Shape{Sphere{0.5}} : Shape{Disc{0.5}},
                  .pose = {{70.0 + id % 8, 46.0 + id / 8, z}},
                  .max_speed = 1});
    }
    engine.add({.id = 41, .shape = solid ? Shape{Sphere{0.5}} : Shape{Disc{0.5}}, .pose = {{10, 50, z}}});
    const View view{.viewer = 1, .pose = {{20, 50, z}}, .range = 80.0};
    Answers answers;
    Recorder drawn;
    for (int frame = 0; frame < 4; ++frame) {
      if (frame == 3) engine.draw_next(1, &drawn);
      engine.query(frame, {&view, 1}, answers);
    }
    CHECK(answers.views[0].visible == std::vector<ObjectId>{0, 41});
    CHECK(drawn.volumes == 40);
    CHECK(drawn.revealed == 0);
    CHECK(!drawn.boxes[CellLayer::visited].empty());
    CHECK(!drawn.boxes[CellLayer::hidden].empty());
    CHECK(drawn.outline.empty() == solid);
    const std::size_t before = drawn.boxes[CellLayer::visited].size();
    engine.query(4.0, {&view, 1}, answers);
    CHECK(drawn.boxes[CellLayer::visited].size() == before);
  }
}
