// A scene's frames as every contender is given them: read once, kept for a short run, the same for all.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "gridcull/core/culler.h"
#include "gridcull/service/bench_scene.h"
#include "gridcull/sim/world.h"

namespace gridcull {

/// What a simulator tells in one frame, and what it asks.
struct CourseFrame {
  std::uint64_t number = 0;
  double time = 0.0;  ///< seconds
  std::vector<ObjectId> removed{};
  std::vector<Object> added{};  ///< as they stand at the end of the frame
  std::vector<std::pair<ObjectId, Pose>> moved{};
  std::vector<View> views{};
};

/// Removes, adds and moves, as a simulator pushes them.
void feed(Culler& culler, const CourseFrame& frame);

class Course {
 public:
  /// At most `frames` frames. Outlived by the scene.
  Course(const BenchScene& scene, std::uint64_t frames);

  /// Reads on by one frame; false at the end. What a frame is made of is taken into `out`.
  bool next(CourseFrame& out);
  /// The world as it stands after the last frame.
  const World& world() const { return world_; }

 private:
  std::unique_ptr<FrameSource> source_;
  World world_;
  Frame frame_{};
  std::uint64_t next_ = 0, frames_;
};

}  // namespace gridcull
