// Replay: feeds a culler with a scene and its frames.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gridcull/core/culler.h"
#include "gridcull/sim/frames.h"
#include "gridcull/sim/world.h"

namespace gridcull {

enum class Feed {
  push,  ///< every move is told
  pull   ///< the culler asks for the poses of moving objects that it needs
};

/// One step per frame. Pull mode: static objects are moved by move() all the same; an object that goes
/// farther than max_speed * (time since the last frame) * (1 + 1e-9) is announced as a jump, the rule that
/// an engine applies to pushed moves.
class Replay final : private PositionSource {
 public:
  /// Adds the scene's objects to `culler`, which holds none yet. `frames` may be nullptr: then there is
  /// one frame at time 0. Both outlive the replay. Throws what World and Culler throw.
  Replay(Culler& culler, const Scene& scene, FrameSource* frames, Feed feed = Feed::push);
  ~Replay() override;
  Replay(const Replay&) = delete;
  Replay& operator=(const Replay&) = delete;

  /// Takes the next frame and asks for its answers; false when there is none left. When it throws, the
  /// replay is over: a refused frame has changed neither world nor culler, a refusing culler may hold
  /// part of the frame.
  bool step();

  /// Number of the frame that the next step() takes, from 0 (so a drawing can be asked for beforehand).
  std::uint64_t next_frame() const { return next_frame_; }
  /// Of the last step:
  std::uint64_t frame() const { return next_frame_ - 1; }
  double time() const { return world_.time().value_or(0.0); }
  const Frame& last_frame() const { return current_; }
  const World& world() const { return world_; }
  std::span<const View> views() const { return views_; }
  const Answers& answers() const { return answers_; }

 private:
  Pose pose(ObjectId object) override;
  bool take_frame();
  void note_places();
  void feed_objects(double seconds);
  void feed_move(const Object& object, const Vec3& before, double seconds);

  Culler& culler_;
  FrameSource* frames_;
  Feed feed_;
  World world_;
  Frame current_{};
  std::uint64_t next_frame_ = 0;
  std::vector<Vec3> before_{};  ///< pull: where stood what current_ moves
  std::vector<Move> moves_{};   ///< push: of the frame in hand; pull: those of static objects
  std::vector<View> views_{};
  Answers answers_{};
};

}  // namespace gridcull
