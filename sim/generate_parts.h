// What the generated scenes share.
#pragma once

#include <algorithm>
#include <vector>

#include "gridcull/sim/generate.h"
#include "gridcull/sim/random.h"

namespace gridcull {

inline constexpr double frames_a_second = 30.0;

/// Counts frames and keeps the scene; a kind of scene adds its content and fills its frames.
class GeneratedWorld : public Generator {
 public:
  explicit GeneratedWorld(const GenerateOptions& options, std::uint64_t default_frames)
      : options_(options), random_(options.seed), frame_count_(options.frames.value_or(default_frames)) {}

  const Scene& scene() const final { return scene_; }
  std::uint64_t frame_count() const final { return frame_count_; }
  bool next(Frame& out) final {
    if (next_ == frame_count_) return false;
    out = Frame{};
    out.time = static_cast<double>(next_) / frames_a_second;
    if (next_ > 0) advance(out);
    look(next_, out);
    ++next_;
    return true;
  }

 protected:
  /// Moves everything by one frame into `out.set`.
  virtual void advance(Frame& out) = 0;
  /// Places cameras of their own into `out.viewers`.
  virtual void look(std::uint64_t, Frame&) {}

  /// Adds an object with the next id.
  Object& add(const Shape& shape, const Vec3& position) {
    SceneObject& object = scene_.objects.emplace_back();
    object.object.id = static_cast<ObjectId>(scene_.objects.size() - 1);
    object.object.shape = shape;
    object.object.pose.position = position;
    return object.object;
  }
  /// Viewers on the first `count` of `movers`, all round; ids are the objects'.
  void ride(const std::vector<ObjectId>& movers, std::uint32_t count, const Vec3& offset = Vec3(0.0)) {
    for (std::size_t i = 0; i < std::min<std::size_t>(count, movers.size()); ++i) {
      SceneViewer& viewer = scene_.viewers.emplace_back();
      viewer.id = movers[i];
      viewer.follows = movers[i];
      viewer.pose.position = offset;
      if (options_.range) viewer.range = *options_.range;
    }
  }
  /// A camera: a viewer with a direction of its own and, in 3D, 60 degrees by 16:9.
  void camera(ViewerId id, const Pose& pose);

  GenerateOptions options_;
  Random random_;
  Scene scene_{};

 private:
  std::uint64_t frame_count_;
  std::uint64_t next_ = 0;
};

/// A speed not below `speed` for max_speed: in thousandths, with at least one hundred-thousandth to spare
/// for the rounding of places and times.
double speed_bound(double speed);

/// Turns +x to look along `forward` (length > 0, not vertical) with +z up; no function of the C library
/// but sqrt.
Quat look_along(const Vec3& forward);

/// Moves one coordinate for `seconds` and reflects it at low and high.
void bounce(double& place, double& velocity, double seconds, double low, double high);

/// The middle lines of a two-lane street as a closed loop: out on the right, back on the left, half circles
/// at the ends. Moving on it by some length goes at most that far.
struct LaneLoop {
  Vec2 start{0.0};        ///< where the way out begins
  bool along_x = true;    ///< else along y
  double straight = 0.0;  ///< length of each way, metres
  double gap = 4.0;       ///< between the two ways, metres

  double length() const;
  struct Place {
    Vec2 position;
    double heading;  ///< radians
  };
  /// `way` from the start, 0 <= way < length().
  Place at(double way) const;
};

/// A car on a loop.
struct LoopCar {
  ObjectId id;
  LaneLoop loop;
  double way;    ///< metres along the loop
  double speed;  ///< m/s, > 0
};

void drive(std::vector<LoopCar>& cars, double seconds, double z, Frame& out);

std::unique_ptr<Generator> make_spheres(const GenerateOptions& options);
std::unique_ptr<Generator> make_city(const GenerateOptions& options);
std::unique_ptr<Generator> make_discs(const GenerateOptions& options);
std::unique_ptr<Generator> make_town(const GenerateOptions& options);
std::unique_ptr<Generator> make_maze(const GenerateOptions& options);

}  // namespace gridcull
