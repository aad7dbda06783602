#include "gridcull/grid/grid_world.h"

#include <cmath>
#include <string>

#include "gridcull/core/error.h"

namespace gridcull {

void check_pose(const Pose& pose, ObjectId object) {
  const Vec3& p = pose.position;
  const Quat& q = pose.orientation;
  const double length = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
  if (!(std::fabs(p.x) <= 1e9 && std::fabs(p.y) <= 1e9 && std::fabs(p.z) <= 1e9)) {
    throw Error(ErrorCode::bad_frame,
                "object " + std::to_string(object) + ": expected a finite position of magnitude at most 1e9");
  }
  if (!(std::fabs(length - 1.0) <= 1e-6)) {
    throw Error(ErrorCode::bad_frame, "object " + std::to_string(object) + ": expected an orientation of length 1");
  }
}

Pose GridWorld::read(Slot slot) {
  const std::lock_guard lock(reading_);
  ObjectState& state = objects[slot];
  if (state.read_frame != frame) {
    if (source != nullptr) {
      const Pose pose = source->pose(state.id);
      check_pose(pose, state.id);
      state.pose = pose;
    }
    state.read_frame = frame;
    ++positions_read;
  }
  return state.pose;
}

}  // namespace gridcull
