// A world that an engine asks for poses, and a count of who was asked for.
#pragma once

#include <algorithm>
#include <map>
#include <span>
#include <vector>

#include "gridcull/core/culler.h"

namespace gridcull::test {

class ProbedWorld final : public PositionSource {
 public:
  Pose pose(ObjectId object) override {
    ++reads[object];
    return poses.at(object);
  }

  std::map<ObjectId, Pose> poses;
  std::map<ObjectId, int> reads;
};

inline Object make_object(ObjectId id, Shape shape, const Vec3& position, std::optional<double> max_speed = {}) {
  return {id, std::move(shape), {position}, max_speed};
}

inline Object make_static(ObjectId id, Shape shape, const Vec3& position) {
  Object o = make_object(id, std::move(shape), position);
  o.is_static = true;
  return o;
}

inline View make_view(ViewerId id, const Vec3& position) {
  View v;
  v.viewer = id;
  v.pose.position = position;
  return v;
}

inline bool sees(const Answer& answer, ObjectId id) {
  return std::binary_search(answer.visible.begin(), answer.visible.end(), id);
}

}  // namespace gridcull::test
