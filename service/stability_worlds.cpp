#include "gridcull/service/stability_worlds.h"

#include <algorithm>
#include <cmath>

#include "gridcull/grid/choose_lattice.h"
#include "gridcull/sim/random.h"

namespace gridcull {
namespace {

constexpr double pitch = 20.0;
constexpr int blocks = 8;

/// A mover's way along a street: to and fro over `length` metres, however fast.
struct Track {
  Vec2 start;
  bool along_x;
  double phase;  ///< metres
  static constexpr double length = pitch * blocks;

  Vec2 at(double way) const {
    double s = std::fmod(phase + way, 2.0 * length);
    if (s > length) s = 2.0 * length - s;
    return along_x ? start + Vec2(s, 0.0) : start + Vec2(0.0, s);
  }
};

}  // namespace

ObjectId LimitBuilder::add(Shape shape, const Pose& pose) {
  Object object;
  object.id = static_cast<ObjectId>(world.objects.size());
  object.shape = std::move(shape);
  object.pose = pose;
  object.is_static = true;
  world.objects.push_back(object);
  return object.id;
}

Pose LimitBuilder::pose(const Vec2& position, double z) const {
  return {Vec3(position, world.dimension == 3 ? z : 0.0), {}};
}

ObjectId LimitBuilder::building(const Vec2& centre, const Vec2& size, double height) {
  if (world.dimension == 2) return add(Rectangle{size}, pose(centre));
  return add(Cuboid{Vec3(size, height)}, pose(centre, 0.5 * height));
}

ObjectId LimitBuilder::wall(const Vec2& a, const Vec2& b, double thickness, double height) {
  const Vec2 half = 0.5 * (b - a), centre = 0.5 * (a + b);
  if (thickness > 0.0) {
    const double length = std::sqrt(half.x * half.x + half.y * half.y);
    const Vec2 across = 0.5 * thickness / length * Vec2(-half.y, half.x);
    const std::vector<Vec2> outline{-half - across, half - across, half + across, -half + across};
    if (world.dimension == 2) return add(Polygon{outline}, pose(centre));
    return add(Prism{outline, height}, pose(centre));
  }
  if (world.dimension == 2) return add(Polyline{{-half, half}}, pose(centre));
  return add(
      Faces{{Vec3(-half, 0.0), Vec3(half, 0.0), Vec3(half, height), Vec3(-half, height)}, {{0, 1, 2}, {0, 2, 3}}},
      pose(centre));
}

ObjectId LimitBuilder::mover(const Vec2& centre, double radius, double max_speed) {
  const ObjectId id =
      world.dimension == 2 ? add(Disc{radius}, pose(centre)) : add(Sphere{radius}, pose(centre, mover_height));
  world.objects[id].is_static = false;
  world.objects[id].max_speed = max_speed;
  return id;
}

LimitFrame& LimitBuilder::frame(double time) {
  world.frames.push_back({time, {}, {}});
  return world.frames.back();
}

View LimitBuilder::viewer(const Vec2& position, ViewerId id) const {
  View view;
  view.viewer = id;
  view.pose = pose(position, eye_height);
  return view;
}

LimitWorld LimitBuilder::finish(double cell) {
  for (const Object& object : world.objects) add_extent(object, world.bounds);
  const Vec3 around(10.0, 10.0, world.dimension == 3 ? 10.0 : 0.0);
  const Vec3 aside = (cell / 1024.0) * Vec3(1.0, 1.0, world.dimension == 3 ? 1.0 : 0.0);
  world.bounds = {world.bounds.min - around - aside, world.bounds.max + around};
  world.cell = cell;
  return std::move(world);
}

LimitWorld quarter_world(const Quarter& q, int dimension) {
  LimitBuilder build(dimension);
  Random random(7);
  for (int y = 0; y < blocks; ++y) {
    for (int x = 0; x < blocks; ++x) {
      const Vec2 centre = q.origin + Vec2(pitch * (x + 0.5), pitch * (y + 0.5));
      build.building(centre, {random.uniform(8.0, 14.0), random.uniform(8.0, 14.0)}, random.uniform(6.0, 30.0));
    }
  }
  std::vector<Track> tracks;
  std::vector<ObjectId> movers;
  for (int k = 0; k < 40; ++k) {
    const bool along_x = k % 2 == 0;
    const double street = pitch * (1 + k / 2 % (blocks - 1)) + random.uniform(-1.0, 1.0);
    tracks.push_back({q.origin + (along_x ? Vec2(0.0, street) : Vec2(street, 0.0)), along_x,
                      random.uniform(0.0, 2.0 * Track::length)});
    movers.push_back(build.mover(tracks.back().at(0.0), 0.5, q.max_speed));
  }
  for (int f = 0; f < q.frames; ++f) {
    const double time = f * q.step;
    LimitFrame& frame = build.frame(time);
    for (std::size_t k = 0; k < movers.size() && f > 0; ++k) {
      frame.moved.emplace_back(movers[k], build.pose(tracks[k].at(q.speed * time), LimitBuilder::mover_height));
    }
    for (ViewerId v = 0; v < 4; ++v) {
      frame.views.push_back(build.viewer(q.origin + Vec2(pitch * (2 + 3 * (v % 2)), pitch * (2 + 3 * (v / 2))), v));
    }
  }
  return build.finish(q.cell);
}

}  // namespace gridcull
