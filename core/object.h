// An object of the world.
#pragma once

#include <optional>

#include "gridcull/core/ids.h"
#include "gridcull/core/pose.h"
#include "gridcull/core/shape.h"

namespace gridcull {

struct Object {
  ObjectId id = no_id;
  Shape shape = Disc{1.0};
  Pose pose{};
  /// Metres a second, >= 0; without it the object gets no temporal bounding volume.
  std::optional<double> max_speed{};
  bool occluder = true;    ///< false: can be seen, never hides
  bool is_static = false;  ///< true: discretised once, moved only by an explicit move()
};

}  // namespace gridcull
