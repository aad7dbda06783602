#include "gridcull/service/bench_course.h"

#include <algorithm>
#include <set>

namespace gridcull {
namespace {

/// What some frames in a row change, taken together.
class Changes {
 public:
  void take(const Frame& frame) {
    for (const ObjectId id : frame.remove) {
      if (added_.erase(id) == 0) removed_.insert(id);
      moved_.erase(id);
    }
    for (const SceneObject& object : frame.add) added_.insert(object.object.id);
    for (const ObjectMove& move : frame.set) {
      if (!added_.contains(move.id)) moved_.insert(move.id);
    }
  }

  /// `world`: as it stands after them.
  void tell(const World& world, CourseFrame& out) const {
    out.removed.assign(removed_.begin(), removed_.end());
    for (const ObjectId id : added_) out.added.push_back(world.object(id));
    for (const ObjectId id : moved_) out.moved.push_back({id, world.object(id).pose});
  }

 private:
  std::set<ObjectId> removed_{}, added_{}, moved_{};
};

}  // namespace

void feed(Culler& culler, const CourseFrame& frame) {
  for (const ObjectId id : frame.removed) culler.remove(id);
  for (const Object& object : frame.added) culler.add(object);
  culler.move_all(frame.moved);
}

Course::Course(const BenchScene& scene, std::uint64_t frames, std::uint64_t every)
    : source_(scene.frames()), world_(scene.scene), frames_(frames), every_(every) {}

bool Course::read() {
  if (source_) {
    if (!source_->next(frame_)) return false;
  } else if (next_ > 0) {
    return false;
  }
  world_.apply(frame_);
  return true;
}

bool Course::next(CourseFrame& out) {
  if (next_ == frames_) return false;
  out = CourseFrame{};
  if (next_ == 0 || every_ == 1) {
    if (!read()) return false;
    tell(out);
  } else {
    Changes changes;
    for (std::uint64_t i = 0; i < every_; ++i) {
      if (!read()) return false;
      changes.take(frame_);
    }
    changes.tell(world_, out);
  }
  out.number = next_++;
  out.time = frame_.time;
  world_.views(out.views);
  return true;
}

void Course::tell(CourseFrame& out) const {
  out.removed = frame_.remove;
  std::vector<ObjectId> added;
  for (const SceneObject& object : frame_.add) {
    out.added.push_back(world_.object(object.object.id));
    added.push_back(object.object.id);
  }
  std::sort(added.begin(), added.end());
  for (const ObjectMove& move : frame_.set) {
    if (std::binary_search(added.begin(), added.end(), move.id)) continue;
    out.moved.push_back({move.id, world_.object(move.id).pose});
  }
}

}  // namespace gridcull
