// The world as shadow frusta need it: convex parts of occluders, and hierarchies of boxes over all objects.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "gridcull/methods/box_tree.h"
#include "gridcull/methods/flat_world.h"
#include "gridcull/methods/occluder_part.h"

namespace gridcull {

/// A part of an object of the world that may be chosen as an occluder.
struct PartEntry {
  const OccluderPart* part = nullptr;
  std::uint32_t place = 0;  ///< of its object in the world
  ObjectId object = no_id;
  std::uint32_t number = 0;  ///< among the object's parts

  std::uint64_t key() const { return std::uint64_t{object} << 32 | number; }
};

class ShadowWorld {
 public:
  /// `bound`: what objects are tested with; none: their own outlines.
  explicit ShadowWorld(int dimension, std::optional<BoundKind> bound = {}) : world_(dimension, bound) {}

  // As Culler's.
  void add(const Object& object);
  void remove(ObjectId object);
  void move(ObjectId object, const Pose& pose) { world_.move(object, pose); }
  void set_source(PositionSource* source) { world_.set_source(source); }
  void announce_jump(ObjectId object) const { world_.announce_jump(object); }

  /// FlatWorld's, then boxes and trees are brought up to date.
  void begin_frame(double time, std::span<const View> views, FrameStats& stats);

  const FlatWorld& flat() const { return world_; }
  int dimension() const { return world_.dimension(); }
  const FlatObject& object(std::uint32_t place) const { return world_.objects()[place]; }
  /// By place: hold the objects, the roundings of their world points included.
  std::span<const Bounds> boxes() const { return boxes_; }
  /// What the object is tested with, in the world; null where its own outline is.
  const PlacedBound* bound(std::uint32_t place) const { return bounds_.empty() ? nullptr : &bounds_[place]; }
  const BoxTree& static_tree() const { return static_tree_; }
  const BoxTree& moving_tree() const { return moving_tree_; }

  /// Of all occluders: those of static ones first, each by object and number.
  std::span<const PartEntry> entries() const { return entries_; }
  std::span<const PartEntry> static_entries() const { return entries().first(static_count_); }
  std::uint32_t static_count() const { return static_cast<std::uint32_t>(static_count_); }
  /// From `eye` to the middle of the part.
  Vec3 sight_of(const PartEntry& entry, const Vec3& eye) const;
  /// area_angle() as seen from `eye`.
  double area_angle_of(const PartEntry& entry, const Vec3& eye) const;
  /// Grow when entries have other numbers; when a static object is another or elsewhere.
  std::uint64_t entries_version() const { return set_version_; }
  std::uint64_t static_version() const { return static_version_; }

 private:
  void list_entries();
  void place_boxes(bool is_static);
  Bounds box_of(std::uint32_t place) const;
  void build_tree(bool is_static, BoxTree& tree);

  FlatWorld world_;
  std::unordered_map<ObjectId, std::vector<OccluderPart>> parts_{};
  std::uint64_t set_version_ = 0, static_version_ = 0, moving_version_ = 0;
  std::vector<PartEntry> entries_{};
  std::size_t static_count_ = 0;
  std::vector<Bounds> boxes_{};
  std::vector<PlacedBound> bounds_{};  ///< by place, where the world was asked for them
  std::vector<BoxTree::Item> items_{};
  BoxTree static_tree_{}, moving_tree_{};
};

}  // namespace gridcull
