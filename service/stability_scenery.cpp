// The places that limits share.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "gridcull/core/pose.h"
#include "gridcull/service/stability_worlds.h"

namespace gridcull {
namespace {

double radians(double degrees) { return degrees * (std::numbers::pi / 180.0); }

int crowd_side(int count) { return static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count)))); }

/// Targets on a grid about the middle of a square.
void add_targets(LimitBuilder& build, const Vec2& origin, double low, double high, int along) {
  for (int y = 0; y < along; ++y) {
    for (int x = 0; x < along; ++x) {
      const double step = (high - low) / (along - 1);
      build.mover(origin + Vec2(low + step * x, low + step * y), 0.4, 1.0);
    }
  }
}

}  // namespace

void add_rooms(LimitBuilder& build, const Vec2& origin, std::span<const double> thicknesses) {
  std::size_t walls = 0;
  for (int line = 0; line <= 4; ++line) {
    for (int k = 0; k < 4; ++k) {
      const double at = room_side * line, from = room_side * k, door = from + 6.0;
      for (const auto& [a, b] : {std::pair(from, door), std::pair(door + 2.0, from + room_side)}) {
        const double thickness = thicknesses[walls++ % thicknesses.size()];
        build.wall(origin + Vec2(a, at), origin + Vec2(b, at), thickness);
        build.wall(origin + Vec2(at, a), origin + Vec2(at, b), thickness);
      }
    }
  }
  add_targets(build, origin, 3.0, 77.0, 8);
}

LimitWorld rooms_world(const Vec2& origin, std::span<const double> thicknesses, int dimension) {
  LimitBuilder build(dimension);
  add_rooms(build, origin, thicknesses);
  for (int f = 0; f < 4; ++f) {
    LimitFrame& frame = build.frame(0.1 * f);
    for (ViewerId v = 0; v < 4; ++v) {
      const Vec2 place(10.0 + room_side * v + 0.3 * f, 10.0 + room_side * (3 - v));
      frame.views.push_back(build.viewer(origin + place, v));
    }
  }
  return build.finish(1.0);
}

Vec2 crowd_place(int k, int count) {
  const int along = crowd_side(count);
  return {0.1 + 1.8 * (k % along + 0.5) / along, 0.1 + 1.8 * (k / along + 0.5) / along};
}

double crowd_radius(int count) { return 0.9 / crowd_side(count); }

void add_crowd(LimitBuilder& build, int count) {
  build.building({-6.0, 0.0}, {4.0, 10.0});
  build.building({20.0, 0.0}, {6.0, 30.0});
  for (int k = 0; k < count; ++k) build.mover(crowd_place(k, count), crowd_radius(count), 1.0);
}

LimitWorld approach_world(const Vec2& origin, std::span<const double> gaps, int dimension) {
  LimitBuilder build(dimension);
  build.building(origin + Vec2(20.0, 20.0), {10.0, 10.0});
  build.building(origin + Vec2(40.0, 20.0), {4.0, 12.0});
  build.wall(origin + Vec2(20.0, 40.0), origin + Vec2(30.0, 46.0), 0.0);
  add_targets(build, origin, -9.0, 59.0, 9);
  for (std::size_t f = 0; f < gaps.size(); ++f) {
    const double frame_number = static_cast<double>(f), gap = gaps[f];
    LimitFrame& frame = build.frame(0.1 * frame_number);
    frame.views.push_back(build.viewer(origin + Vec2(25.0 + gap, 25.0 + gap), 0));
    frame.views.push_back(build.viewer(origin + Vec2(15.0 - gap, 19.0 + 0.25 * frame_number), 1));
    frame.views.push_back(build.viewer(origin + Vec2(42.0 + gap, 26.0), 2));
    frame.views.push_back(build.viewer(origin + Vec2(20.0, 40.0 - gap), 3));
  }
  return build.finish(1.0);
}

LimitWorld gap_world(const Vec2& origin, double gap, int dimension) {
  LimitBuilder build(dimension);
  build.building(origin + Vec2(-25.0 - 0.5 * gap, 0.0), {50.0, 6.0});
  build.building(origin + Vec2(25.0 + 0.5 * gap, 0.0), {50.0, 6.0});
  for (int k = -12; k <= 12; ++k) build.mover(origin + Vec2(1.5 * k, 20.0), 0.5, 1.0);
  for (int f = 0; f < 4; ++f) {
    LimitFrame& frame = build.frame(0.1 * f);
    for (ViewerId v = 0; v < 3; ++v) {
      frame.views.push_back(build.viewer(origin + Vec2(2.0 * v - 1.0 + 0.25 * f, -15.0), v));
    }
  }
  return build.finish(1.0);
}

void look_towards(View& view, double heading, double degrees, int dimension) {
  view.pose.orientation = turn_about_z(heading);
  if (dimension == 2) view.fov = std::min(radians(degrees), 2.0 * std::numbers::pi);
  if (dimension == 3 && degrees < 180.0) view.frustum = Frustum{.fov_y = radians(degrees), .aspect = 1.0};
}

}  // namespace gridcull
