// The world as a method without a grid of its own keeps it: objects in one row, with world boxes and balls.
//
// What every method must do alike is done here once: ids that are there or not, push and pull, the checks of a frame,
// and that a call that throws leaves everything as it was. All moving objects are read in every frame.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "gridcull/core/bounding_volume.h"
#include "gridcull/core/bounds.h"
#include "gridcull/core/culler.h"
#include "gridcull/methods/local_shape.h"

namespace gridcull {

struct FlatObject {
  Object object{};
  LocalShape local{};
  std::shared_ptr<const BoundingVolume> bound{};  ///< where the world was asked for one
  Rotation rotation{};
  Vec3 centre{0.0};     ///< of the shape's local box, in the world
  double radius = 0.0;  ///< about `centre`: holds the object
  Bounds box{};         ///< world axes: holds the object
};

class FlatWorld {
 public:
  /// `bound`: the volume that objects get besides; none unless asked for.
  explicit FlatWorld(int dimension, std::optional<BoundKind> bound = {}) : dimension_(dimension), bound_(bound) {}

  // As Culler's.
  void add(const Object& object);
  void remove(ObjectId object);
  void move(ObjectId object, const Pose& pose);
  void set_source(PositionSource* source) { source_ = source; }
  void announce_jump(ObjectId object) const { (void)slot(object); }

  /// Checks time and views, then reads the poses of all moving objects where there is a source. Throws
  /// Error(bad_frame) or what the source throws, and then has changed nothing.
  void begin_frame(double time, std::span<const View> views, FrameStats& stats);

  int dimension() const { return dimension_; }
  static constexpr std::uint32_t nowhere = 0xFFFF'FFFFu;
  /// The object's place in objects(), or nowhere.
  std::uint32_t find(ObjectId object) const;
  /// In no particular order; places change with add() and remove() only.
  std::span<const FlatObject> objects() const { return objects_; }
  /// Grows when a static object is added, removed or moved.
  std::uint64_t static_version() const { return static_version_; }
  /// Grows when a moving object is.
  std::uint64_t moving_version() const { return moving_version_; }
  /// Grows when any object is added or removed.
  std::uint64_t set_version() const { return set_version_; }

  /// Appends the places in objects() of those among `candidates` whose open interior holds the point.
  void add_holders(const Vec3& point, std::span<const std::uint32_t> candidates, std::vector<std::uint32_t>& out) const;

 private:
  static constexpr std::uint32_t low_ids = 1u << 22;

  std::uint32_t slot(ObjectId object) const;  ///< throws unknown_object
  void set_slot(ObjectId object, std::uint32_t place);
  void place(FlatObject& flat, const Pose& pose) const;
  void touch(const FlatObject& flat) { ++(flat.object.is_static ? static_version_ : moving_version_); }

  int dimension_;
  std::optional<BoundKind> bound_;
  std::vector<FlatObject> objects_{};
  // Ids are mostly small: a table for those, a map for the rest.
  std::vector<std::uint32_t> low_{};
  std::unordered_map<ObjectId, std::uint32_t> high_{};
  std::vector<Pose> poses_{};
  PositionSource* source_ = nullptr;
  std::uint64_t static_version_ = 1, moving_version_ = 1, set_version_ = 1;
  std::uint64_t movers_ = 0;
  double now_ = 0.0;
  bool started_ = false;
};

}  // namespace gridcull
