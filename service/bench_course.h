// A scene's frames as every contender is given them: read once, kept for a short run, the same for all.
#pragma once

#include <cstdint>
#include <memory>
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
  std::vector<Move> moved{};
  std::vector<View> views{};
};

/// Removes, adds and moves, as a simulator pushes them.
void feed(Culler& culler, const CourseFrame& frame);

class Course {
 public:
  /// The scene's frames 0, `every`, 2 `every` ... (1 or more), at most `frames` of them; what happens between two is
  /// told with the second, as by a simulator that asks more seldom. Outlived by the scene.
  Course(const BenchScene& scene, std::uint64_t frames, std::uint64_t every = 1);

  /// Reads on to the next of them; false at the end. `number` counts them, not the scene's frames.
  bool next(CourseFrame& out);
  /// The world as it stands after the last frame.
  const World& world() const { return world_; }

 private:
  bool read();
  /// Of one frame.
  void tell(CourseFrame& out) const;

  std::unique_ptr<FrameSource> source_;
  World world_;
  Frame frame_{};
  std::uint64_t next_ = 0, frames_, every_;
};

}  // namespace gridcull
