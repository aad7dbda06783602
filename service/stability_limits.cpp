#include <algorithm>
#include <array>
#include <vector>

#include "gridcull/core/pose.h"
#include "gridcull/service/stability_worlds.h"

namespace gridcull {

// The cell is `value` times a building's side.
LimitWorld cell_limit(double value, int dimension) { return quarter_world({.cell = value * building_side}, dimension); }

LimitWorld thickness_limit(double value, int dimension) { return rooms_world({}, {&value, 1}, dimension); }

LimitWorld approach_limit(double value, int dimension) {
  return approach_world({}, std::array{value, value, value}, dimension);
}

LimitWorld gap_limit(double value, int dimension) { return gap_world({}, value, dimension); }

// A view of `value` degrees: about the line of sight in 2D, over the height in 3D, where 360 is all round.
LimitWorld angle_limit(double value, int dimension) {
  LimitWorld world = quarter_world({}, dimension);
  for (LimitFrame& frame : world.frames) {
    for (View& view : frame.views) look_towards(view, 0.4 + 1.3 * view.viewer, value, dimension);
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

LimitWorld crowd_limit(double value, int dimension) {
  LimitBuilder build(dimension);
  add_crowd(build, static_cast<int>(value));
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
  static const std::vector<double> far{0.0, 1e3, 1e5, 1e6, 1e7};
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
      Limit{"flicker", "metres a frame", {1.0, 0.3, 0.1, 3e-2, 1e-2, 1e-3}, &flicker_limit, true},
      // Two at once: what each does alone is above.
      Limit{"far off x thin walls", "metres off, walls of 0 to 1 mm", far, &far_thin_limit},
      Limit{"far off x viewer on a corner", "metres off, 0 to 1e-6 m from it", far, &far_corner_limit},
      Limit{"far off x narrow view", "metres off, views of 0.01 to 30 degrees", far, &far_narrow_limit},
      Limit{"far off x fast", "metres off, 100 times max_speed, 2 s a frame", far, &far_fast_limit},
      Limit{"gap x far off", "metres, a thousand km off", {2.0, 0.1, 1e-3, 1e-6, 1e-9, 0.0}, &far_gap_limit},
      Limit{"small cells x fast", "cell / building, 100 times max_speed", {1.0, 0.5, 0.2, 0.1}, &small_fast_limit},
      Limit{"narrow view x viewer on a face", "degrees", {90.0, 30.0, 5.0, 1.0, 0.1, 1e-2}, &narrow_face_limit},
      Limit{"thin walls x viewer on one", "metres", {1.0, 1e-3, 1e-6, 1e-9, 0.0}, &thin_on_wall_limit},
      Limit{"crowd in a cell x viewer in it", "objects", {1.0, 10.0, 100.0, 1000.0}, &crowd_within_limit}};
  return limits;
}

}  // namespace gridcull
