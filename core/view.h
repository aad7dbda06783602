// One viewer's question for one frame.
#pragma once

#include <limits>
#include <numbers>
#include <optional>

#include "gridcull/core/ids.h"
#include "gridcull/core/pose.h"

namespace gridcull {

/// 3D view pyramid: looks along local +x, +z is up.
struct Frustum {
  double fov_y = std::numbers::pi / 3;  ///< radians, full angle over the height, 0 < fov_y < pi
  double aspect = 1.0;                  ///< width / height, 1e-6 .. 1e6
  double near = 0.0;                    ///< planar depth, >= 0; nearer things are not seen but still occlude
  double far = std::numeric_limits<double>::infinity();  ///< planar depth, > near
};

/// Who looks, from where, how far. The view volume is the set of points within `range` (Euclidean) and,
/// in 2D, within `fov` about the local +x axis, in 3D inside `frustum` if there is one.
struct View {
  ViewerId viewer = no_id;
  Pose pose{};
  double range = std::numeric_limits<double>::infinity();  ///< metres, > 0
  double fov = 2.0 * std::numbers::pi;                     ///< 2D: radians, full angle, 0 < fov <= 2 pi
  std::optional<Frustum> frustum{};                        ///< 3D: none means all directions
  ObjectId rides = no_id;  ///< the object it rides on: never reported to it, never hides from it
};

}  // namespace gridcull
