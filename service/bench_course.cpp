#include "gridcull/service/bench_course.h"

#include <algorithm>

namespace gridcull {

void feed(Culler& culler, const CourseFrame& frame) {
  for (const ObjectId id : frame.removed) culler.remove(id);
  for (const Object& object : frame.added) culler.add(object);
  for (const auto& [id, pose] : frame.moved) culler.move(id, pose);
}

Course::Course(const BenchScene& scene, std::uint64_t frames)
    : source_(scene.frames()), world_(scene.scene), frames_(frames) {}

bool Course::next(CourseFrame& out) {
  if (next_ == frames_) return false;
  if (source_) {
    if (!source_->next(frame_)) return false;
  } else if (next_ > 0) {
    return false;
  }
  world_.apply(frame_);
  out = CourseFrame{};
  out.number = next_++;
  out.time = frame_.time;
  out.removed = frame_.remove;
  std::vector<ObjectId> added;
  for (const SceneObject& object : frame_.add) {
    out.added.push_back(world_.object(object.object.id));
    added.push_back(object.object.id);
  }
  std::sort(added.begin(), added.end());
  for (const ObjectMove& move : frame_.set) {
    if (std::binary_search(added.begin(), added.end(), move.id)) continue;
    out.moved.emplace_back(move.id, world_.object(move.id).pose);
  }
  world_.views(out.views);
  return true;
}

}  // namespace gridcull
