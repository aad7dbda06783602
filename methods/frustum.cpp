#include "gridcull/methods/frustum.h"

#include <chrono>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "gridcull/core/bounding_volume.h"
#include "gridcull/core/error.h"
#include "gridcull/core/view_volume.h"

namespace gridcull {
namespace {

/// A volume as a shape and its place in the object's axes, for ViewVolume: polygons and polyhedra by their vertices.
struct Tested {
  Shape shape;
  Vec3 centre{0.0};
};

// ViewVolume's margins, 1e-14 of the coordinates of each world point, are above twice the rounding of world points that
// is to be paid (core/bounding_volume.cpp), and a volume is grown by 2^-30 of its size besides.
Tested tested_with(const Shape& shape, BoundKind kind) {
  const BoundingVolume bound = bound_of(shape, kind);
  const bool flat = bound.dimension == 2;
  if (bound.round && flat) return {Disc{bound.ball.radius}, bound.ball.centre};
  if (bound.round) return {Sphere{bound.ball.radius}, bound.ball.centre};
  if (!flat) return {Convex{bound.boundary.vertices}};
  Polygon polygon;
  for (const Vec3& v : bound.boundary.vertices) polygon.vertices.emplace_back(v);
  return {std::move(polygon)};
}

struct Entry {
  Object object;
  std::optional<Tested> tested{};
};

class FrustumCuller final : public Culler {
 public:
  FrustumCuller(int dimension, std::optional<BoundKind> bound) : dimension_(dimension), bound_(bound) {}

  const MethodInfo& info() const override { return frustum_culler_info(); }

  void add(const Object& object) override {
    if (dimension_of(object.shape) != dimension_) {
      throw Error(ErrorCode::bad_scene,
                  "object " + std::to_string(object.id) + ": expected a " + std::to_string(dimension_) + "D shape");
    }
    validate(object.shape);
    Entry entry{object};
    if (bound_) entry.tested = tested_with(object.shape, *bound_);
    if (object.id == no_id || !objects_.emplace(object.id, std::move(entry)).second) {
      throw Error(ErrorCode::bad_scene, "object " + std::to_string(object.id) + ": the id is there already");
    }
  }
  void remove(ObjectId object) override { objects_.erase(find(object)); }
  void move(ObjectId object, const Pose& pose) override { find(object)->second.object.pose = pose; }
  void move_all(std::span<const Move> moves) override {
    for (const Move& m : moves) (void)find(m.object);
    for (const Move& m : moves) move(m.object, m.pose);
  }
  void set_source(PositionSource* source) override { source_ = source; }
  void announce_jump(ObjectId object) override { find(object); }

  void query(double time, std::span<const View> views, Answers& out) override {
    const auto start = std::chrono::steady_clock::now();
    if (!std::isfinite(time) || (started_ && !(time > now_))) {
      throw Error(ErrorCode::bad_frame, "time: expected more than " + std::to_string(now_));
    }
    now_ = time;
    started_ = true;
    out.stats = {};
    read_positions(out.stats);
    out.views.resize(views.size());
    for (std::size_t i = 0; i < views.size(); ++i) answer(views[i], out.views[i]);
    const auto end = std::chrono::steady_clock::now();
    out.stats.total_us = std::chrono::duration<double, std::micro>(end - start).count();
    out.stats.collect_us = out.stats.total_us;
  }

 private:
  std::map<ObjectId, Entry>::iterator find(ObjectId object) {
    const auto found = objects_.find(object);
    if (found == objects_.end()) {
      throw Error(ErrorCode::unknown_object, "object " + std::to_string(object) + " is not there");
    }
    return found;
  }

  void read_positions(FrameStats& stats) {
    for (auto& [id, entry] : objects_) {
      if (entry.object.is_static) continue;
      if (source_ != nullptr) entry.object.pose = source_->pose(id);
      ++stats.positions_read;
    }
  }

  void answer(const View& view, Answer& answer) const {
    const ViewVolume volume(view, dimension_);
    answer.viewer = view.viewer;
    answer.visible.clear();
    answer.work = {};
    for (const auto& [id, entry] : objects_) {
      if (id == view.rides) continue;
      ++answer.work.object_tests;
      const Object& object = entry.object;
      if (may_touch(volume, entry) || interior_holds(object.shape, object.pose, volume.apex())) {
        answer.visible.push_back(id);
      }
    }
  }

  static bool may_touch(const ViewVolume& volume, const Entry& entry) {
    const Pose& pose = entry.object.pose;
    if (!entry.tested) return volume.may_touch(entry.object.shape, pose);
    if (entry.tested->centre == Vec3(0.0)) return volume.may_touch(entry.tested->shape, pose);
    const Vec3 centre = to_world(pose, rotation_of(pose.orientation), entry.tested->centre);
    return volume.may_touch(entry.tested->shape, {centre, pose.orientation});
  }

  int dimension_;
  std::optional<BoundKind> bound_;
  std::map<ObjectId, Entry> objects_;
  PositionSource* source_ = nullptr;
  double now_ = 0.0;
  bool started_ = false;
};

}  // namespace

const MethodInfo& frustum_culler_info() {
  static constexpr MethodInfo info{
      "frustum", "view volume only, nothing is hidden by anything", Guarantee::conservative, true, true, true};
  return info;
}

std::unique_ptr<Culler> make_frustum_culler(int dimension, std::optional<BoundKind> bound) {
  return std::make_unique<FrustumCuller>(dimension, bound);
}

}  // namespace gridcull
