#include "gridcull/sim/generate_parts.h"

#include <cmath>
#include <numbers>

#include "gridcull/core/trigonometry.h"
#include "gridcull/sim/scene_json.h"

namespace gridcull {

void GeneratedWorld::camera(ViewerId id, const Pose& pose) {
  SceneViewer& viewer = scene_.viewers.emplace_back();
  viewer.id = id;
  viewer.pose = pose;
  if (options_.range) viewer.range = *options_.range;
  if (scene_.dimension == 3) {
    viewer.own_direction = true;
    viewer.frustum = Frustum{radians_of(60.0), 16.0 / 9.0};
  }
}

double speed_bound(double speed) { return std::floor(speed * 1000.0 + 1.01) / 1000.0; }

Quat look_along(const Vec3& forward) {
  const double flat = std::sqrt(forward.x * forward.x + forward.y * forward.y);
  const double whole = std::sqrt(flat * flat + forward.z * forward.z);
  // Half-angle formulas; the yaw about +z, then the pitch about the turned -y axis.
  const auto half = [](double cosine, double sine) {
    const double c = std::sqrt(std::max(0.0, 0.5 * (1.0 + cosine)));
    const double s = std::sqrt(std::max(0.0, 0.5 * (1.0 - cosine)));
    return Vec2(c, sine < 0.0 ? -s : s);
  };
  const Vec2 yaw = half(forward.x / flat, forward.y);
  const Vec2 pitch = half(flat / whole, forward.z);
  const Quat q = Quat{yaw.x, 0.0, 0.0, yaw.y} * Quat{pitch.x, 0.0, -pitch.y, 0.0};
  return normalised(normalised(q));
}

void bounce(double& place, double& velocity, double seconds, double low, double high) {
  place += velocity * seconds;
  if (place < low || place > high) {
    place = place < low ? 2.0 * low - place : 2.0 * high - place;
    velocity = -velocity;
  }
}

double LaneLoop::length() const { return 2.0 * straight + std::numbers::pi * gap; }

LaneLoop::Place LaneLoop::at(double way) const {
  const double radius = 0.5 * gap;
  const double turn = std::numbers::pi * radius;
  Vec2 local;
  double heading = 0.0;
  if (way < straight) {
    local = {way, 0.0};
  } else if (way < straight + turn) {
    heading = (way - straight) / radius;
    const SinCos t = stable_sincos(heading);
    local = {straight + radius * t.sin, radius - radius * t.cos};
  } else if (way < 2.0 * straight + turn) {
    heading = std::numbers::pi;
    local = {2.0 * straight + turn - way, gap};
  } else {
    heading = std::numbers::pi + (way - 2.0 * straight - turn) / radius;
    const SinCos t = stable_sincos(heading);
    local = {radius * t.sin, radius - radius * t.cos};
  }
  // Along y the loop is turned by a quarter: (x, y) -> (-y, x).
  if (along_x) return {start + local, heading};
  return {start + Vec2(-local.y, local.x), heading + 0.5 * std::numbers::pi};
}

void drive(std::vector<LoopCar>& cars, double seconds, double z, Frame& out) {
  for (LoopCar& car : cars) {
    car.way += car.speed * seconds;
    while (car.way >= car.loop.length()) car.way -= car.loop.length();
    const LaneLoop::Place place = car.loop.at(car.way);
    ObjectMove& move = out.set.emplace_back();
    move.id = car.id;
    move.position = Vec3(place.position, z);
    move.heading = place.heading;
    move.orientation = turn_about_z(place.heading);
  }
}

}  // namespace gridcull
