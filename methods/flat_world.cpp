#include "gridcull/methods/flat_world.h"

#include <cmath>
#include <string>

#include "gridcull/core/error.h"
#include "gridcull/core/view_volume.h"

namespace gridcull {

std::uint32_t FlatWorld::find(ObjectId object) const {
  if (object < low_ids) return object < low_.size() ? low_[object] : nowhere;
  const auto found = high_.find(object);
  return found == high_.end() ? nowhere : found->second;
}

std::uint32_t FlatWorld::slot(ObjectId object) const {
  const std::uint32_t place = find(object);
  if (place == nowhere) {
    throw Error(ErrorCode::unknown_object, "object " + std::to_string(object) + " is not there");
  }
  return place;
}

void FlatWorld::set_slot(ObjectId object, std::uint32_t place) {
  if (object >= low_ids) {
    high_[object] = place;
    return;
  }
  if (object >= low_.size()) low_.resize(object + 1, nowhere);
  low_[object] = place;
}

// The box is grown by 1e-9 of its size and place, far above the roundings of a turn and two sums.
void FlatWorld::place(FlatObject& flat, const Pose& pose) const {
  flat.object.pose = pose;
  Vec3 half = flat.local.half;
  if (flat.local.kind == LocalShape::Kind::ball) {
    flat.centre = pose.position;
  } else {
    flat.rotation = rotation_of(pose.orientation);
    const Rotation& r = flat.rotation;
    flat.centre = pose.position + r * flat.local.middle;
    for (int k = 0; k < 3; ++k) {
      half[k] = std::fabs(r.x[k]) * flat.local.half.x + std::fabs(r.y[k]) * flat.local.half.y +
                std::fabs(r.z[k]) * flat.local.half.z;
    }
  }
  const double reach = std::fabs(flat.centre.x) + std::fabs(flat.centre.y) + std::fabs(flat.centre.z);
  const Vec3 pad(1e-9 * (flat.radius + reach));
  flat.box = {flat.centre - half - pad, flat.centre + half + pad};
  if (dimension_ == 2) flat.box.min.z = flat.box.max.z = 0.0;
}

void FlatWorld::add(const Object& object) {
  if (dimension_of(object.shape) != dimension_) {
    throw Error(ErrorCode::bad_scene,
                "object " + std::to_string(object.id) + ": expected a " + std::to_string(dimension_) + "D shape");
  }
  validate(object.shape);
  if (object.id == no_id || find(object.id) != nowhere) {
    throw Error(ErrorCode::bad_scene, "object " + std::to_string(object.id) + ": the id is there already");
  }
  FlatObject flat;
  flat.object = object;
  flat.local = make_local_shape(object.shape);
  flat.radius = flat.local.radius * (1.0 + 1e-9);
  if (bound_) flat.bound = std::make_shared<const BoundingVolume>(bound_of(object.shape, *bound_));
  place(flat, object.pose);
  objects_.push_back(std::move(flat));
  try {
    set_slot(object.id, static_cast<std::uint32_t>(objects_.size() - 1));
  } catch (...) {
    objects_.pop_back();
    throw;
  }
  if (!object.is_static) ++movers_;
  ++set_version_;
  touch(objects_.back());
}

void FlatWorld::remove(ObjectId object) {
  const std::uint32_t gone = slot(object);
  touch(objects_[gone]);
  if (!objects_[gone].object.is_static) --movers_;
  if (object < low_ids) {
    low_[object] = nowhere;
  } else {
    high_.erase(object);
  }
  if (gone + 1 != objects_.size()) {
    objects_[gone] = std::move(objects_.back());
    set_slot(objects_[gone].object.id, gone);
    touch(objects_[gone]);
  }
  objects_.pop_back();
  ++set_version_;
}

void FlatWorld::move(ObjectId object, const Pose& pose) {
  FlatObject& flat = objects_[slot(object)];
  place(flat, pose);
  touch(flat);
}

void FlatWorld::begin_frame(double time, std::span<const View> views, FrameStats& stats) {
  if (!std::isfinite(time) || (started_ && !(time > now_))) {
    throw Error(ErrorCode::bad_frame, "time: expected more than " + std::to_string(now_));
  }
  for (const View& view : views) (void)ViewVolume(view, dimension_);
  if (source_ != nullptr && movers_ > 0) {
    // All are read before any is placed: a source that throws has changed nothing.
    poses_.clear();
    for (const FlatObject& flat : objects_) {
      if (!flat.object.is_static) poses_.push_back(source_->pose(flat.object.id));
    }
    std::size_t next = 0;
    for (FlatObject& flat : objects_) {
      if (!flat.object.is_static) place(flat, poses_[next++]);
    }
    ++moving_version_;
  }
  stats.positions_read = movers_;
  now_ = time;
  started_ = true;
}

void FlatWorld::add_holders(const Vec3& point, std::span<const std::uint32_t> candidates,
                            std::vector<std::uint32_t>& out) const {
  for (const std::uint32_t i : candidates) {
    const FlatObject& flat = objects_[i];
    const Bounds& b = flat.box;
    if (point.x < b.min.x || point.y < b.min.y || point.x > b.max.x || point.y > b.max.y) continue;
    if (dimension_ == 3 && (point.z < b.min.z || point.z > b.max.z)) continue;
    if (interior_holds(flat.object.shape, flat.object.pose, point)) out.push_back(i);
  }
}

}  // namespace gridcull
