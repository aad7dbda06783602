// Whether an object of a FlatWorld may touch a view volume: as ViewVolume::may_touch(), without its cost for objects
// that lie wholly inside or outside.
#pragma once

#include <cmath>

#include "gridcull/core/view_volume.h"
#include "gridcull/methods/flat_world.h"

namespace gridcull {

class ViewTest {
 public:
  /// Throws Error(bad_frame) as ViewVolume does.
  ViewTest(const View& view, int dimension)
      : volume_(view, dimension),
        depths_(view.frustum && (view.frustum->near > 0.0 || std::isfinite(view.frustum->far))) {}

  const ViewVolume& volume() const { return volume_; }

  /// Exactly ViewVolume::may_touch() of the object. Allocates where the volume's border runs through a shape that is
  /// not round.
  bool may_touch(const FlatObject& flat) const {
    if (!volume_.may_touch_ball(flat.centre, flat.radius)) return false;
    return (!depths_ && ball_inside(flat)) || volume_.may_touch(flat.object.shape, flat.object.pose);
  }

 private:
  bool ball_inside(const FlatObject& flat) const {
    const Vec3 d = flat.centre - volume_.apex();
    if (std::isfinite(volume_.range()) && glm::length(d) + flat.radius > volume_.range()) return false;
    if (volume_.all_round()) return true;
    for (const HalfSpace& side : volume_) {
      const bool inside = glm::dot(side.normal, d) > flat.radius;
      if (inside != volume_.convex()) return inside;
    }
    return volume_.convex();
  }

  ViewVolume volume_;
  bool depths_;
};

}  // namespace gridcull
