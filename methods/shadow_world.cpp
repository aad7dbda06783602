#include "gridcull/methods/shadow_world.h"

#include <algorithm>

#include "gridcull/core/world_points.h"
#include "gridcull/methods/shadow_frustum.h"

namespace gridcull {
void ShadowWorld::add(const Object& object) {
  world_.add(object);
  if (!object.occluder) return;
  try {
    parts_[object.id] = make_occluder_parts(object.shape);
  } catch (...) {
    world_.remove(object.id);
    throw;
  }
}

void ShadowWorld::remove(ObjectId object) {
  world_.remove(object);
  parts_.erase(object);
}

void ShadowWorld::begin_frame(double time, std::span<const View> views, FrameStats& stats) {
  world_.begin_frame(time, views, stats);
  const bool new_set = set_version_ != world_.set_version();
  if (new_set) list_entries();
  if (new_set || static_version_ != world_.static_version()) build_tree(true, static_tree_);
  if (new_set) {
    build_tree(false, moving_tree_);
  } else if (moving_version_ != world_.moving_version()) {
    place_boxes(false);
    if (moving_tree_.refit([this](std::uint32_t place) { return boxes_[place]; })) build_tree(false, moving_tree_);
  }
  set_version_ = world_.set_version();
  static_version_ = world_.static_version();
  moving_version_ = world_.moving_version();
}

void ShadowWorld::list_entries() {
  entries_.clear();
  const auto objects = world_.objects();
  for (std::uint32_t place = 0; place < objects.size(); ++place) {
    const auto found = parts_.find(objects[place].object.id);
    if (found == parts_.end()) continue;
    for (std::uint32_t i = 0; i < found->second.size(); ++i) {
      entries_.push_back({&found->second[i], place, objects[place].object.id, i});
    }
  }
  const auto moves = [&](const PartEntry& e) { return !objects[e.place].object.is_static; };
  std::sort(entries_.begin(), entries_.end(), [&](const PartEntry& a, const PartEntry& b) {
    return moves(a) != moves(b) ? moves(b) : a.key() < b.key();
  });
  static_count_ = static_cast<std::size_t>(std::find_if(entries_.begin(), entries_.end(), moves) - entries_.begin());
  boxes_.resize(objects.size());
  if (!objects.empty() && objects[0].bound) bounds_.resize(objects.size());
}

Bounds ShadowWorld::box_of(std::uint32_t place) const {
  const FlatObject& flat = object(place);
  const Pose& pose = flat.object.pose;
  const PlacedBound* placed = bound(place);
  Bounds box;
  if (placed != nullptr && placed->round) {
    box.add_ball(placed->ball.centre, placed->ball.radius);
  } else if (placed != nullptr) {
    for (const Vec3& p : placed->boundary.vertices) box.add(p);
  } else if (flat.local.kind == LocalShape::Kind::ball) {
    box.add_ball(pose.position, flat.local.radius);
  } else {
    for_each_world_point(flat.object.shape, pose, [&box](const Vec3& p) { box.add(p); });
  }
  const Vec3 blur(blur_of(pose.position, reach_of(flat.object.shape), Vec3(0.0)));
  box = {box.min - blur, box.max + blur};
  if (dimension() == 2) box.min.z = box.max.z = 0.0;
  return box;
}

void ShadowWorld::place_boxes(bool is_static) {
  const auto objects = world_.objects();
  for (std::uint32_t i = 0; i < objects.size(); ++i) {
    if (objects[i].object.is_static != is_static) continue;
    if (objects[i].bound) place(*objects[i].bound, objects[i].object.pose, bounds_[i]);
    boxes_[i] = box_of(i);
  }
}

void ShadowWorld::build_tree(bool is_static, BoxTree& tree) {
  place_boxes(is_static);
  items_.clear();
  const auto objects = world_.objects();
  for (std::uint32_t i = 0; i < objects.size(); ++i) {
    if (objects[i].object.is_static == is_static) items_.push_back({boxes_[i], i, objects[i].object.id});
  }
  tree.build(items_);
}

Vec3 ShadowWorld::sight_of(const PartEntry& entry, const Vec3& eye) const {
  const FlatObject& flat = object(entry.place);
  return flat.object.pose.position - eye + flat.rotation * entry.part->centre;
}

double ShadowWorld::area_angle_of(const PartEntry& entry, const Vec3& eye) const {
  return area_angle(*entry.part, object(entry.place).rotation.inverse(sight_of(entry, eye)));
}

}  // namespace gridcull
