// The moving world: current objects and viewers, a frame at a time.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "gridcull/sim/frames.h"
#include "gridcull/sim/scene.h"

namespace gridcull {

class World {
 public:
  /// Throws Error(bad_scene) for an id twice and for a viewer that follows an object that is not there.
  explicit World(const Scene& scene);

  /// Applies remove, add, set, drop_viewers and viewers in that order. Throws Error(bad_frame) or
  /// Error(unknown_object) and then changes nothing.
  ///
  /// A viewer update may name a `follows` that is not there only if the viewer follows that object already.
  /// A viewer that ends `follows` by a position and has no direction of its own looks along +x.
  void apply(const Frame& frame);

  int dimension() const { return dimension_; }
  /// The last frame's time; none before the first.
  std::optional<double> time() const { return time_; }

  /// All objects, contiguous, in no particular order; valid until the next apply().
  std::span<const Object> objects() const { return objects_; }
  bool has(ObjectId id) const { return index_.contains(id); }
  /// Throws Error(unknown_object).
  const Object& object(ObjectId id) const;
  /// The object that the last applied frame's i-th move named; valid until the next apply().
  const Object& set_object(std::size_t i) const { return objects_[set_places_[i]]; }

  /// The viewers' questions in viewer-id order. A viewer whose object is gone is left out until it is back.
  std::vector<View> views() const;
  /// The same into a buffer that is reused.
  void views(std::vector<View>& out) const;
  /// All viewers, those whose object is gone included.
  std::size_t viewer_count() const { return viewers_.size(); }

 private:
  struct Plan;
  void find_set(const Frame& frame);
  void move_objects(const Frame& frame);
  void check_objects(const Frame& frame, Plan& plan) const;
  void check_moves(const Frame& frame, Plan& plan) const;
  bool same_place(std::size_t i, ObjectId id) const {
    return i < set_places_.size() && set_places_[i] < ids_.size() && ids_[set_places_[i]] == id;
  }
  void check_viewers(const Frame& frame, Plan& plan) const;
  void check_viewpoints(const Frame& frame, Plan& plan) const;
  Pose pose_after(ObjectId id, const Frame& frame) const;
  bool has_after(ObjectId id, const Plan& plan) const;
  void insert(const Object& object);
  void erase(ObjectId id);

  int dimension_;
  std::optional<double> time_{};
  std::vector<Object> objects_{};
  std::vector<ObjectId> ids_{};  ///< of objects_, close together: each move of a frame looks its own up
  std::unordered_map<ObjectId, std::size_t> index_{};  ///< id -> place in objects_; looked up, never walked
  std::map<ViewerId, SceneViewer> viewers_{};
  // No viewpoint can leave the world's 1e9 m while their sum does not; both only grow.
  double farthest_object_ = 0.0, longest_offset_ = 0.0;  ///< metres
  std::vector<std::size_t> set_places_{};                ///< in objects_, of the last frame's moves
};

}  // namespace gridcull
