#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "gridcull/core/pose.h"
#include "gridcull/service/stability_worlds.h"

namespace gridcull {
namespace {

constexpr double building_side = 11.0;  // metres, mean of quarter_world()

double radians(double degrees) { return degrees * (std::numbers::pi / 180.0); }

/// Targets on a grid about the middle of a square.
void add_targets(LimitBuilder& build, double low, double high, int along) {
  for (int y = 0; y < along; ++y) {
    for (int x = 0; x < along; ++x) {
      const double step = (high - low) / (along - 1);
      build.mover({low + step * x, low + step * y}, 0.4, 1.0);
    }
  }
}

}  // namespace

// The cell is `value` times a building's side.
LimitWorld cell_limit(double value, int dimension) { return quarter_world({.cell = value * building_side}, dimension); }

// 4 x 4 rooms of 20 m with a door of 2 m in each wall, four things in each.
LimitWorld thickness_limit(double value, int dimension) {
  LimitBuilder build(dimension);
  constexpr double room = 20.0;
  for (int line = 0; line <= 4; ++line) {
    for (int k = 0; k < 4; ++k) {
      const double at = room * line, from = room * k, door = from + 6.0;
      for (const auto& [a, b] : {std::pair(from, door), std::pair(door + 2.0, from + room)}) {
        build.wall({a, at}, {b, at}, value);
        build.wall({at, a}, {at, b}, value);
      }
    }
  }
  add_targets(build, 3.0, 77.0, 8);
  for (int f = 0; f < 4; ++f) {
    LimitFrame& frame = build.frame(0.1 * f);
    for (ViewerId v = 0; v < 4; ++v) {
      frame.views.push_back(build.viewer({10.0 + room * v + 0.3 * f, 10.0 + room * (3 - v)}, v));
    }
  }
  return build.finish(1.0);
}

// Somebody `value` metres before a corner, a face and a smaller wall of a building; below 0: inside it.
LimitWorld approach_limit(double value, int dimension) {
  LimitBuilder build(dimension);
  build.building({20.0, 20.0}, {10.0, 10.0});
  build.building({40.0, 20.0}, {4.0, 12.0});
  build.wall({20.0, 40.0}, {30.0, 46.0}, 0.0);
  add_targets(build, -9.0, 59.0, 9);
  for (int f = 0; f < 3; ++f) {
    LimitFrame& frame = build.frame(0.1 * f);
    frame.views.push_back(build.viewer({25.0 + value, 25.0 + value}, 0));
    frame.views.push_back(build.viewer({15.0 - value, 19.0 + 0.25 * f}, 1));
    frame.views.push_back(build.viewer({42.0 + value, 26.0}, 2));
    frame.views.push_back(build.viewer({20.0, 40.0 - value}, 3));
  }
  return build.finish(1.0);
}

// Two long walls of houses with a gap between them, and a row of things to be seen through it.
LimitWorld gap_limit(double value, int dimension) {
  LimitBuilder build(dimension);
  build.building({-25.0 - 0.5 * value, 0.0}, {50.0, 6.0});
  build.building({25.0 + 0.5 * value, 0.0}, {50.0, 6.0});
  for (int k = -12; k <= 12; ++k) build.mover({1.5 * k, 20.0}, 0.5, 1.0);
  for (int f = 0; f < 4; ++f) {
    LimitFrame& frame = build.frame(0.1 * f);
    for (ViewerId v = 0; v < 3; ++v) frame.views.push_back(build.viewer({2.0 * v - 1.0 + 0.25 * f, -15.0}, v));
  }
  return build.finish(1.0);
}

// A view of `value` degrees: about the line of sight in 2D, over the height in 3D, where 360 is all round.
LimitWorld angle_limit(double value, int dimension) {
  LimitWorld world = quarter_world({}, dimension);
  for (LimitFrame& frame : world.frames) {
    for (View& view : frame.views) {
      view.pose.orientation = turn_about_z(0.4 + 1.3 * view.viewer);
      if (dimension == 2) view.fov = std::min(radians(value), 2.0 * std::numbers::pi);
      if (dimension == 3 && value < 180.0) view.frustum = Frustum{.fov_y = radians(value), .aspect = 1.0};
    }
  }
  return world;
}

// The whole world `value` metres from the origin.
LimitWorld origin_limit(double value, int dimension) { return quarter_world({.origin = {value, -value}}, dimension); }

// Movers at `value` times the speed that they call their greatest.
LimitWorld speed_limit(double value, int dimension) {
  return quarter_world({.speed = 5.0 * value, .max_speed = 5.0, .frames = 12}, dimension);
}

// `value` seconds a frame, movers at their greatest speed.
LimitWorld step_limit(double value, int dimension) {
  return quarter_world({.step = value, .speed = 5.0, .max_speed = 5.0, .frames = 12}, dimension);
}

// So many things in one cell of 2 m, a building beside them and one behind.
LimitWorld crowd_limit(double value, int dimension) {
  LimitBuilder build(dimension);
  build.building({-6.0, 0.0}, {4.0, 10.0});
  build.building({20.0, 0.0}, {6.0, 30.0});
  const int count = static_cast<int>(value), along = static_cast<int>(std::ceil(std::sqrt(value)));
  for (int k = 0; k < count; ++k) {
    build.mover({0.1 + 1.8 * (k % along + 0.5) / along, 0.1 + 1.8 * (k / along + 0.5) / along}, 0.9 / along, 1.0);
  }
  for (int f = 0; f < 4; ++f) {
    LimitFrame& frame = build.frame(0.1 * f);
    frame.views.push_back(build.viewer({-15.0, 0.5 + 0.5 * f}, 0));
    frame.views.push_back(build.viewer({8.0, -9.0}, 1));
  }
  return build.finish(2.0);
}

// One viewer that walks `value` metres a frame through a quarter where nothing else moves.
LimitWorld flicker_limit(double value, int dimension) {
  LimitWorld world = quarter_world({.frames = 30}, dimension);
  for (std::size_t f = 0; f < world.frames.size(); ++f) {
    LimitFrame& frame = world.frames[f];
    frame.moved.clear();
    frame.views.resize(1);
    frame.views[0].pose.position.x += value * static_cast<double>(f);
    frame.views[0].pose.position.y += 0.37 * value * static_cast<double>(f);
  }
  return world;
}

std::span<const Limit> stability_limits() {
  static const std::array limits{
      Limit{"cell size", "cell / building", {0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0}, &cell_limit},
      Limit{"wall thickness", "metres", {2.0, 1.0, 0.3, 0.1, 1e-2, 1e-4, 0.0}, &thickness_limit},
      Limit{"viewer to a surface",
            "metres; below 0 inside",
            {1.0, 0.1, 1e-3, 1e-6, 1e-9, 0.0, -1e-9, -1e-6, -1e-3, -0.1, -1.0},
            &approach_limit},
      Limit{"gap between occluders", "metres", {2.0, 0.5, 0.1, 1e-2, 1e-3, 1e-4, 1e-6, 0.0}, &gap_limit},
      Limit{"view angle", "degrees", {360.0, 179.9, 179.0, 90.0, 30.0, 5.0, 1.0, 0.1, 1e-2}, &angle_limit},
      Limit{"distance from the origin", "metres", {0.0, 1e3, 1e4, 1e5, 1e6, 1e7}, &origin_limit},
      Limit{"speed", "of max_speed", {0.0, 0.5, 0.99, 1.0, 1.01, 2.0, 10.0, 100.0}, &speed_limit},
      Limit{"frame step", "seconds", {0.01, 0.1, 0.5, 1.0, 2.0, 5.0, 10.0}, &step_limit},
      Limit{"objects in one cell", "objects", {1.0, 10.0, 100.0, 1000.0}, &crowd_limit},
      Limit{"flicker", "metres a frame", {1.0, 0.3, 0.1, 3e-2, 1e-2, 1e-3}, &flicker_limit, true}};
  return limits;
}

}  // namespace gridcull
