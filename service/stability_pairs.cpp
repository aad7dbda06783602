// Two limits at once: what is harmless alone may not be so together.
#include <array>
#include <numbers>

#include "gridcull/service/stability_worlds.h"

namespace gridcull {
namespace {

Vec2 off(double metres) { return {metres, -metres}; }

}  // namespace

// Rooms a long way off with walls of 0, 1e-9, 1e-6 and 1e-3 m by turns: at 1e7 m doubles lie 2e-9 m apart.
LimitWorld far_thin_limit(double value, int dimension) {
  return rooms_world(off(value), std::array{0.0, 1e-9, 1e-6, 1e-3}, dimension);
}

// Viewers at corners, on faces and on a thin wall, a hair outside and inside, a long way off.
LimitWorld far_corner_limit(double value, int dimension) {
  return approach_world(off(value), std::array{0.0, 1e-9, -1e-9, 1e-6, -1e-6}, dimension);
}

// Views of 0.01, 0.1, 1 and 30 degrees a long way off.
LimitWorld far_narrow_limit(double value, int dimension) {
  constexpr std::array degrees{0.01, 0.1, 1.0, 30.0};
  LimitWorld world = quarter_world({.origin = off(value)}, dimension);
  for (std::size_t f = 0; f < world.frames.size(); ++f) {
    for (View& view : world.frames[f].views) {
      const double heading = 0.4 + 1.3 * view.viewer + 0.7 * static_cast<double>(f);
      look_towards(view, heading, degrees[view.viewer % degrees.size()], dimension);
    }
  }
  return world;
}

// Movers that jump a kilometre a frame, a long way off.
LimitWorld far_fast_limit(double value, int dimension) {
  return quarter_world({.origin = off(value), .step = 2.0, .speed = 500.0, .max_speed = 5.0, .frames = 12}, dimension);
}

// Two houses with a gap of `value` metres a thousand kilometres off, where doubles lie 1e-10 m apart.
LimitWorld far_gap_limit(double value, int dimension) { return gap_world(off(1e6), value, dimension); }

// Movers that cross hundreds of cells a frame and have told a hundredth of that.
LimitWorld small_fast_limit(double value, int dimension) {
  return quarter_world({.cell = value * building_side, .speed = 500.0, .max_speed = 5.0, .frames = 12}, dimension);
}

// Viewers exactly on faces and corners who look along, into and away from them through a slit of `value` degrees.
LimitWorld narrow_face_limit(double value, int dimension) {
  LimitWorld world = approach_world({}, std::array<double, 8>{}, dimension);
  for (std::size_t f = 0; f < world.frames.size(); ++f) {
    for (View& view : world.frames[f].views) {
      look_towards(view, 0.25 * std::numbers::pi * static_cast<double>(f), value, dimension);
    }
  }
  return world;
}

// Viewers on the middle and on the face of a wall `value` metres thick, at its end in a doorway, and at a crossing.
LimitWorld thin_on_wall_limit(double value, int dimension) {
  LimitBuilder build(dimension);
  add_rooms(build, {}, {&value, 1});
  for (int f = 0; f < 3; ++f) {
    LimitFrame& frame = build.frame(0.1 * f);
    const double wall = room_side * (1 + f);
    frame.views.push_back(build.viewer({3.0 + f, wall}, 0));
    frame.views.push_back(build.viewer({33.0 + f, wall + 0.5 * value}, 1));
    frame.views.push_back(build.viewer({wall - 0.5 * value, 46.0}, 2));
    frame.views.push_back(build.viewer({wall, wall}, 3));
  }
  return build.finish(1.0);
}

// Viewers in the crowd's own cell: within one of its things, at its edge, and between them.
LimitWorld crowd_within_limit(double value, int dimension) {
  LimitBuilder build(dimension);
  const int count = static_cast<int>(value);
  add_crowd(build, count);
  for (int f = 0; f < 4; ++f) {
    LimitFrame& frame = build.frame(0.1 * f);
    const Vec2 place = crowd_place((count / 2 + f) % count, count);
    const double radius = crowd_radius(count);
    frame.views.push_back(build.viewer(place, 0));
    frame.views.push_back(build.viewer(place + Vec2(radius, 0.0), 1));
    frame.views.push_back(build.viewer(place + Vec2(radius, radius), 2));
  }
  return build.finish(2.0);
}

}  // namespace gridcull
