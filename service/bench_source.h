// A course's poses for methods that ask for them (pull mode): the simulator's own table, brought up to date before the
// clock runs.
#pragma once

#include <unordered_map>
#include <vector>

#include "gridcull/core/culler.h"
#include "gridcull/service/bench_course.h"
#include "gridcull/sim/scene.h"

namespace gridcull {

class CourseSource final : public PositionSource {
 public:
  explicit CourseSource(const Scene& scene);

  Pose pose(ObjectId object) override { return entries_.at(object).pose; }
  /// The simulator's step to this frame.
  void take(const CourseFrame& frame);
  /// What is told in the frame that was taken last: removes, adds, moves of static objects, and jumps (by Replay's
  /// rule).
  void feed(Culler& culler, const CourseFrame& frame) const;

 private:
  struct Entry {
    Pose pose;
    double max_speed;  ///< below 0: unknown
    bool is_static;
  };
  void add(const Object& object);

  std::unordered_map<ObjectId, Entry> entries_{};
  std::vector<Move> static_moves_{};
  std::vector<ObjectId> jumps_{};
  double time_ = 0.0;
  bool started_ = false;
};

}  // namespace gridcull
