// The contract of visibility: what every method answers, and which way it may err.
//
// Truth. An object X is *visible* from viewpoint v when some point p of X lies in the view volume and the
// open segment v-p meets the interior of no occluder other than X (for thin shapes: crosses no wall or
// face of it). Touching an edge does not hide. Visible means with positive angular width (2D) or solid
// angle (3D); a line of sight through a single shared corner may be answered either way.
// An object whose interior holds the viewpoint is always reported and never occludes for that viewer.
// A viewer that rides on an object never reports it, and that object never occludes for that viewer.
// Objects beyond the range or outside the view volume may still occlude what is inside.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "gridcull/core/ids.h"
#include "gridcull/core/object.h"
#include "gridcull/core/view.h"

namespace gridcull {

/// Which way a method's answer may err.
enum class Guarantee {
  conservative,  ///< holds every visible object, always; may hold more
  sampled        ///< may miss; its misses are counted and charted
};

/// An object and where it is from now on.
struct Move {
  ObjectId object = no_id;
  Pose pose{};
};

/// Where a pull-mode simulator is asked for positions. An object is read at most once a frame. Calls come
/// from one thread at a time, but not always the same one, and must not call the culler that asks.
class PositionSource {
 public:
  virtual ~PositionSource() = default;
  /// The object's pose at the current frame's time.
  virtual Pose pose(ObjectId object) = 0;
};

/// Work of one viewer's query. Counts do not depend on the machine, so tests can assert them.
struct WorkCounts {
  std::uint64_t cells_visited = 0;  ///< cells of the view volume that were not hidden
  std::uint64_t cells_hidden = 0;   ///< cells marked hidden by occlusion
  std::uint64_t object_tests = 0;   ///< (cell group, object) pairs looked at
  std::uint64_t occluders = 0;      ///< extended occluders (2D legs, 3D caps)
  std::uint64_t rasters = 0;        ///< rows or runs rasterised as hidden
  std::uint64_t tbv_tests = 0;      ///< temporal bounding volumes looked at
  std::uint64_t tbv_revealed = 0;   ///< temporal bounding volumes found visible
};

/// One viewer's potentially visible set.
struct Answer {
  ViewerId viewer = no_id;
  std::vector<ObjectId> visible;  ///< ascending
  WorkCounts work{};
};

/// Work and time of one frame over all viewers.
struct FrameStats {
  std::uint64_t positions_read = 0;  ///< poses the method used in this frame: its output sensitivity
  std::uint64_t tbv_active = 0;      ///< temporal bounding volumes alive at the end of the frame
  std::uint64_t tbv_revealed = 0;
  std::uint64_t tbv_expired = 0;
  std::uint64_t jumps = 0;  ///< moves beyond max_speed, accepted and handled
  // Microseconds of wall clock, summed over threads.
  double discretise_us = 0;
  double traverse_us = 0;
  double occlude_us = 0;
  double collect_us = 0;
  double total_us = 0;  ///< wall clock of the frame
};

struct Answers {
  std::vector<Answer> views;  ///< in the order of the views asked
  FrameStats stats{};
};

/// What a method is and takes.
struct MethodInfo {
  std::string_view name;
  std::string_view summary;  ///< one line, with paper and section
  Guarantee guarantee = Guarantee::conservative;
  bool takes_2d = true;
  bool takes_3d = true;
  bool moving_occluders = true;  ///< false: movers are treated as occludees only
};

/// A visibility method over one world. A frame is: remove, add and move in that order, then one query().
/// No two calls may overlap. Every function throws Error and then leaves the culler as it was.
class Culler {
 public:
  virtual ~Culler() = default;

  virtual const MethodInfo& info() const = 0;

  /// Throws bad_scene for a wrong dimension, an invalid shape or an id that is there already.
  virtual void add(const Object& object) = 0;
  /// Throws unknown_object.
  virtual void remove(ObjectId object) = 0;
  /// Push: tells the object's pose from now on. Static objects may be moved too. A move beyond max_speed
  /// is accepted, handled as a jump and counted. Throws unknown_object.
  virtual void move(ObjectId object, const Pose& pose) = 0;
  /// Push: the same for many, as if told one by one in this order. One that is refused refuses them all: throws what
  /// move() throws for the first such, and none is told. (This default, for cullers that refuse nothing, tells one
  /// after another; methods check first.)
  virtual void move_all(std::span<const Move> moves) {
    for (const Move& m : moves) move(m.object, m.pose);
  }

  /// Pull: from now on poses of moving objects come from `source`, which outlives its use; hidden objects
  /// are looked at again. nullptr: back to push; then every moving object must be pushed once, since poses that
  /// nobody asked for are out of date.
  /// Methods that need all poses anyway read all.
  virtual void set_source(PositionSource* source) = 0;
  /// Pull: the object moves beyond its max_speed in this frame. Throws unknown_object.
  virtual void announce_jump(ObjectId object) = 0;

  /// Answers all views at time `time` (seconds, greater than the last frame's; throws bad_frame).
  /// `out` is reused: a steady frame allocates nothing.
  virtual void query(double time, std::span<const View> views, Answers& out) = 0;
};

}  // namespace gridcull
