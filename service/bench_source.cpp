#include "gridcull/service/bench_source.h"

namespace gridcull {

CourseSource::CourseSource(const Scene& scene) {
  entries_.reserve(scene.objects.size());
  for (const SceneObject& object : scene.objects) add(object.object);
}

void CourseSource::add(const Object& object) {
  entries_[object.id] = {object.pose, object.max_speed.value_or(-1.0), object.is_static};
}

void CourseSource::take(const CourseFrame& frame) {
  static_moves_.clear();
  jumps_.clear();
  for (const ObjectId id : frame.removed) entries_.erase(id);
  for (const Object& object : frame.added) add(object);
  for (const Move& move : frame.moved) {
    Entry& entry = entries_.at(move.object);
    const double way = glm::length(move.pose.position - entry.pose.position);
    entry.pose = move.pose;
    if (entry.is_static) {
      static_moves_.push_back(move);
    } else if (started_ && entry.max_speed >= 0.0 && way > entry.max_speed * (frame.time - time_) * (1.0 + 1e-9)) {
      jumps_.push_back(move.object);
    }
  }
  time_ = frame.time;
  started_ = true;
}

void CourseSource::feed(Culler& culler, const CourseFrame& frame) const {
  for (const ObjectId id : frame.removed) culler.remove(id);
  for (const Object& object : frame.added) culler.add(object);
  for (const ObjectId id : jumps_) culler.announce_jump(id);
  culler.move_all(static_moves_);
}

}  // namespace gridcull
